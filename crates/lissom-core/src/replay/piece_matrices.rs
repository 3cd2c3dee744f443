//! The matrices of a piece of a sample, from series.

use super::lanes::LANES;
use super::rates::Rates;
use super::series::{Ramp, reach_s, terms, value};
use super::tangents::Tangents;
use super::transition::{Step, StepPack, Transition};

impl<const D: usize> Transition<D> {
    pub(super) fn new(rates: &Rates<D>, duration_s: f64) -> Self {
        let zero = [[0.0; LANES]; D];
        let mut own = Step { phi: [[0.0; D]; D], push: [0.0; D], ramp: [0.0; D] };
        let no_change = StepPack { phi: [zero; D], push: zero, ramp: zero };
        let mut by_parameter = vec![no_change; rates.by_parameter.len()];
        // Column by column: from each unit state, from a unit torque, from a unit ramp.
        for column in 0..D + 2 {
            let mut x = [0.0; D];
            let mut net = Ramp { from: 0.0, slope: 0.0 };
            match column.checked_sub(D) {
                None => x[column] = 1.0,
                Some(0) => net.from = 1.0,
                Some(_) => net.slope = 1.0 / duration_s,
            }
            let (x, tangents) = whole(rates, x, net, duration_s);
            match column.checked_sub(D) {
                None => own.phi[column] = x,
                Some(0) => own.push = x,
                Some(_) => own.ramp = x,
            }
            for (by, pack) in by_parameter.iter_mut().zip(tangents.packs()) {
                match column.checked_sub(D) {
                    None => by.phi.iter_mut().zip(pack).for_each(|(row, v)| row[column] = *v),
                    Some(0) => by.push = *pack,
                    Some(_) => by.ramp = *pack,
                }
            }
        }
        Self { duration_s, own, by_parameter }
    }
}

/// State and tangents by the matrices' parameters after `duration_s`.
fn whole<const D: usize>(
    rates: &Rates<D>,
    mut x: [f64; D],
    mut net: Ramp,
    duration_s: f64,
) -> ([f64; D], Tangents<D>) {
    let parts = (duration_s / reach_s(rates)).ceil().max(1.0);
    let part_s = duration_s / parts;
    let mut tangents = Tangents::new(LANES * rates.by_parameter.len());
    for _ in 0..parts as usize {
        let series = terms(rates, &x, net, part_s);
        tangents.along(rates, &series, net, part_s);
        x = value(&series, part_s);
        net = net.after(part_s);
    }
    (x, tangents)
}
