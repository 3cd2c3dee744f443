//! A delay of the command as a further term of the motor's equation.

use crate::identify::estimate::Estimate;
use crate::identify::methods::regression::motor_columns::MotorColumns;
use crate::identify::methods::regression::normal::{Cluster, Solution, Term, solve};

/// The solution with a delay of the command as the last term.
fn with_delay(clusters: &[Cluster], terms: &[Term], columns: &MotorColumns) -> Option<Solution> {
    let delay = Term::Plain(columns.count());
    let with: Vec<Term> = terms.iter().copied().chain([delay]).collect();
    solve(clusters, &with)
}

/// Delay of the command \[s\] in addition to the other terms.
pub(super) fn extra_delay(
    clusters: &[Cluster],
    terms: &[Term],
    columns: &MotorColumns,
) -> Option<Estimate> {
    let solution = with_delay(clusters, terms, columns)?;
    let last = terms.len();
    let std = solution.covariance[(last, last)].max(0.0).sqrt();
    // The column is the rate of the torque, with which the torque of an earlier time is made.
    (!solution.inseparable[last]).then(|| Estimate { value: -solution.value[last], std })
}
