//! The one place that prints: results to standard output, talk to standard error.
#![expect(clippy::print_stderr, reason = "the command's printer")]

use lissom::identify::{ConstantVelocity, Estimate, Finding, Identified, RunKind, Severity};
use lissom::record::{Axis, Campaign, Hold};
use lissom_io::UnitNames;
use lissom_report::{interval, significant, with_uncertainty};
use serde::Serialize;
use serde_json::json;
use std::io::{ErrorKind, Write as _};

use crate::failure::Failure;
use crate::reference::Reference;

/// Significant digits of figures known beforehand.
pub(crate) const KNOWN_DIGITS: usize = 6;

/// An error with the way out.
pub(crate) fn failure(failure: &Failure) {
    eprintln!("error: {failure}");
    if let Some(hint) = failure.hint() {
        eprintln!("hint: {hint}");
    }
}

/// A line of the result. A reader that goes away (`| head`) ends the command without a word.
pub(crate) fn line(text: &str) {
    if let Err(error) = writeln!(std::io::stdout().lock(), "{text}") {
        if error.kind() != ErrorKind::BrokenPipe {
            eprintln!("error: standard output: {error}");
        }
        std::process::exit(i32::from(error.kind() != ErrorKind::BrokenPipe));
    }
}

/// A remark on the way, which is no part of the result.
pub(crate) fn note(text: &str) {
    eprintln!("{text}");
}

/// JSON, alone on standard output.
pub(crate) fn json(value: &impl Serialize) {
    line(&format!("{:#}", json!(value)));
}

