//! A validation as text.

use std::fmt;

use super::Validation;

/// The quality of the predicted torque and motion, and the findings.
impl fmt::Display for Validation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.torque {
            None => write!(f, "the torque is not predicted")?,
            Some(torque) => {
                write!(f, "torque: residual {:.2} %", 100.0 * torque.relative_error)?;
                if let Some(expected) = torque.expected_error {
                    write!(f, ", {:.2} % expected if the arm is right", 100.0 * expected)?;
                }
            }
        }
        for horizon in &self.horizons {
            let over = if horizon.whole_runs {
                "whole runs".to_owned()
            } else {
                format!("{:.2} s", horizon.length_s)
            };
            let fits: Vec<String> =
                horizon.channels.iter().map(|c| format!("{:.2} %", c.fit_percent)).collect();
            write!(f, "\nmotion over {over}: fit {}", fits.join(", "))?;
        }
        for finding in &self.findings {
            write!(f, "\n{} [{}]: {finding}", finding.severity().name(), finding.code())?;
        }
        Ok(())
    }
}
