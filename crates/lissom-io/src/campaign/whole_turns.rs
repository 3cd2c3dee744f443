//! Absolute encoders that start again after each turn.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// A jump without its turn may be at most this many times the largest other step.
const LIKE_OTHER_STEPS: f64 = 1.5;

/// Removes jumps of one turn from an angle in rad, and counts them.
///
/// A jump is removed if the step without the turn is like the other steps, and these are less than a quarter of a turn.
pub(super) fn remove_turns(angle: &mut [f64]) -> usize {
    let steps = angle.windows(2).map(|pair| (pair[1] - pair[0]).abs());
    if !steps.clone().any(|step| step > PI) {
        return 0;
    }
    let largest = steps.filter(|step| *step <= PI).fold(0.0, f64::max);
    if largest > FRAC_PI_2 {
        return 0;
    }
    let (mut turns, mut count) = (0.0, 0);
    let mut before = angle.first().copied().unwrap_or(0.0);
    for value in angle {
        let step = *value - before;
        before = *value;
        if step.abs() > PI && (step.abs() - TAU).abs() <= LIKE_OTHER_STEPS * largest {
            turns -= step.signum();
            count += 1;
        }
        *value += TAU * turns;
    }
    count
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_are_removed_in_both_directions_and_other_jumps_are_kept() {
        let motion: Vec<f64> = (0..1000).map(|k| 20.0 * (f64::from(k) * 0.01).sin()).collect();
        let mut wrapped: Vec<f64> = motion.iter().map(|q| (q + PI).rem_euclid(TAU) - PI).collect();
        assert!(remove_turns(&mut wrapped) > 10);
        for (found, expected) in wrapped.iter().zip(&motion) {
            assert!((found - expected).abs() < 1e-12);
        }
        let mut jump: Vec<f64> =
            (0..100).map(|k| if k < 50 { 0.01 } else { 4.0 } * f64::from(k % 2)).collect();
        let before = jump.clone();
        assert_eq!(remove_turns(&mut jump), 0);
        assert_eq!(jump, before);
        assert_eq!(remove_turns(&mut []), 0);
    }
}
