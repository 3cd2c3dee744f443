//! Tips that are read later than the motor: what they show was between two samples of the replay.

use std::ops::RangeInclusive;

use super::parameter::Parameter;
use super::window::{Replayer, Seen};
use crate::record::TipQuantity;

/// Share of a sample by which a reading may lie before the two samples that tell it: a lag of whole samples, a bit
/// more or less, is told by the same two.
const BEFORE: f64 = 0.1;

/// The tips of a window that are late, each with what its point showed at the sample before.
pub(super) struct LateTips {
    tips: Vec<Option<LateTip>>,
    /// Samples of the window.
    samples: RangeInclusive<usize>,
}

struct LateTip {
    /// Two samples tell the reading that lies this many behind the first of them…
    behind: isize,
    /// …and was taken of what the point did so much of a sample after that first one.
    share: f64,
    /// Which unknown the lag is.
    lag: Option<usize>,
    before: Ends,
    now: Ends,
}

/// What a tip's point shows at one of two samples, how fast that changes, and the derivatives of both.
#[derive(Default)]
struct Ends {
    known: bool,
    value: f64,
    rate: f64,
    row: Vec<f64>,
    rate_row: Vec<f64>,
}

impl LateTips {
    /// Those of a window. An acceleration has no rate, and is taken as it is logged.
    pub(super) fn new<const D: usize>(
        replayer: &Replayer<'_, D>,
        samples: RangeInclusive<usize>,
        with_tangents: bool,
    ) -> Self {
        let of = |tip: usize| {
            let lag = Parameter::TipLag(tip);
            let samples = lag.of(replayer.arm()) / replayer.sample_time_s();
            let shows = replayer.quantity(tip) != TipQuantity::Acceleration;
            let behind = (samples - BEFORE).ceil();
            (shows && samples != 0.0).then(|| {
                let rows = || if with_tangents { replayer.row() } else { Vec::new() };
                let ends = || Ends { row: rows(), rate_row: rows(), ..Ends::default() };
                LateTip {
                    behind: behind as isize,
                    share: behind - samples,
                    lag: replayer.parameters().iter().position(|p| *p == lag),
                    before: ends(),
                    now: ends(),
                }
            })
        };
        Self { tips: (0..replayer.tips()).map(of).collect(), samples }
    }

    /// Which reading of a channel (0: motor, then tips) is told at a sample of the replay, and what is predicted of it,
    /// with its derivatives in a [`Replayer::row`] where one is given. To be asked at every sample in turn. `None`
    /// where the reading is outside of the window.
    pub(super) fn output<const D: usize>(
        &mut self,
        replayer: &Replayer<'_, D>,
        seen: &Seen<'_, D>,
        channel: usize,
        row: Option<&mut [f64]>,
    ) -> Option<(usize, f64)> {
        let late = channel.checked_sub(1).and_then(|tip| Some((tip, self.tips[tip].as_mut()?)));
        let Some((tip, late)) = late else {
            return Some((seen.sample, replayer.output(seen, channel, row)));
        };
        std::mem::swap(&mut late.before, &mut late.now);
        let now = &mut late.now;
        now.known = true;
        if row.is_some() {
            now.value = replayer.output(seen, channel, Some(&mut now.row));
            now.rate = replayer.rate(seen, tip, Some(&mut now.rate_row));
        } else {
            now.value = replayer.output(seen, channel, None);
            now.rate = replayer.rate(seen, tip, None);
        }
        let told = seen.sample.checked_add_signed(late.behind - 1)?;
        if !late.before.known || !self.samples.contains(&told) {
            return None;
        }
        Some((told, late.between(replayer.sample_time_s(), row)))
    }

    /// Whether what a channel shows at a sample of the replay is its reading there.
    pub(super) fn is_in_time(&self, channel: usize) -> bool {
        channel.checked_sub(1).is_none_or(|tip| self.tips[tip].is_none())
    }
}

