//! Logs that differ from the other logs of their machine, and machines that differ from the others.

use lissom_io::fleet::{LogOutlier, MachineOutlier};

use super::chances::{discoveries, normal_deviation, tails};
use super::machines::Machine;
use super::robust::{center_and_scales, median, scale};

/// Smallest deviation of an outlier, in scales (Iglewicz and Hoaglin, How to Detect and Handle Outliers, 1993).
const LEAST: f64 = 3.5;
/// Smallest number of machines, or of logs, that say what is normal.
const COMPARED_LEAST: usize = 10;
/// Efficiency of the median absolute deviation for normal values: its scale is as certain as that of so many of them.
const MAD_EFFICIENCY: f64 = 0.37;

/// Logs and machines that differ, the largest deviations first. With `rate`, of those found this share is expected to be
/// chance.
pub(super) fn outliers(
    machines: &[Machine<'_>],
    rate: f64,
) -> (Vec<LogOutlier>, Vec<MachineOutlier>) {
    let mut logs = within_machines(machines, rate);
    let (alone, machines) = between_machines(machines, rate);
    logs.extend(alone);
    logs.sort_by(|a, b| b.z.abs().total_cmp(&a.z.abs()));
    (logs, machines)
}

/// Which deviations are more than chance, and those in scales of all.
fn chosen(deviations: &[f64], rate: f64) -> Vec<bool> {
    let chances: Vec<f64> = deviations.iter().map(|z| tails(*z)).collect();
    let found = discoveries(&chances, rate).into_iter().zip(deviations);
    found.map(|(found, z)| found && z.abs() >= LEAST).collect()
}

/// Logs that differ from the other logs of their machine.
fn within_machines(machines: &[Machine<'_>], rate: f64) -> Vec<LogOutlier> {
    let several = machines.iter().filter(|m| m.variance.1 > 1.0 && m.values.len() > 2);
    let all: Vec<_> = several
        .flat_map(|machine| {
            let freedom = machine.variance.1;
            machine.deviations().map(move |(value, expected, t)| {
                (machine, value, expected, normal_deviation(t, freedom))
            })
        })
        .collect();
    // Heavy tails of the logs make the scale larger than one.
    let scale = scale(all.iter().map(|(.., z)| *z)).unwrap_or(1.0).max(1.0);
    let deviations: Vec<f64> = all.iter().map(|(.., z)| z / scale).collect();
    let found = all.iter().zip(&deviations).zip(chosen(&deviations, rate));
    let found = found.filter(|(_, chosen)| *chosen).map(|((entry, z), _)| {
        let (machine, value, expected, _) = entry;
        LogOutlier {
            log: value.log.to_owned(),
            machine: machine.name.map(str::to_owned),
            value: value.value,
            std: value.std,
            expected: *expected,
            z: *z,
        }
    });
    found.collect()
}

/// Logs of unknown machines, and machines, that differ from the others.
fn between_machines(machines: &[Machine<'_>], rate: f64) -> (Vec<LogOutlier>, Vec<MachineOutlier>) {
    let levels: Vec<f64> = machines.iter().map(Machine::level).collect();
    let Some((center, [below, above])) =
        center_and_scales(&levels).filter(|_| levels.len() >= COMPARED_LEAST)
    else {
        return (Vec::new(), Vec::new());
    };
    let own = |m: &Machine<'_>| median(m.values.iter().map(|v| v.std * v.std)).unwrap_or(0.0);
    let typical = median(machines.iter().map(own)).unwrap_or(0.0);
    // Each scale is of half of the machines.
    let freedom = MAD_EFFICIENCY * 0.5 * levels.len() as f64;
    let deviations: Vec<f64> = machines
        .iter()
        .zip(&levels)
        .map(|(machine, level)| {
            let scale = if *level < center { below } else { above };
            // An estimate that is less certain than others deviates more by chance.
            let uncertain = (own(machine) - typical).max(0.0);
            // Machines that agree better than their estimates are certain do so by chance.
            let variance = (scale * scale).max(typical) + uncertain;
            normal_deviation((level - center) / variance.sqrt(), freedom)
        })
        .collect();
    let (mut logs, mut differ) = (Vec::new(), Vec::new());
    let found = machines.iter().zip(&deviations).zip(chosen(&deviations, rate));
    for ((machine, z), _) in found.filter(|(_, chosen)| *chosen) {
        match (machine.name, machine.values.first()) {
            (Some(name), _) => differ.push(MachineOutlier {
                machine: name.to_owned(),
                logs: machine.values.len(),
                value: machine.level(),
                expected: center,
                z: *z,
            }),
            (None, Some(value)) => logs.push(LogOutlier {
                log: value.log.to_owned(),
                machine: None,
                value: value.value,
                std: value.std,
                expected: center,
                z: *z,
            }),
            (None, None) => {}
        }
    }
    differ.sort_by(|a, b| b.z.abs().total_cmp(&a.z.abs()));
    (logs, differ)
}
