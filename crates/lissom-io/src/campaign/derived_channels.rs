//! Channels that are computed from others: an angle from a speed, a difference from a goal.

use lissom_core::record::Hold;

/// Integrates a speed to an angle that starts at 0, by the trapezoidal rule.
pub(super) fn integrated(speed: &[f64], sample_time_s: f64) -> Vec<f64> {
    let mut angle = 0.0;
    let mut before = speed.first().copied().unwrap_or(0.0);
    let next = |&speed: &f64| {
        angle += sample_time_s * f64::midpoint(before, speed);
        before = speed;
        angle
    };
    speed.iter().map(next).collect()
}

/// The difference of goal and angle, which is the input of a servo.
///
/// A held goal is compared with the mean angle of the step, because the servo continues to measure.
pub(super) fn goal_difference(goal: &[f64], angle: &[f64], hold: Hold) -> Vec<f64> {
    goal.iter().enumerate().map(|(k, goal)| goal - hold.acting(angle, k)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_integral_of_a_line_is_exact() {
        let speed: Vec<f64> = (0..11).map(f64::from).collect();
        let angle = integrated(&speed, 0.1);
        assert!((angle[0], (angle[10] - 5.0).abs() < 1e-12) == (0.0, true), "{angle:?}");
    }

    #[test]
    fn a_held_goal_acts_with_the_mean_angle() {
        let (goal, angle) = ([1.0, 1.0, 2.0], [0.0, 0.5, 1.5]);
        assert_eq!(goal_difference(&goal, &angle, Hold::Sampled), [0.75, 0.0, 0.5]);
        assert_eq!(goal_difference(&goal, &angle, Hold::Measured), [1.0, 0.5, 0.5]);
    }
}