impl LateTip {
    /// By the cubic that has both values and both rates: with ω·T of a mode it errs by (ω·T)⁴/384 of what that mode
    /// moves the tip.
    fn between(&self, sample_s: f64, row: Option<&mut [f64]>) -> f64 {
        let (a, b, s) = (&self.before, &self.now, self.share);
        let by = [(1.0 + 2.0 * s) * (1.0 - s).powi(2), s * s * (3.0 - 2.0 * s)];
        let by_rate = [s * (1.0 - s).powi(2), s * s * (s - 1.0)].map(|w| w * sample_s);
        let at = |value: [f64; 2], rate: [f64; 2]| {
            by[0] * value[0] + by[1] * value[1] + by_rate[0] * rate[0] + by_rate[1] * rate[1]
        };
        if let Some(row) = row {
            for (i, own) in row.iter_mut().enumerate() {
                *own = at([a.row[i], b.row[i]], [a.rate_row[i], b.rate_row[i]]);
            }
            if let Some(lag) = self.lag {
                let slope = 6.0 * s * (1.0 - s) * (b.value - a.value) / sample_s;
                let of_rates = (1.0 - s) * (1.0 - 3.0 * s) * a.rate + s * (3.0 * s - 2.0) * b.rate;
                row[lag] = -(slope + of_rates);
            }
        }
        at([a.value, b.value], [a.rate, b.rate])
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{SAMPLES, T, arm, late_log_of, window};
    use super::super::{ModalArm, SensorNoise, Window, costs, predict, sums};
    use super::*;
    use crate::record::{Campaign, Hold};
    use crate::replay::Sampling;
    use crate::rig::Hybrid;

    /// Two tips whose logs are 0.3 of a sample late, in a window that begins once the motor turns.
    fn late(hold: Hold, quantity: TipQuantity) -> (ModalArm, Campaign, Window) {
        let arm = arm();
        let model = ModalArm::of_arm(&arm).unwrap();
        let (campaign, states, _) = late_log_of(Hybrid::at_rest(&arm), hold, quantity, 0.3);
        let from = states.iter().position(|x| x[1].abs() > 0.05).unwrap();
        let window = window(&model, &states, from, SAMPLES - 1);
        (model, campaign, window)
    }

    /// Against the event engine, which is asked at that time.
    #[test]
    fn a_late_tip_shows_what_its_point_did_before() {
        for quantity in [TipQuantity::Angle, TipQuantity::Deflection] {
            let (mut model, campaign, window) = late(Hold::Sampled, quantity);
            let run = &campaign.runs[0];
            let swing = run.tips()[1].iter().fold(0.0_f64, |most, y| most.max(y.abs()));
            // As logged, and with readings two samples later or earlier still.
            for (lag, later) in [(0.3, 0), (2.3, 2), (-1.7, -2_isize)] {
                model.tip_lags_s = vec![lag * T; 2];
                let found = predict(&model, &campaign, &window).unwrap();
                let (from, told) = (*window.samples.start(), 3..window.len() - 3);
                let worst = told.flat_map(|k| (0..2).map(move |tip| (k, tip))).map(|(k, tip)| {
                    let logged = run.tips()[tip][(from + k).checked_add_signed(-later).unwrap()];
                    (found.channels[1 + tip][k] - logged).abs()
                });
                let worst = worst.fold(0.0, f64::max);
                assert!(worst < 1e-5 * swing, "{quantity:?} {lag}: {worst} of {swing}");
            }
        }
    }

    /// The cost's slope by a lag, and by what a late tip's readings show of the rest, against differences.
    #[test]
    fn derivatives_of_a_late_tip_are_exact() {
        let parameters = [
            Parameter::Inertia,
            Parameter::TipLag(1),
            Parameter::Frequency(0),
            Parameter::Shape(1, 0),
            Parameter::TipLag(0),
        ];
        for (hold, lags) in [(Hold::Sampled, [1.2, -0.6]), (Hold::Measured, [0.0, 0.45])] {
            let (mut model, campaign, window) = late(hold, TipQuantity::Angle);
            model.tip_lags_s = lags.map(|lag| lag * T).to_vec();
            let noise = [SensorNoise::gaussian(1e-3); 3];
            let masks = [vec![None; 3]];
            let sampling =
                Sampling { noise: &noise, blocks: &[], masks: &masks, command_noise: 0.0 };
            let windows = [window];
            let found = &sums(&model, &parameters, &campaign, &windows, sampling)[0];
            let cost = |model: &ModalArm| costs(model, &campaign, &windows, sampling)[0].cost;
            for (i, p) in parameters.iter().enumerate() {
                if lags.contains(&0.0) && *p == Parameter::TipLag(0) {
                    // The next reading tells of another sample: a difference is none.
                    continue;
                }
                let step = 1e-5 * p.of(&model).abs();
                let moved = |change: f64| {
                    let mut moved = model.clone();
                    p.set(&mut moved, p.of(&model) + change);
                    cost(&moved)
                };
                let slope = (moved(step) - moved(-step)) / (2.0 * step);
                let last = found.gram.ncols() - 1;
                let by_sums = -2.0 * found.gram[(i, last)];
                let size = (found.gram[(i, i)] * found.gram[(last, last)]).sqrt();
                assert!((slope - by_sums).abs() < 1e-5 * size, "{p:?} {slope} {by_sums} {size}");
            }
        }
    }
}
