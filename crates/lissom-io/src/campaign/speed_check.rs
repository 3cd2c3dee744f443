//! Comparison of a logged speed with the rate of the logged angle.

/// Numbers of rows between compared angles, tried in turn: few suit fast motion, many a coarse encoder.
const STRIDES: [usize; 5] = [1, 4, 16, 64, 256];
/// Correlation of the speed's integral with the change of the angle below which the speed is another signal.
const CORRELATION: f64 = 0.9;
/// Relative difference to the angle's rate above which the speed has another unit or is that of another shaft.
const SHARE: f64 = 0.1;

/// How a speed contradicts an angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Contradiction {
    /// Speed divided by the angle's rate, by least squares.
    pub(super) ratio: f64,
    /// Correlation of both.
    pub(super) correlation: f64,
}

/// Compares the integral of the speed from row to row with the change of the angle; `None` if they agree, or if nothing
/// moves.
pub(super) fn contradiction(
    stamps_s: &[f64],
    angle: &[f64],
    speed: &[f64],
) -> Option<Contradiction> {
    let found = STRIDES.into_iter().filter_map(|stride| compare(stamps_s, angle, speed, stride));
    let found = found.max_by(|a, b| a.correlation.abs().total_cmp(&b.correlation.abs()))?;
    let agrees = found.correlation > CORRELATION && (found.ratio - 1.0).abs() < SHARE;
    (!agrees).then_some(found)
}

fn compare(stamps_s: &[f64], angle: &[f64], speed: &[f64], stride: usize) -> Option<Contradiction> {
    let rows = stamps_s.len().min(angle.len()).min(speed.len());
    let mut integral = vec![0.0; rows];
    for k in 1..rows {
        // A clock that goes back starts again: no time passes there.
        let step_s = (stamps_s[k] - stamps_s[k - 1]).max(0.0);
        integral[k] = integral[k - 1] + step_s * f64::midpoint(speed[k - 1], speed[k]);
    }
    let [mut both, mut own, mut of_angle] = [0.0; 3];
    for from in (0..rows.saturating_sub(stride)).step_by(stride) {
        let by_speed = integral[from + stride] - integral[from];
        let by_angle = angle[from + stride] - angle[from];
        both += by_speed * by_angle;
        own += by_speed * by_speed;
        of_angle += by_angle * by_angle;
    }
    let moves = own > 0.0 && of_angle > 0.0;
    moves.then(|| {
        let correlation = both / (own * of_angle).sqrt();
        Contradiction { ratio: correlation * (own / of_angle).sqrt(), correlation }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn log(factor: f64) -> [Vec<f64>; 3] {
        let time: Vec<f64> = (0..2000).map(|k| 1e-3 * f64::from(k)).collect();
        let angle = time.iter().map(|t| (1e3 * (9.0 * t).sin()).round() / 1e3).collect();
        let speed = time.iter().map(|t| factor * 9.0 * (9.0 * t).cos()).collect();
        [time, angle, speed]
    }

    #[test]
    fn the_rate_of_an_angle_agrees_with_it() {
        let [time, angle, speed] = log(1.0);
        assert_eq!(contradiction(&time, &angle, &speed), None);
        assert_eq!(contradiction(&time, &angle, &[0.0; 2000]), None);
    }

    #[test]
    fn another_unit_or_sign_does_not() {
        for factor in [-1.0, 9.549, 0.1047] {
            let [time, angle, speed] = log(factor);
            let found = contradiction(&time, &angle, &speed).unwrap();
            assert!((found.ratio / factor - 1.0).abs() < 0.02, "{found:?}");
        }
        let [time, angle, mut speed] = log(1.0);
        speed.rotate_left(174);
        let found = contradiction(&time, &angle, &speed).unwrap();
        assert!(found.correlation.abs() < 0.3, "{found:?}");
    }
}
