//! Channels that follow from another channel.

use super::clock_facts::ClockFacts;

/// Values that are compared.
const COMPARED: usize = 20_000;
/// Channels of a log among which relations are searched.
pub(super) const MOST_CHANNELS: usize = 60;
/// Correlation from which a channel is a multiple of another one.
const MULTIPLE: f64 = 0.9999;
/// Correlation from which a channel is the rate of another one.
const RATE: f64 = 0.98;
/// Half lengths of the differences that are tried [samples].
const HALVES: [usize; 3] = [1, 4, 16];

/// How a channel follows from another one, in the units of the file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Relation {
    /// It is `factor` times the other one, plus a constant.
    Multiple {
        /// Index of the other channel.
        of: usize,
        /// The factor.
        factor: f64,
    },
    /// It is `factor` times the rate of the other one, per unit of the time stamps.
    Rate {
        /// Index of the other channel.
        of: usize,
        /// The factor; 1 if the units of both and of the stamps agree.
        factor: f64,
    },
}

/// The relation of `values` to one of the channels `others`, which have the same length.
pub(super) fn relation(
    values: &[f64],
    others: &[(usize, &[f64])],
    time: Option<&[f64]>,
) -> Option<Relation> {
    let end = values.len().min(COMPARED);
    for (of, other) in others {
        if let Some((r, factor)) = fitted(&other[..end], &values[..end])
            && r.abs() > MULTIPLE
        {
            return Some(Relation::Multiple { of: *of, factor });
        }
    }
    let time = &time?[..end];
    // Steps that are no times of a log give no rates.
    ClockFacts::of(time).filter(|clock| clock.grows(time.len()))?;
    let rates = others.iter().filter_map(|(of, other)| {
        let (r, factor) = rate(&other[..end], &values[..end], time)?;
        (r > RATE).then_some((r, Relation::Rate { of: *of, factor }))
    });
    rates.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, relation)| relation)
}

/// Correlation of the rate of `position` with `speed`, and the factor; the largest of several half lengths.
fn rate(position: &[f64], speed: &[f64], time: &[f64]) -> Option<(f64, f64)> {
    let tried = HALVES.iter().filter_map(|half| {
        let middle = *half..position.len().checked_sub(*half)?;
        let slope = |k: usize| {
            let passed = time[k + half] - time[k - half];
            if passed > 0.0 { (position[k + half] - position[k - half]) / passed } else { f64::NAN }
        };
        let mean =
            |k: usize| speed[k - half..=k + half].iter().sum::<f64>() / (2 * half + 1) as f64;
        let slopes: Vec<f64> = middle.clone().map(slope).collect();
        let means: Vec<f64> = middle.map(mean).collect();
        let limit = far(&slopes);
        // An angle that starts again after a turn has slopes far beyond the others.
        let kept: Vec<f64> =
            slopes.into_iter().map(|s| if s.abs() > limit { f64::NAN } else { s }).collect();
        fitted(&kept, &means)
    });
    tried.max_by(|a, b| a.0.total_cmp(&b.0))
}

/// Twenty times the size that nine of ten values stay below.
fn far(values: &[f64]) -> f64 {
    let mut sizes: Vec<f64> = values.iter().map(|v| v.abs()).filter(|v| v.is_finite()).collect();
    sizes.sort_by(f64::total_cmp);
    sizes.get(sizes.len() * 9 / 10).map_or(f64::INFINITY, |size| 20.0 * size)
}

/// Correlation of y with x, and the slope of y against x, where both are known.
fn fitted(x: &[f64], y: &[f64]) -> Option<(f64, f64)> {
    let pairs = || x.iter().zip(y).filter(|(a, b)| a.is_finite() && b.is_finite());
    let count = pairs().count();
    if count < 20 {
        return None;
    }
    let (sx, sy) = pairs().fold((0.0, 0.0), |(sx, sy), (a, b)| (sx + a, sy + b));
    let (mx, my) = (sx / count as f64, sy / count as f64);
    let (xx, xy, yy) = pairs().fold((0.0, 0.0, 0.0), |(xx, xy, yy), (a, b)| {
        let (a, b) = (a - mx, b - my);
        (xx + a * a, xy + a * b, yy + b * b)
    });
    (xx > 0.0 && yy > 0.0).then(|| (xy / (xx * yy).sqrt(), xy / xx))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn speed_of_an_angle_and_a_multiple_of_a_current() {
        let time: Vec<f64> = (0..2000).map(|k| f64::from(k) * 2.0).collect();
        let angle: Vec<f64> = time.iter().map(|t| (0.004 * t).sin()).collect();
        let speed: Vec<f64> = time.iter().map(|t| 4.0 * (0.004 * t).cos()).collect();
        let current: Vec<f64> = time.iter().map(|t| (0.03 * t).sin()).collect();
        let torque: Vec<f64> = current.iter().map(|i| 0.1 * i).collect();
        let found = relation(&speed, &[(0, &angle), (2, &current)], Some(&time));
        assert!(
            matches!(found, Some(Relation::Rate { of: 0, factor }) if (factor / 1000.0 - 1.0).abs() < 1e-3),
            "{found:?}"
        );
        let found = relation(&torque, &[(0, &angle), (2, &current)], Some(&time));
        assert!(
            matches!(found, Some(Relation::Multiple { of: 2, factor }) if (factor - 0.1).abs() < 1e-9),
            "{found:?}"
        );
        assert_eq!(relation(&current, &[(0, &angle)], Some(&time)), None);
    }
}
