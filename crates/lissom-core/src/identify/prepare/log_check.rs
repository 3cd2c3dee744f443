//! What is found in logs as a whole.

use crate::identify::findings::{Finding, rows};
use crate::identify::prepare::run_analysis::{RunAnalysis, RunKind};
use crate::identify::prepare::thresholds::FOLLOWS_MOTOR;
use crate::record::{Campaign, Run};

/// A command that follows the motor's angle as a position goal does. A sine says nothing: with the wrong sign of one
/// channel, inertia makes it look so.
pub(crate) fn command_follows_motor(campaign: &Campaign, runs: &[RunAnalysis]) -> Option<Finding> {
    let mut sums = [0.0; 3];
    let useful =
        |analysis: &RunAnalysis| analysis.usable && matches!(analysis.kind, RunKind::General);
    for (run, _) in campaign.runs.iter().zip(runs).filter(|(_, analysis)| useful(analysis)) {
        for (sum, of_run) in sums.iter_mut().zip(products(run)) {
            *sum += of_run;
        }
    }
    let [motor, command, both] = sums;
    let correlation = both / (motor * command).sqrt();
    (correlation > FOLLOWS_MOTOR).then(|| Finding::new(rows::CommandFollowsMotor { correlation }))
}

/// Sums of squares of motor and command, and of their products, without their means.
fn products(run: &Run) -> [f64; 3] {
    let n = run.len() as f64;
    let mean = |x: &[f64]| x.iter().sum::<f64>() / n;
    let (motor, command) = (mean(run.motor()), mean(run.command()));
    run.motor().iter().zip(run.command()).fold([0.0; 3], |[mm, uu, mu], (m, u)| {
        let (m, u) = (m - motor, u - command);
        [mm + m * m, uu + u * u, mu + m * u]
    })
}

/// Leaves one finding about uneven stamps for each log, though it may be cut into many runs.
pub(crate) fn one_jitter_for_each_log(findings: &mut Vec<Finding>) {
    let mut reported: Vec<String> = Vec::new();
    findings.retain(|finding| {
        if !finding.is::<rows::Jitter>() {
            return true;
        }
        let run = finding.run.as_deref().unwrap_or_default();
        let log = run.split_once(" [").map_or(run, |(log, _)| log).to_owned();
        let new = !reported.contains(&log);
        reported.push(log);
        new
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identify::prepare::prepared::Prepared;
    use crate::record::{Axis, Channels, Command, CommandQuantity, Hold, TimeBase};

    #[test]
    fn a_goal_is_seen_and_a_current_is_not() {
        let angle = |t: f64| (2.0 * t).sin() + 0.4 * (5.3 * t).sin() + 0.2 * (1.1 * t).cos();
        let times: Vec<f64> = (0..4000).map(|k| 0.005 * f64::from(k)).collect();
        let motor: Vec<f64> = times.iter().map(|&t| angle(t)).collect();
        let goal = times.iter().map(|&t| 3.0 * angle(t + 0.01)).collect();
        let current = times.iter().map(|&t| 0.1 * angle(t + 0.2) - 0.2 * angle(t)).collect();
        for (command, seen) in [(goal, 1), (current, 0)] {
            let command: Vec<f64> = command;
            let jittered = TimeBase { jitter_rms_s: 1e-3, ..TimeBase::uniform(0.0, 0.005) };
            let run =
                |name| Run::new(name, jittered, command.clone(), motor.clone(), vec![]).unwrap();
            let channels = Channels {
                axis: Axis::Rotary,
                command: Command {
                    quantity: CommandQuantity::Arbitrary,
                    hold: Hold::Sampled,
                    torque_per_command: None,
                    back_emf_viscous: 0.0,
                    limit: None,
                },
                tips: Vec::new(),
            };
            let runs = vec![run("a [1/2]"), run("a [2/2]"), run("b")];
            let campaign = Campaign::new(channels, runs).unwrap();
            let prepared = Prepared::of(&campaign);
            let count =
                |code| prepared.findings().iter().filter(|found| found.code() == code).count();
            assert_eq!(count("command-follows-motor"), seen, "{:?}", prepared.findings());
            assert_eq!(count("uneven-stamps"), 2);
        }
    }
}
