//! The one place that prints: results to standard output, talk to standard error.
#![expect(clippy::print_stderr, reason = "the command's printer")]

use lissom::identify::{Estimate, Finding, Identified, RunKind, Severity};
use lissom::record::{Campaign, Hold};
use lissom_io::UnitNames;
use lissom_report::with_uncertainty;
use serde_json::Value;
use std::io::{ErrorKind, Write as _};

use crate::failure::Failure;

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

/// JSON, alone on standard output.
pub(crate) fn json(value: &Value) {
    line(&format!("{value:#}"));
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
        "{} runs, {samples} samples every {sampling}, command {hold}, {} tips",
        campaign.runs.len(),
        campaign.channels.tips.len()
    ));
}

/// What was kept of the runs.
pub(crate) fn runs(id: &Identified) {
    let (mut kept, mut dropped, mut general) = (0, 0, 0);
    let (mut low, mut high) = (f64::INFINITY, 0.0_f64);
    for run in &id.runs {
        match &run.kind {
            RunKind::Sinusoidal(s) => {
                kept += s.steady.periods;
                dropped += s.steady.dropped;
                low = low.min(s.omega_rad_s);
                high = high.max(s.omega_rad_s);
            }
            RunKind::General => general += 1,
        }
    }
    let sinusoidal = id.runs.len() - general;
    if sinusoidal > 0 {
        line(&format!(
            "{sinusoidal} sinusoidal runs, {low:.3} to {high:.3} rad/s: {kept} periods kept, \
             {dropped} dropped as transients"
        ));
    }
    if general > 0 {
        line(&format!("{general} runs of other motion"));
    }
    if let Some(r) = &id.regression {
        let how = if r.window_given { "given" } else { "chosen where the figures move least" };
        line(&format!(
            "regression: {} rows in {} slip phases, window {:.4} s ({how}), {:.2} % of the torque left",
            r.rows,
            r.phases,
            r.window_s,
            100.0 * r.relative_residual
        ));
    }
}

/// The figures, each with its 95 % interval.
pub(crate) fn figures(names: UnitNames, id: &Identified) {
    let mut rows = vec![vec![
        "figure".to_owned(),
        "value".to_owned(),
        "unit".to_owned(),
        "95 % interval".to_owned(),
    ]];
    rows.extend(figure_rows(names, id).into_iter().map(|(name, e, unit)| {
        let (value, interval) = match e {
            Some(e) => {
                let [low, high] = e.ci95();
                (with_uncertainty(e.value, e.std), format!("{low:.5e} to {high:.5e}"))
            }
            None => ("refused".to_owned(), "see findings".to_owned()),
        };
        vec![name, value, unit, interval]
    }));
    table(&rows);
}

/// Name, figure and unit of each figure that the result has.
pub(crate) fn figure_rows(
    names: UnitNames,
    id: &Identified,
) -> Vec<(String, Option<Estimate>, String)> {
    let f = &id.friction;
    let constant = id.torque_per_command.unwrap_or(1.0);
    let torque = names.torque_unit().to_owned();
    let mut rows = vec![];
    if names.torque_known {
        let command = names.command_unit().to_owned();
        let in_command = f.coulomb.map(|e| e.scaled(1.0 / constant));
        rows.push(("Coulomb friction".to_owned(), in_command, command));
    }
    rows.push(("Coulomb friction".to_owned(), f.coulomb, torque.clone()));
    if f.forward.is_some() {
        rows.push(("  forward".to_owned(), f.forward, torque.clone()));
        rows.push(("  backward".to_owned(), f.backward, torque.clone()));
        rows.push(("  offset".to_owned(), f.offset, torque));
    }
    rows.push(("viscous friction".to_owned(), f.viscous, names.viscous_unit()));
    if let Some((forward, backward)) = f.viscous_by_direction {
        rows.push(("  forward".to_owned(), Some(forward), names.viscous_unit()));
        rows.push(("  backward".to_owned(), Some(backward), names.viscous_unit()));
    }
    rows.push((names.inertia_name().to_owned(), id.inertia, names.inertia_unit()));
    if !id.beam.coupling_by_tip.is_empty() || id.beam.coupling.is_some() {
        rows.push(("coupling to the beam".to_owned(), id.beam.coupling, names.coupling_unit()));
    }
    for (k, mode) in id.beam.modes.iter().enumerate() {
        let name = format!("mode {} (motor clamped)", k + 1);
        rows.push((name, Some(mode.natural_frequency_rad_s), "rad/s".to_owned()));
        let hertz = mode.natural_frequency_rad_s.scaled(1.0 / std::f64::consts::TAU);
        rows.push((String::new(), Some(hertz), "Hz".to_owned()));
        rows.push(("  damping ratio".to_owned(), Some(mode.damping_ratio), "1".to_owned()));
    }
    rows
}

/// The findings, gravest first, those of one kind together.
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

/// Findings of one kind that are shown one by one.
const SHOWN: usize = 3;
