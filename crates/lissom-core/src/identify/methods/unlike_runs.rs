//! Runs that the other runs do not describe; they are left out first.

use crate::identify::findings::{EstimateUnits, Finding, rows};
use crate::identify::methods::regression::thresholds::UNLIKE_RUNS_MOST;
use crate::identify::methods::regression::{MotorRegression, motor_regression, unlike_others};
use crate::identify::options::Options;
use crate::identify::prepare::prepared::Prepared;
use crate::identify::thresholds::RUNS_LEFT_OUT_OF;

/// The regression of the motor, and the runs that it is of: one after another is left out while it is unlike all others and
/// these are four fifths of all.
pub(crate) fn regression_of_like_runs<'a>(
    mut prepared: Prepared<'a>,
    options: &Options,
) -> (Prepared<'a>, Option<MotorRegression>) {
    let runs = prepared.used().runs.len();
    let most = (UNLIKE_RUNS_MOST * runs as f64) as usize;
    let mut regression = motor_regression(&prepared, options);
    for _ in 0..most {
        let enough = prepared.used().runs.len() >= RUNS_LEFT_OUT_OF;
        let beside = regression.as_ref().filter(|_| enough).map(|r| r.beside_others.as_slice());
        let Some(found) = beside.and_then(unlike_others) else { break };
        let used = prepared.used();
        let finding = rows::UnlikeOthers {
            misfit: found.misfit,
            difference: found.difference,
            unit: EstimateUnits::new(&used.channels).torque(),
        };
        let finding = Finding::of_run(used.runs[found.run].name(), finding);
        prepared = prepared.without(found.run, finding);
        regression = motor_regression(&prepared, options);
    }
    (prepared, regression)
}
