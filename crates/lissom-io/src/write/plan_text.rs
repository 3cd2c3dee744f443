//! Writes a `plan.toml`.

use std::fmt::{self, Write as _};
use std::path::Path;

use lissom_core::plan::{Plan, PlannedMotion, PlannedRun, percent};

use super::write_error::WriteError;
use super::write_whole::write_text;

/// First words of a written plan.
pub const PLAN_HEAD: &str = "# Planned by `lissom plan`";

/// Writes a `plan.toml`, completely or not at all.
///
/// # Errors
/// As [`write_whole`](super::write_whole).
pub fn write_plan(path: &Path, plan: &Plan) -> Result<(), WriteError> {
    write_text(path, &plan_text(plan))
}

/// The text of a `plan.toml` that [`PlanFile`](crate::PlanFile) reads. Its comments give the purpose of each run and
/// the expected standard errors.
pub fn plan_text(plan: &Plan) -> String {
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = put(&mut text, plan);
    text
}

fn put(text: &mut String, plan: &Plan) -> fmt::Result {
    let waited: f64 = plan.runs.iter().map(|r| r.waited_s).sum();
    writeln!(
        text,
        "{PLAN_HEAD}: runs: {}, {:.0} s in total, of which {waited:.0} s are waiting for transients to decay.",
        plan.runs.len(),
        plan.time_s
    )?;
    writeln!(text, "settle = {{ longest = \"{} s\" }}", plan.longest_wait_s)?;
    for run in &plan.runs {
        writeln!(text)?;
        why(text, run)?;
        entry(text, run)?;
    }
    writeln!(text, "\n# Expected relative standard errors:")?;
    for e in &plan.expected {
        writeln!(
            text,
            "#   {}: {}, {} wanted",
            e.parameter.name(),
            percent(e.std),
            percent(e.wanted)
        )?;
    }
    for note in &plan.notes {
        writeln!(text, "# {}: {note}", if note.is_warning() { "warning" } else { "note" })?;
    }
    Ok(())
}

fn why(text: &mut String, run: &PlannedRun) -> fmt::Result {
    writeln!(
        text,
        "# up to {:.2} A; the motor moves by ±{:.3} rad; the joint sticks for {:.1} % of the time",
        run.peak_current_a,
        run.moved_rad,
        100.0 * run.stuck_share
    )?;
    writeln!(text, "# {}", run.in_words())
}

fn entry(text: &mut String, run: &PlannedRun) -> fmt::Result {
    let amplitude = run.amplitude_rad;
    let periods = run.motion.periods(run.record_s);
    writeln!(text, "[[runs]]")?;
    match run.motion {
        PlannedMotion::Sine { omega_rad_s } => writeln!(
            text,
            "sine = {{ omega_rad_s = {omega_rad_s:?}, amplitude = \"{amplitude} rad\" }}"
        )?,
        PlannedMotion::Multisine { omega_rad_s, to_rad_s, phases } => writeln!(
            text,
            "multisine = {{ omega_rad_s = {omega_rad_s:?}, to = {to_rad_s:?}, \
             amplitude = \"{amplitude} rad\", phases = {phases} }}\nsettle = \"none\""
        )?,
        PlannedMotion::Chirp { from_rad_s, to_rad_s, .. } => writeln!(
            text,
            "chirp = {{ from = {from_rad_s:?}, to = {to_rad_s:?}, amplitude = \"{amplitude} rad\" }}\n\
             settle = \"none\""
        )?,
    }
    match periods {
        Some(periods) => writeln!(text, "periods = {periods}"),
        None => writeln!(text, "record = \"{} s\"", run.record_s),
    }
}
