//! Tables of an equivalent arm.

use lissom::beam::RootClass;
use lissom::identify::{Equivalent, Estimate, ResponseZero, StdSource};
use lissom::{EquivalentInput, KnownMotor};
use lissom_io::UnitNames;
use lissom_io::result::{EquivalentEntry, StrainlessEntry};
use lissom_report::{interval, with_uncertainty};
use lissom_views::digits::counted;
use lissom_views::equivalent_section::{equation, heading, rows_for_use, torque_name};

use super::printer;

pub(crate) fn print(input: &EquivalentInput, found: &Equivalent) {
    head(input, found);
    printer::line("");
    modes(input, found);
    if found.arm.is_some() {
        printer::line("");
        figures(input, found);
    }
    printer::line("");
    as_fitted(input, found);
    let entry = EquivalentEntry::of(input.names, found);
    if let Some(form) = &entry.strainless {
        printer::line("");
        for_use(input.names, &entry, form);
    }
    printer::line("");
    zeros(found);
}

/// Prints the equivalent arm in the output of `identify`.
pub(crate) fn brief(names: UnitNames, found: &EquivalentEntry) {
    let Some(form) = &found.strainless else { return };
    let modes = counted(found.modes.len(), "mode");
    printer::line(&format!(
        "\nequivalent arm with {modes} (`lissom equivalent` gives its 95 % intervals)"
    ));
    for_use(names, found, form);
}

fn head(input: &EquivalentInput, found: &Equivalent) {
    let data = &input.data;
    let (low, high) = found.fit.range_rad_s;
    printer::line(&format!(
        "{} at {} frequencies, {low:.4} to {high:.4} rad/s: {}",
        counted(data.names.len(), "point"),
        data.omega_rad_s.len(),
        data.names.join(", ")
    ));
    let left = if found.std_source == StdSource::FromResidual {
        "standard errors from the residual".to_owned()
    } else {
        format!("or {:.2} standard errors", found.fit.weighted_rms)
    };
    let poles = counted(found.fit.poles.len(), "pole");
    let modes = counted(found.modes.len(), "mode");
    printer::line(&format!(
        "{poles} fitted, {modes} kept; residual {:.3} % of each response (rms), {left}",
        100.0 * found.relative_residual
    ));
}

fn known(estimate: Option<Estimate>) -> String {
    estimate.map_or_else(|| "–".to_owned(), |e| with_uncertainty(e.value, e.std))
}

fn shown(estimate: Estimate) -> String {
    with_uncertainty(estimate.value, estimate.std)
}

fn modes(input: &EquivalentInput, found: &Equivalent) {
    let coupling = format!("coupling [{}]", input.names.coupling_unit());
    let mut heading = vec!["motor clamped", "[rad/s]", "95 % interval", "[Hz]", "damping ratio"];
    if found.arm.is_some() {
        heading.push(&coupling);
    }
    let beside = input.identified.as_ref().map(|k| &k.modes_rad_s);
    if beside.is_some() {
        heading.push("identify [rad/s]");
    }
    let mut rows = vec![heading.into_iter().map(str::to_owned).collect::<Vec<_>>()];
    for k in 0..found.modes.len() {
        let omega = found.kept.natural_frequency_rad_s(k);
        let mut row = vec![
            format!("mode {}", k + 1),
            shown(omega),
            interval(omega.ci95(), omega.value, omega.std),
            shown(omega.scaled(1.0 / std::f64::consts::TAU)),
            shown(found.kept.damping_ratio(k)),
        ];
        row.extend(found.arm.as_ref().map(|arm| shown(arm.coupling[k])));
        row.extend(beside.map(|all| {
            // The mode of `identify` with nearly the same frequency, if any: it may have found fewer.
            let near = |e: &&Estimate| (e.value / omega.value).ln().abs();
            let nearest = all.iter().min_by(|a, b| near(a).total_cmp(&near(b)));
            known(nearest.filter(|e| near(e) < 0.2).copied())
        }));
        rows.push(row);
    }
    printer::table(&rows);
}

fn figures(input: &EquivalentInput, found: &Equivalent) {
    let Some(arm) = &found.arm else { return };
    let names = input.names;
    let of = |get: fn(&KnownMotor) -> Option<Estimate>| input.identified.as_ref().map(get);
    let all = [
        (names.inertia_name(), arm.inertia, names.inertia_unit(), of(|k| k.inertia)),
        ("viscous friction", arm.viscous, names.viscous_unit(), of(|k| k.viscous)),
        ("coupling, ĥ", arm.h_motor, names.coupling_unit(), of(|k| k.coupling)),
    ];
    let mut heading = vec!["parameter", "value", "unit", "95 % interval"];
    if input.identified.is_some() {
        heading.push("identify");
    }
    let mut rows = vec![heading.into_iter().map(str::to_owned).collect::<Vec<_>>()];
    for (name, figure, unit, beside) in all {
        let within = interval(figure.ci95(), figure.value, figure.std);
        let mut row = vec![name.to_owned(), shown(figure), unit, within];
        row.extend(beside.map(known));
        rows.push(row);
    }
    printer::table(&rows);
}

fn as_fitted(input: &EquivalentInput, found: &Equivalent) {
    let points: Vec<String> = found.points.iter().map(|i| found.names[*i].clone()).collect();
    let mut rows = vec![heading(&points, "as fitted (17)-(18)")];
    let beam = &found.beam;
    let count = found.points.len();
    for (i, point) in points.iter().enumerate() {
        let of = |j: usize| with_uncertainty(beam.a[(i, j)], beam.a_std[(i, j)]);
        let mut row = vec![equation(point)];
        row.extend((0..count).map(of));
        row.push(with_uncertainty(beam.b[i], beam.b_std[i]));
        rows.push(row);
    }
    if let Some(arm) = &found.arm {
        let h = arm.h.iter().map(|h| shown(*h));
        let h = h.chain([shown(arm.h_motor)]);
        rows.push(std::iter::once(torque_name(input.names)).chain(h).collect());
    }
    printer::table(&rows);
}

fn for_use(names: UnitNames, found: &EquivalentEntry, form: &StrainlessEntry) {
    printer::table(&rows_for_use(names, found, form));
}

fn zeros(found: &Equivalent) {
    let mut rows = vec![["zeros of", "[rad/s]", "95 % interval", "class"].map(str::to_owned)];
    for (name, zeros) in found.names.iter().zip(&found.zeros) {
        for zero in zeros {
            let figure = zero.omega_rad_s;
            let class = class(zero);
            let within = interval(figure.ci95(), figure.value, figure.std);
            let value = match zero.class {
                RootClass::Imaginary => format!("±j·{}", shown(figure)),
                RootClass::Real => format!("±{}", shown(figure)),
                RootClass::Quadruple => {
                    let s = zero.square.sqrt();
                    format!("±{:.4} ± j·{:.4}", s.re, s.im)
                }
            };
            rows.push([format!("θ({name})/θ_m"), value, within, class]);
        }
    }
    if rows.len() == 1 {
        printer::line("no zeros: each response has one mode");
        return;
    }
    printer::table(&rows.into_iter().map(Vec::from).collect::<Vec<_>>());
}

fn class(zero: &ResponseZero) -> String {
    let beyond = if zero.outside { ", outside the measured frequencies" } else { "" };
    let phase = if zero.class == RootClass::Imaginary { "" } else { ", non-minimum phase" };
    format!("{}{phase}{beyond}", zero.class.letter())
}
