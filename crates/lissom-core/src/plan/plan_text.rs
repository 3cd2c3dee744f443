//! A plan as text.

use std::fmt;

use super::{Plan, percent};

/// One line for each run with its reason, then the expected precision and the notes.
impl fmt::Display for Plan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let runs = if self.runs.len() == 1 { "run" } else { "runs" };
        writeln!(f, "{} {runs} in {:.0} s", self.runs.len(), self.time_s)?;
        for run in &self.runs {
            let (amplitude, record) = (run.amplitude_rad, run.record_s);
            writeln!(f, "  {}, {amplitude} rad, {record:.1} s: {}", run.motion, run.in_words())?;
        }
        write!(f, "expected standard errors:")?;
        for e in &self.expected {
            let got = if e.std < 1.0 { percent(e.std) } else { "not found".to_owned() };
            write!(f, "\n  {}: {got}, {} requested", e.parameter.name(), percent(e.wanted))?;
        }
        for note in &self.notes {
            let kind = if note.is_warning() { "warning" } else { "note" };
            write!(f, "\n{kind} [{}]: {note}", note.code())?;
        }
        Ok(())
    }
}