/// A table with its columns aligned, the first to the left, the others to the right.
pub(crate) fn table(rows: &[Vec<String>]) {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |c: usize| {
        rows.iter().filter_map(|r| r.get(c)).map(|s| s.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..columns).map(width).collect();
    for row in rows {
        let mut text = String::new();
        for (c, cell) in row.iter().enumerate() {
            let pad = " ".repeat(widths[c] - cell.chars().count());
            let (before, after) = if c == 0 { ("", pad.as_str()) } else { (pad.as_str(), "") };
            text.push_str(if c == 0 { "" } else { "  " });
            text.push_str(before);
            text.push_str(cell);
            text.push_str(after);
        }
        line(text.trim_end());
    }
}

/// "1 run", "2 runs".
pub(crate) fn counted(number: usize, what: &str) -> String {
    format!("{number} {what}{}", if number == 1 { "" } else { "s" })
}

/// What was read.
pub(crate) fn campaign(campaign: &Campaign) {
    let samples: usize = campaign.runs.iter().map(lissom::record::Run::len).sum();
    let (mut shortest, mut longest) = (f64::INFINITY, 0.0_f64);
    for run in &campaign.runs {
        shortest = shortest.min(run.sample_time_s());
        longest = longest.max(run.sample_time_s());
    }
    let sampling = if longest - shortest > 1e-6 * longest {
        format!("{:.4} to {:.4} ms", 1e3 * shortest, 1e3 * longest)
    } else {
        format!("{:.4} ms", 1e3 * longest)
    };
    let hold = match campaign.channels.command.hold {
        Hold::Sampled => "commanded and held",
        Hold::Measured => "measured",
    };
    line(&format!(
        "{}, {samples} samples every {sampling}, command {hold}, {}",
        counted(campaign.runs.len(), "run"),
        counted(campaign.channels.tips.len(), "tip")
    ));
}

/// How far and how fast things go: a wrong unit shows here first.
pub(crate) fn ranges(names: UnitNames, campaign: &Campaign) {
    let (mut low, mut high, mut speed, mut drive) = (f64::INFINITY, f64::NEG_INFINITY, 0.0, 0.0);
    for run in &campaign.runs {
        // Speed over some samples: over one, the sensor's steps would be the fastest.
        let reach = (run.len() / 50).clamp(1, 10);
        let moved = run.motor().windows(reach + 1).map(|w| (w[reach] - w[0]).abs());
        speed = moved.fold(0.0, f64::max).max(speed * reach as f64 * run.sample_time_s())
            / (reach as f64 * run.sample_time_s());
        for &x in run.motor() {
            (low, high) = (f64::min(low, x), f64::max(high, x));
        }
        drive = run.command().iter().fold(drive, |m, u| f64::max(m, u.abs()));
    }
    let (angle, unit) = (names.angle(), names.command_unit());
    line(&format!(
        "motor from {low:.3} to {high:.3} {angle}, up to {speed:.3} {angle}/s; {} up to {drive:.3} {unit}",
        names.command_name()
    ));
}

/// What was kept of the runs.
pub(crate) fn runs(id: &Identified) {
    let (mut kept, mut dropped, mut general, mut steady) = (0, 0, 0, 0);
    let (mut low, mut high) = (f64::INFINITY, 0.0_f64);
    for run in &id.runs {
        match &run.kind {
            RunKind::Sinusoidal(s) => {
                kept += s.steady.periods;
                dropped += s.steady.dropped;
                low = low.min(s.omega_rad_s);
                high = high.max(s.omega_rad_s);
            }
            RunKind::ConstantVelocity => steady += 1,
            RunKind::General => general += 1,
        }
    }
    let sinusoidal = id.runs.len() - general - steady;
    if sinusoidal > 0 {
        line(&format!(
            "{}, {low:.3} to {high:.3} rad/s: {kept} periods kept, \
             {dropped} dropped as transients",
            counted(sinusoidal, "sinusoidal run")
        ));
    }
    if steady > 0 {
        line(&format!("{} at constant velocities", counted(steady, "run")));
    }
    if general > 0 {
        line(&format!("{} of other motion", counted(general, "run")));
    }
    if let Some(r) = &id.regression {
        let how = if r.window_given { "given" } else { "chosen where the figures are best known" };
        line(&format!(
            "regression: {} rows in {} slip phases, window {:.4} s ({how}; motion up to {:.3} Hz), \
             {:.2} % of the torque left",
            r.rows,
            r.phases,
            r.window_s,
            FIRST_NULL / r.window_s,
            100.0 * r.relative_residual
        ));
    }
}

/// The figures, each with its 95 % interval and what was known beforehand.
pub(crate) fn figures(names: UnitNames, id: &Identified, reference: Option<&Reference>) {
    let mut heading = vec!["figure", "value", "unit", "95 % interval"];
    heading.extend(reference.map(|r| r.label));
    let mut rows = vec![heading.into_iter().map(str::to_owned).collect::<Vec<_>>()];
    rows.extend(figure_rows(names, id, reference).into_iter().map(|row| {
        let (value, within) = match row.figure {
            Some(e) => {
                let shown = interval(e.ci95(), e.value, e.std);
                (with_uncertainty(e.value, e.std), shown)
            }
            None => ("refused".to_owned(), "see findings".to_owned()),
        };
        let known = row.known.map(|k| significant(k, KNOWN_DIGITS));
        [row.name, value, row.unit, within].into_iter().chain(known).collect()
    }));
    table(&rows);
}

/// What steady velocities give, beside the figures taken.
pub(crate) fn constant_velocity(names: UnitNames, id: &Identified) {
    let Some(found) = &id.constant_velocity else { return };
    let mut rows = vec![["constant velocity", "value", "unit", "95 % interval"].map(str::to_owned)];
    rows.extend(classical_rows(names, id, found).into_iter().map(|row| match row.figure {
        Some(e) => {
            let within = interval(e.ci95(), e.value, e.std);
            [row.name, with_uncertainty(e.value, e.std), row.unit, within]
        }
        None => [row.name, "refused".to_owned(), row.unit, "see findings".to_owned()],
    }));
    line("");
    table(&rows.into_iter().map(Vec::from).collect::<Vec<_>>());
    let number = |sign: f64| found.points.iter().filter(|p| p.velocity.value * sign > 0.0).count();
    line(&format!(
        "by lines through {} forward and {} backward",
        counted(number(1.0), "point"),
        counted(number(-1.0), "point")
    ));
}

/// The figures of steady velocities.
pub(crate) fn classical_rows(
    names: UnitNames,
    id: &Identified,
    found: &ConstantVelocity,
) -> Vec<FigureRow> {
    let constant = id.torque_per_command.unwrap_or(1.0);
    let (forward, backward) = (found.forward.as_ref().ok(), found.backward.as_ref().ok());
    let in_command = |e: Option<Estimate>| e.map(|e| e.scaled(1.0 / constant));
    let command = || names.command_unit().to_owned();
    let row = |name: &str, figure, unit: String| FigureRow {
        name: name.to_owned(),
        figure,
        unit,
        known: None,
    };
    vec![
        row("Coulomb friction", in_command(found.coulomb), command()),
        row("  forward", in_command(forward.map(|l| l.coulomb)), command()),
        row("  backward", in_command(backward.map(|l| l.coulomb)), command()),
        row("viscous friction", found.viscous, names.viscous_unit()),
        row("  forward", forward.map(|l| l.viscous), names.viscous_unit()),
        row("  backward", backward.map(|l| l.viscous), names.viscous_unit()),
    ]
}

/// A figure for people.
pub(crate) struct FigureRow {
    /// Its name; indented where it belongs to the one above.
    pub(crate) name: String,
    /// The figure; `None` where it is refused.
    pub(crate) figure: Option<Estimate>,
    /// Its unit.
    pub(crate) unit: String,
    /// What was known beforehand, in the same unit.
    pub(crate) known: Option<f64>,
}

/// Every figure that the result has.
pub(crate) fn figure_rows(
    names: UnitNames,
    id: &Identified,
    reference: Option<&Reference>,
) -> Vec<FigureRow> {
    // An arm.toml is in SI and rotary: it says nothing of figures per unit of command.
    let reference = reference.filter(|_| names.torque_unit() == "N·m");
    let arm = reference.and_then(|r| r.arm.as_ref());
    let f = &id.friction;
    let constant = id.torque_per_command.unwrap_or(1.0);
    let torque = || names.torque_unit().to_owned();
    let mut rows = Vec::new();
    let mut add = |name: &str, figure, unit: String, known: Option<f64>| {
        rows.push(FigureRow { name: name.to_owned(), figure, unit, known });
    };
    let mean = reference.map(|r| 0.5 * (r.coulomb_nm.0 + r.coulomb_nm.1));
    if names.torque_known {
        let in_command = f.coulomb.map(|e| e.scaled(1.0 / constant));
        let unit = names.command_unit().to_owned();
        add("Coulomb friction", in_command, unit, mean.map(|m| m / constant));
    }
    add("Coulomb friction", f.coulomb, torque(), mean);
    if f.forward.is_some() {
        add("  forward", f.forward, torque(), reference.map(|r| r.coulomb_nm.0));
        add("  backward", f.backward, torque(), reference.map(|r| r.coulomb_nm.1));
        let offset = reference.map(|r| 0.5 * (r.coulomb_nm.0 - r.coulomb_nm.1));
        add("  offset", f.offset, torque(), offset);
    }
    let viscous = reference.map(|r| r.viscous_nm_s_per_rad);
    add("viscous friction", f.viscous, names.viscous_unit(), viscous);
    if let Some((forward, backward)) = f.viscous_by_direction {
        add("  forward", Some(forward), names.viscous_unit(), None);
        add("  backward", Some(backward), names.viscous_unit(), None);
    }
    if let Some(near) = f.near_rest {
        add("friction near rest, more", Some(near.torque), torque(), None);
        add("  over a speed of", Some(near.speed), format!("{}/s", names.angle()), None);
    }
    for ripple in &f.ripples {
        add("friction's ripple", Some(ripple.torque), torque(), None);
        add("  period", Some(ripple.period()), names.angle().to_owned(), None);
    }
    if let Some(b) = f.bristles {
        add("bristles, stiffness", Some(b.stiffness), names.coupling_unit(), None);
        add("  damping", Some(b.damping), names.viscous_unit(), None);
        add("  bend before slipping", Some(b.travel), names.angle().to_owned(), None);
    }
    let inertia = reference.map(|r| r.inertia_kg_m2);
    add(names.inertia_name(), id.inertia, names.inertia_unit(), inertia);
    if !id.beam.coupling_by_tip.is_empty() || id.beam.coupling.is_some() {
        let known = arm.map(|a| a.dynamics().coupling_motor);
        add("coupling to the beam", id.beam.coupling, names.coupling_unit(), known);
    }
    let natural = arm.map_or(Vec::new(), |a| a.beam().natural_frequencies_rad_s());
    for (k, mode) in id.beam.modes.iter().enumerate() {
        let name = format!("mode {} (motor clamped)", k + 1);
        let frequency = mode.natural_frequency_rad_s;
        let known = natural.get(k).copied();
        add(&name, Some(frequency), "rad/s".to_owned(), known);
        let hertz = |v: f64| v / std::f64::consts::TAU;
        add("", Some(frequency.scaled(hertz(1.0))), "Hz".to_owned(), known.map(hertz));
        add("  damping ratio", Some(mode.damping_ratio), "1".to_owned(), None);
    }
    rows
}

/// What the logs separate, in words.
pub(crate) fn verdict(axis: Axis, id: &Identified) {
    let words = id.separability.as_ref().map_or(Vec::new(), |found| found.words(axis));
    if words.is_empty() {
        return;
    }
    line("\nverdict");
    for text in words {
        line(&format!("  {text}"));
    }
}

/// The findings as they stand, those of one kind together.
pub(crate) fn findings(findings: &[Finding]) {
    if findings.is_empty() {
        line("\nno findings");
        return;
    }
    line("\nfindings");
    let kind = |f: &Finding| (f.code, f.severity, f.hint);
    let mut told = Vec::new();
    for finding in findings {
        if told.contains(&kind(finding)) {
            continue;
        }
        told.push(kind(finding));
        let same: Vec<&Finding> = findings.iter().filter(|f| kind(f) == kind(finding)).collect();
        let severity = match finding.severity {
            Severity::Info => "info",
            Severity::Warning => "warning",
            Severity::Refusal => "refusal",
        };
        for f in same.iter().take(SHOWN) {
            let run = f.run.as_ref().map_or(String::new(), |r| format!(" {r}:"));
            line(&format!("  {severity} [{}]{run} {}", f.code, f.message));
        }
        if same.len() > SHOWN {
            line(&format!(
                "    … and {} more runs (all in the JSON and the report)",
                same.len() - SHOWN
            ));
        }
        if !finding.hint.is_empty() {
            line(&format!("    hint: {}", finding.hint));
        }
    }
}

/// The spectrum of a sin⁴ window has its first zero at this over its length.
const FIRST_NULL: f64 = 3.0;
/// Findings of one kind that are shown one by one.
const SHOWN: usize = 3;
