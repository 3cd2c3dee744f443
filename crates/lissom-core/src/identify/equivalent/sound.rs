//! Checks that numbers can be computed with.

use crate::identify::equivalent::data::EquivalentData;
use crate::identify::equivalent::refusal::EquivalentRefusal;
use crate::identify::responses::correct::Response;

/// Sizes of responses: squares of their products stay within doubles.
const SIZES: std::ops::RangeInclusive<f64> = 1e-50..=1e50;
/// Frequencies \[rad/s\]: the same of their fourth powers.
const FREQUENCIES: std::ops::RangeInclusive<f64> = 1e-20..=1e20;
/// A standard error is a slip that is below this share of its response…
const TINY: f64 = 1e-9;
/// …and of the median of all.
const SMALLER: f64 = 1e-6;
/// Standard errors are none that lie this far from their responses (medians), either way.
const APART: f64 = 1e12;

/// Refuses what would leave doubles on the way.
pub(super) fn sound(data: &EquivalentData) -> Result<(), EquivalentRefusal> {
    let odd = |w: &&f64| w.is_finite() && **w > 0.0 && !FREQUENCIES.contains(*w);
    if let Some(&size) = data.omega_rad_s.iter().find(odd) {
        return Err(EquivalentRefusal::Size { name: "a frequency [rad/s]".to_owned(), size });
    }
    for (name, responses) in data.names.iter().zip(&data.outputs) {
        judged(name, responses, &data.omega_rad_s, 1.0)?;
    }
    match &data.motor {
        Some(motor) => {
            judged("motor", &motor.response, &motor.omega_rad_s, motor.torque_per_command)
        }
        None => Ok(()),
    }
}

fn judged(
    name: &str,
    responses: &[Response],
    omega_rad_s: &[f64],
    per: f64,
) -> Result<(), EquivalentRefusal> {
    // What is no number is refused where it is used, with its place.
    let sizes = median(responses.iter().map(|r| r.value.norm()));
    let standard_errors = median(responses.iter().map(|r| r.std));
    let (Some(size), Some(others)) = (sizes, standard_errors) else { return Ok(()) };
    let fits = |s: f64| s == 0.0 || SIZES.contains(&s) && SIZES.contains(&(per / s));
    if let Some(odd) = responses.iter().map(|r| r.value.norm()).find(|s| s.is_finite() && !fits(*s))
    {
        return Err(EquivalentRefusal::Size { name: name.to_owned(), size: odd });
    }
    let apart = size > 0.0 && !(1.0 / APART..=APART).contains(&(others / size));
    let slip = |r: &Response| {
        let alone = r.std < TINY * r.value.norm() && r.std < SMALLER * others;
        r.std > 0.0 && (alone || apart)
    };
    match responses.iter().zip(omega_rad_s).position(|(r, _)| slip(r)) {
        Some(index) => Err(EquivalentRefusal::Deviation {
            name: name.to_owned(),
            index,
            omega_rad_s: omega_rad_s[index],
            std: responses[index].std,
            size: responses[index].value.norm(),
        }),
        None => Ok(()),
    }
}

/// The median of those that are finite and above zero.
pub(super) fn median(of: impl Iterator<Item = f64>) -> Option<f64> {
    let mut sorted: Vec<f64> = of.filter(|x| x.is_finite() && *x > 0.0).collect();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied()
}
