//! Sensors that repeat one value while the axis moves.

use std::ops::Range;

use crate::identify::prepare::channel_check::steepest;
use crate::identify::prepare::thresholds::{
    FROZEN_AT_ONCE, FROZEN_AT_SPEED, FROZEN_LONGER, FROZEN_SAMPLES, FROZEN_TRAVEL, MOVED_STEPS,
};
use crate::record::extent::{range, step};

/// The stretch over which a tip's angle takes one value while the `motor` moves on: far longer than it stands anywhere
/// else.
///
/// The other way round it says nothing: a tip rings on while friction holds the motor.
pub(crate) fn frozen_tip(tip: &[f64], motor: &[f64]) -> Option<Range<usize>> {
    let (longest, second) = longest_plateau(tip)?;
    let travel = range(&motor[longest.clone()]);
    let frozen = longest.len() as f64 > FROZEN_LONGER * second? as f64
        && travel > FROZEN_TRAVEL * range(motor)
        && travel > MOVED_STEPS * step(motor);
    frozen.then_some(longest)
}

/// Samples in which a motor's angle stands still at one value, from one sample to the next after it had moved at speed, while
/// the command changes: a motor that friction stops becomes slow first. A sensor that comes back shows another angle at
/// once, and a motor that slips again begins where it stood.
pub(crate) fn frozen_motor(motor: &[f64], command: &[f64]) -> Option<Range<usize>> {
    let (longest, _) = longest_plateau(motor)?;
    let at = longest.start;
    let quantum = step(motor);
    let way = |k: usize, over: usize| (motor[k] - motor[k - over]).abs();
    // Over as few samples as show the speed, and over as many before these.
    let shown = |over: &usize| way(at, *over) > MOVED_STEPS * quantum;
    let over = (1..=at / 2).find(shown)?;
    let comes_back = longest.end == motor.len()
        || (motor[longest.end] - motor[at]).abs() > MOVED_STEPS * quantum;
    let frozen = comes_back
        && longest.len() >= 10 * over
        && way(at, over) > FROZEN_AT_ONCE * way(at - over, over)
        && way(at, over) > FROZEN_AT_SPEED * steepest(motor, quantum) * over as f64
        && deviation(&command[longest.clone()]) > FROZEN_TRAVEL * deviation(command);
    frozen.then_some(longest)
}

/// The longest stretch of one value, of [`FROZEN_SAMPLES`] or more, and the length of the next, if there is one.
fn longest_plateau(samples: &[f64]) -> Option<(Range<usize>, Option<usize>)> {
    let same = |a: &f64, b: &f64| a.total_cmp(b).is_eq();
    let (mut longest, mut second, mut from) = (0..0, None, 0);
    for stretch in samples.chunk_by(same) {
        let found = from..from + stretch.len();
        from = found.end;
        // Of two alike the later one.
        let shorter = if found.len() >= longest.len() {
            std::mem::replace(&mut longest, found)
        } else {
            found
        };
        second = second.max(Some(shorter.len()).filter(|length| *length > 0));
    }
    (longest.len() >= FROZEN_SAMPLES).then_some((longest, second))
}

/// Standard deviation.
fn deviation(samples: &[f64]) -> f64 {
    let mean = samples.iter().sum::<f64>() / samples.len() as f64;
    let sum: f64 = samples.iter().map(|x| (x - mean).powi(2)).sum();
    (sum / samples.len() as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sine(limit: f64) -> Vec<f64> {
        (0..4000).map(|k| (0.02 * f64::from(k)).sin().clamp(-limit, limit)).collect()
    }

    #[test]
    fn a_sensor_that_freezes_is_told_from_one_that_rests() {
        let motor = sine(2.0);
        let mut tip: Vec<f64> = motor.iter().map(|v| (v / 0.003).round() * 0.003).collect();
        assert_eq!(frozen_tip(&tip, &motor), None);
        // The whole arm rests.
        let mut rests = (motor.clone(), tip.clone());
        rests.0.extend(vec![0.3; 2000]);
        rests.1.extend(vec![0.3; 2000]);
        assert_eq!(frozen_tip(&rests.1, &rests.0), None);
        // It rings on while friction holds the motor.
        let mut held = motor.clone();
        held[2000..].fill(motor[2000]);
        assert_eq!(frozen_tip(&tip, &held), None);
        tip[1500..2500].fill(0.123);
        assert_eq!(frozen_tip(&tip, &motor), Some(1500..2500));
    }

    /// A motor whose sensor freezes at speed, and one that friction stops.
    #[test]
    fn a_motor_whose_sensor_freezes_is_told_from_one_that_stops() {
        let command = sine(1.0);
        let motor = sine(2.0);
        assert_eq!(frozen_motor(&motor, &command), None);
        let fastest = |k: &usize| motor[*k].abs() < 0.02 && *k > 1000;
        let from = (0..motor.len()).find(fastest).expect("it passes zero");
        let mut frozen = motor.clone();
        frozen[from..].fill(motor[from]);
        assert_eq!(frozen_motor(&frozen, &command), Some(from..motor.len()));
        // It comes back, or the motor had stopped at once and begins where it stood.
        frozen[from + 900..].copy_from_slice(&motor[from + 900..]);
        assert_eq!(frozen_motor(&frozen, &command), Some(from..from + 900));
        for (k, angle) in frozen[from + 900..].iter_mut().enumerate() {
            *angle = motor[from] + 1e-4 * k as f64;
        }
        assert_eq!(frozen_motor(&frozen, &command), None);
        // Slower and slower over 400 samples.
        let mut stopped = motor.clone();
        let speed = motor[from] - motor[from - 1];
        for (k, angle) in stopped[from..].iter_mut().enumerate() {
            let x = (k as f64).min(400.0);
            *angle = motor[from] + speed * (x - x * x / 800.0);
        }
        assert_eq!(frozen_motor(&stopped, &command), None);
    }
}
