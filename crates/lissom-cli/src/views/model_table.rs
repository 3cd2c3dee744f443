//! The model as text.

use std::f64::consts::TAU;

use lissom::beam::{Damping, MOST_MASSES, Property, RootClass, Zeros, class};
use lissom_io::BeamKind;
use lissom_io::model::{Model, Responses};
use lissom_views::digits::{counted, roots_of, shown};
use num_complex::Complex64;

use super::load_table::payloads;
use super::model_algebra;
use super::printer::{self, line};
use crate::tasks::model_task::{MOST_SHOWN, Task};

/// Significant digits of frequencies and zeros.
const DIGITS: usize = 5;

pub(crate) fn print(task: &Task<'_>, model: &Model) {
    what(task, model);
    line("");
    frequencies(task, model);
    if let Some(found) = &model.tip_zeros {
        line("");
        zeros(model, found, task.args.modes);
    }
    if model.len() <= MOST_SHOWN {
        model_algebra::print(model);
    }
    if let Some(response) = &model.response {
        line("");
        responses(response);
    }
    if let Some(cases) = &model.payload_study {
        line("");
        payloads(task, cases);
    }
    if let Some(all) = &model.properties {
        line("");
        properties(all);
    }
    if !(model.notes.is_empty() && model.warnings.is_empty()) {
        line("");
    }
    model.warnings.iter().for_each(|w| line(&format!("warning: {w}")));
    model.notes.iter().for_each(|n| line(&format!("note: {n}")));
}

/// Prints what the beam is.
fn what(task: &Task<'_>, model: &Model) {
    let metres = |v: f64| format!("{} m", shown(v, DIGITS));
    let points = model.mass_kg.iter().filter(|m| **m > 0.0).count();
    let heavy = model.mass_kg.iter().sum::<f64>();
    line(&match model.kind {
        BeamKind::Modal => {
            format!("a beam given by {}, at as many points", counted(model.len(), "mode"))
        }
        BeamKind::Lumped => format!(
            "{} on {} of massless beam, {} kg in all",
            if model.len() == 1 { "1 mass".to_owned() } else { format!("{} masses", model.len()) },
            metres(model.length_m()),
            shown(heavy, DIGITS)
        ),
        BeamKind::Distributed => {
            let along = shown(model.mass_along_kg, DIGITS);
            let extra = match points {
                0 => String::new(),
                1 => format!(", and a point mass of {} kg", shown(heavy, DIGITS)),
                _ => format!(", and {points} point masses, {} kg in all", shown(heavy, DIGITS)),
            };
            format!(
                "{} of beam with {along} kg along it in {}{extra}",
                metres(model.length_m()),
                counted(model.len(), "span")
            )
        }
    });
    if let Some((soft, stiff)) = task.beam.rigidity_n_m2() {
        #[expect(clippy::float_cmp, reason = "the same number twice")]
        let rigidity = if soft == stiff {
            shown(soft, DIGITS)
        } else {
            format!("{} to {}", shown(soft, DIGITS), shown(stiff, DIGITS))
        };
        line(&format!("EI {rigidity} N·m²"));
    }
    if model.hub_radius_m > 0.0 {
        line(&format!("the beam begins {} from the axis", metres(model.hub_radius_m)));
    }
    let p = &model.payload;
    let mut parts = Vec::new();
    if p.mass_kg > 0.0 {
        parts.push(format!("{} kg", shown(p.mass_kg, DIGITS)));
        if p.offset_m != 0.0 {
            let side = if p.offset_m > 0.0 { "beyond" } else { "before" };
            parts.push(format!("{} {side} the tip", metres(p.offset_m.abs())));
        }
    }
    if p.inertia_kg_m2 > 0.0 {
        parts.push(format!("rotary inertia {} kg·m²", shown(p.inertia_kg_m2, DIGITS)));
    }
    if !parts.is_empty() {
        line(&format!("at the tip: {}", parts.join(", ")));
    }
    match task.beam.damping() {
        Damping::Proportional { mass_per_s, stiffness_s } => line(&format!(
            "damping: {} 1/s of the mass, {} s of the stiffness",
            shown(*mass_per_s, DIGITS),
            shown(*stiffness_s, DIGITS)
        )),
        Damping::Modal { ratios } => {
            let each: Vec<String> = ratios.iter().map(|r| shown(*r, 3)).collect();
            line(&format!("damping ratios: {}", each.join(", ")));
        }
        _ => {}
    }
    line(&format!("inertia about the axis {} kg·m²", shown(model.inertia_kg_m2, DIGITS)));
}

/// Prints the natural frequencies, at most as many as asked for.
fn frequencies(task: &Task<'_>, model: &Model) {
    let clamped = &model.natural_frequencies_rad_s;
    let coupled = model.coupled_frequencies_rad_s.as_deref();
    let ratios = ratios(model);
    let mut heading = vec!["", "motor clamped [rad/s]", "[Hz]"];
    heading.extend(ratios.is_some().then_some("damping ratio"));
    heading.extend(coupled.is_some().then_some("rotor free [rad/s]"));
    heading.extend(coupled.is_some().then_some("[Hz]"));
    let mut rows = vec![heading.into_iter().map(str::to_owned).collect::<Vec<_>>()];
    let cells = |v: f64| [shown(v, DIGITS), shown(v / TAU, DIGITS)];
    for (k, omega) in clamped.iter().take(task.args.modes).enumerate() {
        let mut row = vec![format!("mode {}", k + 1)];
        row.extend(cells(*omega));
        row.extend(ratios.as_ref().map(|r| shown(r[k], 3)));
        row.extend(coupled.into_iter().flat_map(|list| {
            list.get(k).map_or([String::new(), String::new()], |omega| cells(*omega))
        }));
        rows.push(row);
    }
    printer::table(&rows);
    let all = if model.kind == BeamKind::Lumped { clamped.len().max(model.len()) } else { 0 };
    more(all.saturating_sub(task.args.modes));
    if coupled.is_some() {
        line("rotor free: coupled with the drive's inertia, without its friction");
    }
}

