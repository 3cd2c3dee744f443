//! Motion without a command: an outside torque moves the joint.

use std::ops::Range;

/// Fewest samples of a stretch without a command.
const LEAST: usize = 30;
/// Speeds are differences over this part of a stretch, and over a few samples at least.
const PARTS: usize = 50;
const FEW: usize = 5;
/// The joint is moved from outside if its speed rises, without a command, by this share of the largest speed of the log: by
/// itself it can only slow down.
const RISES: f64 = 0.2;

/// Stretches in which the command is exactly zero and the speed of the motor rises all the same: somebody moves the joint by
/// hand while the amplifier is off, or another axis drives it.
///
/// `motor` is the angle, or the speed where `is_speed` says so. Coasting, which only slows down, is no such stretch.
///
/// ```
/// let time = |k: usize| 0.01 * k as f64;
/// let angle: Vec<f64> = (0..1000).map(|k| (2.0 * time(k)).sin()).collect();
/// let command: Vec<f64> = (0..1000).map(|k| if k < 600 { (2.0 * time(k)).cos() } else { 0.0 }).collect();
/// assert_eq!(lissom_core::record::undriven(&command, &angle, false), [600..1000]);
/// ```
pub fn undriven(command: &[f64], motor: &[f64], is_speed: bool) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let mut from = 0;
    for stretch in command.chunk_by(|a, b| (*a == 0.0) == (*b == 0.0)) {
        let range = from..from + stretch.len();
        from = range.end;
        if stretch[0] == 0.0 && range.len() >= LEAST && rises(motor, &range, is_speed) {
            found.push(range);
        }
    }
    found
}

/// Whether the speed rises within a range by a share of the largest one of all.
fn rises(motor: &[f64], range: &Range<usize>, is_speed: bool) -> bool {
    let reach = (range.len() / PARTS).max(FEW);
    let speed = |k: usize| {
        if is_speed { motor[k].abs() } else { (motor[k + reach] - motor[k]).abs() / reach as f64 }
    };
    let last = |end: usize| if is_speed { end } else { end.saturating_sub(reach) };
    let fastest = (0..last(motor.len())).map(speed).fold(0.0, f64::max);
    let (mut least, mut rise) = (f64::INFINITY, 0.0_f64);
    for now in (range.start..last(range.end)).map(speed) {
        least = least.min(now);
        rise = rise.max(now - least);
    }
    rise > RISES * fastest
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A run-down after the amplifier was switched off.
    #[test]
    fn coasting_is_kept() {
        let speed = |k: usize| if k < 400 { 3.0 } else { (3.0 - 0.02 * (k - 400) as f64).max(0.0) };
        let mut angle = 0.0;
        let motor: Vec<f64> = (0..800)
            .map(|k| {
                angle += 0.01 * speed(k);
                angle
            })
            .collect();
        let command: Vec<f64> = (0..800).map(|k| if k < 400 { 1.0 } else { 0.0 }).collect();
        assert!(undriven(&command, &motor, false).is_empty());
    }
}
