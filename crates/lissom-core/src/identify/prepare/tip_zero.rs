//! Reading of a tip's sensor when the beam is straight: the zeros of two encoders are seldom equal.

use std::f64::consts::PI;

use crate::identify::findings::{Channel, Finding, rows};
use crate::identify::prepare::thresholds::{TIP_ZERO_REPORTED, TIP_ZERO_SHOWN};
use crate::record::{Campaign, Run, Tip, TipQuantity};

/// Windows that a run is covered with, each overlapping half of the next.
const WINDOWS: usize = 19;
/// Fewest samples of a window.
const SAMPLES_LEAST: usize = 20;

/// The zero of one tip in one run.
#[derive(Debug, Clone, Copy, PartialEq)]
struct TipZero {
    /// Reading of an undeflected beam relative to the motor, in the tip's unit.
    value: f64,
    /// Root mean square of the deflection about it.
    deflection: f64,
}

/// Takes the zero of each tip off its readings, by run, where the log shows one; `None` where no log does.
///
/// A beam that nothing holds bends only with the acceleration. Under windows long enough for its vibration
///
/// ```text
/// ⟨y − θ⟩ = z + a·⟨θ̈⟩
/// ```
///
/// with y the tip's angle and θ the motor's; z is the zero. It is taken off where it is many standard errors from
/// nothing. Otherwise κ·z would be taken for a constant load.
pub(crate) fn without_tip_zeros(campaign: &Campaign) -> Option<(Campaign, Vec<Finding>)> {
    let tips = &campaign.channels.tips;
    let zeros = of_runs(campaign);
    if zeros.iter().flatten().all(Option::is_none) {
        return None;
    }
    let corrected = |(run, zeros): (&Run, &Vec<Option<TipZero>>)| {
        let tips = run.tips().iter().zip(zeros).map(|(tip, zero)| {
            let value = zero.map_or(0.0, |z| z.value);
            tip.iter().map(|y| y - value).collect()
        });
        let (command, motor) = (run.command().to_vec(), run.motor().to_vec());
        Run::new(run.name(), run.time(), command, motor, tips.collect()).ok()
    };
    let runs = campaign.runs.iter().zip(&zeros).map(corrected).collect::<Option<_>>()?;
    let findings = (0..tips.len()).filter_map(|i| reported(&tips[i], &zeros, i)).collect();
    Some((Campaign { runs, ..campaign.clone() }, findings))
}

/// What [`without_tip_zeros`] takes off, by run and tip.
pub(crate) fn tip_zeros(campaign: &Campaign) -> Vec<Vec<f64>> {
    let value = |zero: Option<TipZero>| zero.map_or(0.0, |z| z.value);
    of_runs(campaign).into_iter().map(|run| run.into_iter().map(value).collect()).collect()
}

fn of_runs(campaign: &Campaign) -> Vec<Vec<Option<TipZero>>> {
    let tips = &campaign.channels.tips;
    let of_run = |run: &Run| (0..tips.len()).map(|i| zero(&tips[i], run, i)).collect();
    campaign.runs.iter().map(of_run).collect()
}

/// A finding where the zero is no small part of what the beam bends by.
fn reported(tip: &Tip, zeros: &[Vec<Option<TipZero>>], i: usize) -> Option<Finding> {
    let of_tip = zeros.iter().filter_map(|run| run[i]);
    let largest = of_tip.max_by(|a, b| a.value.abs().total_cmp(&b.value.abs()))?;
    (largest.value.abs() > TIP_ZERO_REPORTED * largest.deflection).then(|| {
        let channel = Channel::Tip(tip.name.clone());
        Finding::new(rows::TipZero { channel, value: largest.value })
    })
}

