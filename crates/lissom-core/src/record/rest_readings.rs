//! Readings of a speed that rest between two levels of the sensor.

/// Fewest readings, one after the other, that are rest.
const LEAST: usize = 10;
/// A speed has levels if its different values are fewer than this share of its readings.
const LEVELS_SHARE: f64 = 0.2;
/// Two distances of neighbouring levels are one if they differ by less than this factor: files round.
const SAME_DISTANCE: f64 = 1.5;
/// A level within this share of the distance is zero.
const ZERO: f64 = 0.25;

/// Readings that were taken as rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RestingReadings {
    /// Distance of the levels \[unit of the channel\].
    pub quantum: f64,
    /// Number of readings.
    pub count: usize,
}

/// Sets a speed to zero where it stays within one quantum of zero for ten readings or more, if zero is none of the sensor's
/// levels: the levels of some drives lie half a quantum beside it, and a motor at rest then seems to creep.
///
/// `None` if the readings have no such levels.
///
/// ```
/// let mut speed: Vec<f64> = (0..400).map(|k| (0.3 * (0.02 * f64::from(k)).sin()).max(0.0)).collect();
/// speed.iter_mut().for_each(|v| *v = 0.02 * ((*v / 0.02).floor() + 0.5)); // levels at 0.01, 0.03, … and none at zero
/// let found = lissom_core::record::rest_at_zero(&mut speed).unwrap();
/// assert!((found.quantum - 0.02).abs() < 1e-9 && found.count > 100);
/// assert_eq!(speed[300], 0.0);
/// ```
pub fn rest_at_zero(speed: &mut [f64]) -> Option<RestingReadings> {
    let quantum = quantum(speed)?;
    if speed.iter().any(|v| v.abs() < ZERO * quantum) {
        return None;
    }
    let mut count = 0;
    for stay in speed.chunk_by_mut(|a, b| (a.abs() < quantum) == (b.abs() < quantum)) {
        if stay[0].abs() < quantum && stay.len() >= LEAST {
            count += stay.len();
            stay.fill(0.0);
        }
    }
    (count > 0).then_some(RestingReadings { quantum, count })
}

/// The usual distance of neighbouring levels; `None` without levels.
fn quantum(speed: &[f64]) -> Option<f64> {
    let mut values = speed.to_vec();
    values.sort_unstable_by(f64::total_cmp);
    let mut distances: Vec<f64> =
        values.windows(2).map(|pair| pair[1] - pair[0]).filter(|d| *d > 0.0).collect();
    if distances.len() < 2 || distances.len() as f64 > LEVELS_SHARE * speed.len() as f64 {
        return None;
    }
    distances.sort_unstable_by(f64::total_cmp);
    let least = distances[0];
    let same = distances.partition_point(|d| *d < SAME_DISTANCE * least);
    Some(distances[..same].iter().sum::<f64>() / same as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_speed_whose_levels_have_a_zero_is_kept() {
        let mut speed: Vec<f64> = (0..400).map(|k| 0.02 * f64::from(k % 7)).collect();
        let before = speed.clone();
        assert!(rest_at_zero(&mut speed).is_none());
        assert_eq!(speed, before);
    }

    #[test]
    fn a_speed_without_levels_is_kept() {
        let mut speed: Vec<f64> = (0..400).map(|k| 1.0 + (0.1 * f64::from(k)).sin()).collect();
        assert!(rest_at_zero(&mut speed).is_none());
    }

    /// Slow motion on the lowest level is short.
    #[test]
    fn a_passage_through_zero_is_kept() {
        let level = |v: f64| 0.02 * ((v / 0.02).floor() + 0.5);
        let mut speed: Vec<f64> = (0..400).map(|k| level((0.1 * f64::from(k)).sin())).collect();
        let before = speed.clone();
        assert!(rest_at_zero(&mut speed).is_none());
        assert_eq!(speed, before);
    }
}
