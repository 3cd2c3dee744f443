//! The speeds at which friction of a result holds, in words.

use lissom_io::ResultFile;
use lissom_io::result::NumberEntry;
use lissom_report::significant;

/// One line for Coulomb and viscous friction, and, beside a law, one for the law and one for the curve.
pub fn friction_speeds_words(result: &ResultFile) -> Vec<String> {
    let friction = &result.friction;
    let range = |[slowest, fastest]: [f64; 2], unit: &str| {
        format!("{} to {} {unit}", significant(slowest, 3), significant(fastest, 3))
    };
    let of = |speeds: &NumberEntry<[f64; 2]>| range(speeds.value, &speeds.unit);
    let Some(speeds) = &friction.speed_range else { return Vec::new() };
    let Some(law) = &friction.law else {
        return vec![format!("Coulomb and viscous friction hold at speeds of {}", of(speeds))];
    };
    let of_law = law
        .speed_range
        .as_ref()
        .map(|speeds| format!("The law of friction was fitted at speeds of {}", of(speeds)));
    let load = if result.gravity.is_some() { ", under the mean load" } else { "" };
    let of_line = format!(
        "Coulomb and viscous friction are the straight line nearest to the law at speeds of {}{load}",
        of(speeds)
    );
    let curve = friction.curve.iter().map(|point| point.speed.value);
    let ends = curve.fold([f64::INFINITY, 0.0], |[low, high], v| [v.min(low), v.max(high)]);
    let of_curve = (!friction.curve.is_empty()).then(|| {
        let measured = range(ends, &speeds.unit);
        format!("The curve of friction against speed is measured from {measured}")
    });
    of_law.into_iter().chain([of_line]).chain(of_curve).collect()
}