fn zero(tip: &Tip, run: &Run, i: usize) -> Option<TipZero> {
    if !tip.calibrated || tip.quantity == TipQuantity::Acceleration {
        return None;
    }
    let deflects = tip.quantity == TipQuantity::Deflection;
    let (motor, readings) = (run.motor(), &run.tips()[i]);
    let step = run.len() / (WINDOWS + 1);
    let n = 2 * step;
    if n < SAMPLES_LEAST {
        return None;
    }
    // sin⁴ and its second derivative by the sample.
    let rate = PI / n as f64;
    let weights: Vec<[f64; 2]> = (0..n)
        .map(|k| {
            let (s, c) = (rate * k as f64).sin_cos();
            [s.powi(4), rate * rate * (12.0 * s * s * c * c - 4.0 * s.powi(4))]
        })
        .collect();
    let area: f64 = weights.iter().map(|w| w[0]).sum();
    let rows: Vec<[f64; 2]> = (0..WINDOWS)
        .map(|k| {
            let samples = (k * step..).zip(&weights);
            let row = samples.fold([0.0; 2], |[bent, turned], (j, w)| {
                let own = if deflects { readings[j] } else { readings[j] - motor[j] };
                [bent + w[0] * own, turned + w[1] * motor[j]]
            });
            row.map(|sum| sum / area)
        })
        .collect();
    let [value, std, deflection] = intercept(&rows)?;
    (value.abs() > TIP_ZERO_SHOWN * std).then_some(TipZero { value, deflection })
}

/// Intercept of the line through (turned, bent), its standard error, and the root mean square of bent about it.
fn intercept(rows: &[[f64; 2]]) -> Option<[f64; 3]> {
    let n = rows.len() as f64;
    let mean = |c: usize| rows.iter().map(|r| r[c]).sum::<f64>() / n;
    let (bent, turned) = (mean(0), mean(1));
    let (mut square, mut product) = (0.0, 0.0);
    for [b, t] in rows {
        square += (t - turned).powi(2);
        product += (t - turned) * (b - bent);
    }
    let slope = if square > 0.0 { product / square } else { 0.0 };
    let value = bent - slope * turned;
    let left: f64 = rows.iter().map(|[b, t]| (b - value - slope * t).powi(2)).sum();
    let leverage = if square > 0.0 { turned * turned / square } else { 0.0 };
    let std = (left / (n - 2.0) * (1.0 / n + leverage)).sqrt();
    let deflection = (rows.iter().map(|[b, _]| (b - value).powi(2)).sum::<f64>() / n).sqrt();
    [value, std, deflection].iter().all(|v| v.is_finite()).then_some([value, std, deflection])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::{Axis, Channels, Command, CommandQuantity, Hold, TimeBase};

    /// A motor that moves and a tip whose zero is elsewhere, the beam with a mode at 20 rad/s and a tenth of noise.
    fn campaign(zero: f64, quantity: TipQuantity) -> Campaign {
        let time = |k: usize| 0.002 * k as f64;
        let motor: Vec<f64> =
            (0..6000).map(|k| (1.3 * time(k)).sin() + 0.2 * (4.1 * time(k)).cos()).collect();
        let tip = (0..6000)
            .map(|k| {
                let acceleration =
                    -1.69 * (1.3 * time(k)).sin() - 0.2 * 16.81 * (4.1 * time(k)).cos();
                let noise = 1e-4 * (12.9898 * k as f64).sin();
                let bent = zero - acceleration / 400.0 + 2e-3 * (20.0 * time(k)).sin() + noise;
                bent + if quantity == TipQuantity::Deflection { 0.0 } else { motor[k] }
            })
            .collect();
        let command = Command {
            quantity: CommandQuantity::Current,
            hold: Hold::Measured,
            torque_per_command: Some(1.0),
            back_emf_viscous: 0.0,
            limit: None,
        };
        let tips = vec![Tip { name: "load".into(), quantity, calibrated: true }];
        let run = Run::new("a", TimeBase::uniform(0.0, 0.002), motor.clone(), motor, vec![tip]);
        Campaign::new(Channels { axis: Axis::Rotary, command, tips }, vec![run.unwrap()]).unwrap()
    }

    #[test]
    fn another_zero_is_taken_off() {
        for quantity in [TipQuantity::Angle, TipQuantity::Deflection] {
            let straight = campaign(0.0, quantity);
            let (found, findings) = without_tip_zeros(&campaign(0.3, quantity)).unwrap();
            let difference = found.runs[0].tips()[0][100] - straight.runs[0].tips()[0][100];
            assert!(difference.abs() < 1e-3, "{difference}");
            assert_eq!(findings.len(), 1);
            assert!(findings[0].is::<rows::TipZero>());
        }
    }

    #[test]
    fn a_beam_that_is_straight_keeps_its_readings() {
        assert!(without_tip_zeros(&campaign(0.0, TipQuantity::Angle)).is_none());
    }
}
