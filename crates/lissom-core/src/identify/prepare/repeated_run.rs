//! Detects runs that are copies of other runs.

use crate::identify::findings::{Finding, rows};
use crate::record::{Campaign, Run};

/// Whether a run is one before it once more, to the last bit: it knows nothing new.
pub(crate) fn repeats(campaign: &Campaign, index: usize, findings: &mut Vec<Finding>) -> bool {
    let run = &campaign.runs[index];
    let same = |other: &&Run| {
        other.command() == run.command()
            && other.motor() == run.motor()
            && other.tips() == run.tips()
    };
    let Some(first) = campaign.runs[..index].iter().find(same) else { return false };
    let found = rows::RepeatedRun { first: first.name().to_owned() };
    findings.push(Finding::of_run(run.name(), found));
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::{Axis, Channels, Command, CommandQuantity, Hold, TimeBase};

    #[test]
    fn a_run_listed_twice_counts_once() {
        let wave = |rate: f64| (0..200).map(|k| (rate * f64::from(k)).sin()).collect::<Vec<f64>>();
        let run = |name: &str, rate: f64| {
            Run::new(name, TimeBase::uniform(0.0, 0.01), wave(rate), wave(rate), vec![]).unwrap()
        };
        let command = Command {
            quantity: CommandQuantity::Current,
            hold: Hold::Measured,
            torque_per_command: None,
            back_emf_viscous: 0.0,
            limit: None,
        };
        let channels = Channels { axis: Axis::Rotary, command, tips: vec![] };
        let runs = vec![run("a", 0.1), run("b", 0.2), run("c", 0.1)];
        let campaign = Campaign::new(channels, runs).unwrap();
        let mut findings = Vec::new();
        let repeated: Vec<bool> = (0..3).map(|i| repeats(&campaign, i, &mut findings)).collect();
        assert_eq!(repeated, [false, false, true]);
        assert!(findings.len() == 1 && findings[0].message().contains("those of a"));
    }
}