fn more(left: usize) {
    if left > 0 {
        line(&format!("… and {left} more"));
    }
}

/// Damping ratio of each mode, from the poles of the tip's response; `None` if the beam has no damping or a mode does
/// not oscillate.
fn ratios(model: &Model) -> Option<Vec<f64>> {
    let poles = &model.functions.iter().find(|f| f.from == "motor" && !f.lowest)?.roots.poles;
    if poles.iter().all(|p| p.re == 0.0) {
        return None;
    }
    let mut upper: Vec<&Complex64> = poles.iter().filter(|p| p.im > 0.0).collect();
    upper.sort_by(|a, b| a.norm().total_cmp(&b.norm()));
    let ratios: Vec<f64> = upper.iter().map(|p| -p.re / p.norm()).collect();
    (ratios.len() == model.natural_frequencies_rad_s.len()).then_some(ratios)
}

/// Prints the zeros of the tip's response, their classes, and whether it is minimum phase.
fn zeros(model: &Model, found: &Zeros, most: usize) {
    let tip = format!("θ_{}/θ_m", model.len());
    // One of a conjugate pair represents both.
    let once: Vec<&Complex64> =
        found.z.iter().filter(|z| class(**z) != RootClass::Quadruple || z.im > 0.0).collect();
    let below = match model.kind {
        BeamKind::Lumped | BeamKind::Modal => String::new(),
        BeamKind::Distributed => {
            let highest = model.natural_frequencies_rad_s.last().copied().unwrap_or(0.0);
            format!(" below {} rad/s", shown(highest, DIGITS))
        }
    };
    if once.is_empty() && found.missing == 0 {
        line(&format!("the tip's response {tip} has no zeros{below}: minimum phase"));
        return;
    }
    let unit = if below.is_empty() { " [rad/s]" } else { "" };
    let heading = [format!("zeros of {tip}{below}{unit}"), "class".to_owned()];
    let mut rows = vec![heading.to_vec()];
    rows.extend(
        once.iter()
            .take(most)
            .map(|z| vec![format!("  {}", roots_of(**z, DIGITS)), class(**z).letter().to_string()]),
    );
    printer::table(&rows);
    // For very many masses only the lowest zeros are searched for.
    let all = if model.len() > MOST_MASSES { model.len() - 1 } else { once.len() };
    more(all - once.len().min(most));
    let count = |wanted: RootClass| once.iter().filter(|z| class(***z) == wanted).count();
    let (real, quadruple) = (count(RootClass::Real), count(RootClass::Quadruple));
    line(&match (real, quadruple) {
        _ if found.missing > 0 => "not all zeros were found: see the warnings".to_owned(),
        (0, 0) => format!("minimum phase: all {} on the imaginary axis", once.len()),
        (b, c) => {
            let pair = (b > 0).then(|| format!("{} (b)", counted(b, "real pair")));
            let four = (c > 0).then(|| format!("{} (c)", counted(c, "quadruple")));
            let others = (all > once.len()).then(|| "others".to_owned());
            let both: Vec<String> = pair.into_iter().chain(four).chain(others).collect();
            format!(
                "non-minimum phase, by {}: the inverse of this response is unstable",
                both.join(" and ")
            )
        }
    });
}

/// Prints the responses of tip and motor.
fn responses(r: &Responses) {
    let Some((tip, mass)) = r.tips.last().zip(r.masses.last()) else { return };
    let mut heading = vec!["omega [rad/s]".to_owned(), "[Hz]".to_owned()];
    let mut name = |what: &str| {
        heading.push(format!("|{what}| [dB]"));
        heading.push("phase [°]".to_owned());
    };
    name(&format!("θ_{}/θ_m", mass + 1));
    if r.motor.is_some() {
        name("θ_m/i");
    }
    let cells =
        |v: &Complex64| [format!("{:.3}", 20.0 * v.norm().log10()), format!("{:.2}", degrees(*v))];
    let mut rows = vec![heading];
    for (k, omega) in r.omega_rad_s.iter().enumerate() {
        let mut row = vec![shown(*omega, 6), shown(omega / TAU, 6)];
        row.extend(cells(&tip[k]));
        row.extend(r.motor.iter().flat_map(|motor| cells(&motor[k])));
        rows.push(row);
    }
    printer::table(&rows);
}

/// Phase in (−180°, 180°].
fn degrees(v: Complex64) -> f64 {
    let phase = v.im.atan2(v.re).to_degrees();
    if phase <= -180.0 { 180.0 } else { phase }
}

/// Prints which properties of Section 3 of the 1989 report hold, and why the others do not.
fn properties(all: &[Property]) {
    let heading = ["Section 3", "", "measured", "bound"].map(str::to_owned);
    let mut rows = vec![heading.to_vec()];
    for p in all {
        let holds = if p.holds { "holds" } else { "does not hold" };
        rows.push(vec![
            p.name.to_owned(),
            holds.to_owned(),
            shown(p.measured, 3),
            shown(p.bound, 3),
        ]);
    }
    printer::table(&rows);
    for p in all {
        line(&format!("  {}: {}", p.name, p.statement));
        line(&format!("    measured: {}", p.note));
    }
}
