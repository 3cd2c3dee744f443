//! A result as text.

use std::fmt;

use lissom_io::{ParameterList, ResultFile};

use crate::parameter_text;

/// A `result.json` as text: the method, a table with 95 % intervals, the verdict, and the findings.
///
/// ```
/// use lissom::prelude::*;
/// # let arm = Arm::builder().motor(Motor::builder().inertia_kg_m2(2e-3)).coulomb_nm(0.02).build()?;
/// # let rig = Rig::builder(arm).sample_time_s(3e-3).controller(Pd::new(8.0, 0.25)?).build()?;
/// # let logs = rig.campaign([1.0, 3.0].map(|w| Experiment::sine(w, 0.5, 20.0)))?;
/// let found = Identify::new(&logs).effort(Effort::Quick).run()?;
/// let text = lissom::ResultText(&found.file()).to_string();
/// assert!(text.contains("inertia") && text == found.to_string());
/// # Ok::<(), lissom::Error>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct ResultText<'r>(pub &'r ResultFile);

impl fmt::Display for ResultText<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let file = self.0;
        let list = ParameterList::of(file);
        if let Some(method) = file.from {
            writeln!(f, "estimates by {}", method.words())?;
        }
        parameter_text::table(f, &list)?;
        for words in file.verdict.iter().flat_map(|verdict| &verdict.words) {
            write!(f, "\n{words}")?;
        }
        for finding in &file.findings {
            let run = finding.run.as_ref().map_or(String::new(), |run| format!(" {run}:"));
            let (severity, code) = (finding.severity.name(), &finding.code);
            write!(f, "\n{severity} [{code}]{run} {}", finding.message)?;
        }
        Ok(())
    }
}
