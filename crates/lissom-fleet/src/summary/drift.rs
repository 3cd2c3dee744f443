//! Machines whose parameter changes over time, more than that of the others.

use lissom_io::fleet::{Drift, DriftValue};

use super::chances::{discoveries, normal_deviation, tails};
use super::log_value::LogValue;
use super::machines::Machine;
use super::robust::scale;

/// From so many machines on, the scatter of their slopes says what is normal.
const MACHINES_LEAST: usize = 20;

/// Machines that drift, the largest changes first, and the spread of all changes over their standard errors, if there are many
/// machines.
pub(super) fn drifts(machines: &[Machine<'_>], rate: f64) -> (Vec<Drift>, Option<f64>) {
    let lines: Vec<&Machine<'_>> = machines.iter().filter(|m| m.has_line()).collect();
    let own = lines.iter().map(|m| {
        let (change, std) = m.change().unwrap_or((0.0, f64::INFINITY));
        normal_deviation(change / std, m.variance.1)
    });
    let own: Vec<f64> = own.collect();
    let many = own.len() >= MACHINES_LEAST;
    let spread = scale(own.iter().copied()).filter(|_| many);
    let compared: Vec<f64> = own.iter().map(|z| z / spread.unwrap_or(1.0).max(1.0)).collect();
    let chances: Vec<f64> = compared.iter().map(|z| tails(*z)).collect();
    let chosen = discoveries(&chances, rate);
    let found = lines.iter().zip(&compared).zip(chosen).filter(|(_, chosen)| *chosen);
    let mut drifts: Vec<Drift> = found.filter_map(|((machine, z), _)| drift(machine, *z)).collect();
    let size = |drift: &Drift| drift.relative_change.map_or(f64::INFINITY, f64::abs);
    drifts.sort_by(|a, b| size(b).total_cmp(&size(a)));
    (drifts, spread)
}

fn drift(machine: &Machine<'_>, z: f64) -> Option<Drift> {
    let (change, change_std) = machine.change()?;
    let level = machine.level();
    let value = |v: &LogValue<'_>| {
        let (log, time_us) = (v.log.to_owned(), v.time_us?);
        Some(DriftValue { log, time_us, value: v.value, std: v.std })
    };
    let mut values: Vec<DriftValue> = machine.values.iter().filter_map(value).collect();
    values.sort_by_key(|value| value.time_us);
    Some(Drift {
        machine: machine.name?.to_owned(),
        values,
        level,
        first: machine.first(),
        change,
        change_std,
        relative_change: relative(change, level),
        z,
    })
}

fn relative(change: f64, level: f64) -> Option<f64> {
    Some(change / level.abs()).filter(|ratio| ratio.is_finite())
}
