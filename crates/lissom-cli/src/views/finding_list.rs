//! The findings of a result.

use lissom::identify::Finding;

use super::printer::line;
use crate::shared::command_hint::command_hint;

/// Largest number of findings of one kind that are shown one by one.
const SHOWN: usize = 3;

/// Prints the findings in their order, those of one kind together.
pub(crate) fn findings(findings: &[Finding]) {
    if findings.is_empty() {
        line("\nno findings");
        return;
    }
    line("\nfindings");
    let kind = |f: &Finding| (f.code(), f.severity(), f.hint());
    let mut told = Vec::new();
    for finding in findings {
        if told.contains(&kind(finding)) {
            continue;
        }
        told.push(kind(finding));
        let same: Vec<&Finding> = findings.iter().filter(|f| kind(f) == kind(finding)).collect();
        let severity = finding.severity().name();
        for f in same.iter().take(SHOWN) {
            let run = f.run.as_ref().map_or(String::new(), |r| format!(" {r}:"));
            line(&format!("  {severity} [{}]{run} {f}", f.code()));
        }
        if same.len() > SHOWN {
            line(&format!(
                "    … and {} more (all are in the JSON file and on the report page)",
                same.len() - SHOWN
            ));
        }
        if !finding.hint().is_empty() {
            line(&format!("    hint: {}", finding.hint()));
        }
        if let Some(command) = command_hint(finding) {
            line(&format!("    command: {command}"));
        }
    }
}
