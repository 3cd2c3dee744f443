use super::*;

/// Relative tolerance of closed forms.
const CLOSED: f64 = 1e-9;

fn points(list: &[(f64, f64, f64)]) -> Vec<SpeedPoint> {
    let exact = |value: f64| Estimate { value, std: 0.0 };
    list.iter()
        .map(|&(speed, drive, std)| SpeedPoint {
            speed: exact(speed),
            drive: Estimate { value: drive, std },
        })
        .collect()
}

#[track_caller]
fn close(found: f64, expected: f64) {
    assert!((found - expected).abs() <= CLOSED * expected.abs(), "{found} {expected}");
}

#[test]
fn a_line_through_equal_weights_is_the_closed_form() {
    // x = 1, 2, 3; y = 12, 14, 15: slope 3/2, intercept 32/3; residuals −1/6, 1/3, −1/6.
    let list = points(&[(1.0, 12.0, 1.0), (2.0, 14.0, 1.0), (3.0, 15.0, 1.0)]);
    let found = line(&list, 0.25).unwrap();
    close(found.coulomb.value, 32.0 / 3.0);
    close(found.viscous.value, 1.5 - 0.25);
    // Covariance of three unit weights: 1/3 + 4/2 and 1/2; correlation −2/√(14/3).
    close(found.correlation, -2.0 / (14.0_f64 / 3.0).sqrt());
    // χ² of 1/6 is below its one degree of freedom: the points' own standard errors stand, and their
    // 3·FREEDOM degrees of freedom widen the interval a little.
    let wider = StudentsT::new(0.0, 1.0, 3.0 * FREEDOM).unwrap().inverse_cdf(0.975) / 1.959_964;
    close(found.viscous.std, 0.5_f64.sqrt() * wider);
    assert_eq!((found.points, found.speeds, found.shape), (3, 3, LineShape::Straight));
}

#[test]
fn deviations_of_the_velocity_count_through_the_slope() {
    let mut list = points(&[(1.0, 3.0, 0.003), (2.0, 5.0, 0.003), (4.0, 9.0, 0.003)]);
    for p in &mut list {
        p.speed.std = 0.002;
    }
    // 2·0.002 beside 0.003 is 0.005.
    let both = line(&list, 0.0).unwrap();
    let drive = line(&points(&[(1.0, 3.0, 0.005), (2.0, 5.0, 0.005), (4.0, 9.0, 0.005)]), 0.0);
    close(both.viscous.std, drive.unwrap().viscous.std);
    close(both.coulomb.value, 1.0);
}

#[test]
fn scatter_alone_makes_the_interval_where_it_is_beyond_the_deviations() {
    // y off by +1, −1, −1, +1 about x = 1, 2, 3, 4 is a parabola; about repeated speeds it is not.
    let off = [0.1, -0.1, 0.1, -0.1];
    let list: Vec<_> =
        [1.0, 1.0, 3.0, 3.0].iter().zip(off).map(|(x, e)| (*x, 2.0 + x + e, 1e-4)).collect();
    let found = line(&points(&list), 0.0).unwrap();
    // s² = 0.04/2, slope's variance s²/4; two speeds leave one degree of freedom: 12.706205.
    close(found.viscous.value, 1.0);
    let expected = (0.02_f64 / 4.0).sqrt() * 12.706_204_74 / 1.959_964;
    assert!((found.viscous.std / expected - 1.0).abs() < 1e-6, "{found:?}");
}

#[test]
fn exact_points_have_deviations_of_rounding() {
    let found = line(&points(&[(1.0, 3.0, 0.0), (2.0, 4.0, 0.0), (3.0, 5.0, 0.0)]), 0.0).unwrap();
    close(found.coulomb.value, 2.0);
    assert!(found.coulomb.std < 1e-7 && found.shape == LineShape::Straight, "{found:?}");
}

#[test]
fn a_parabola_and_a_falling_start_are_seen() {
    let of = |law: &dyn Fn(f64) -> f64| {
        let list: Vec<_> = (1..=9).map(|k| (f64::from(k), law(f64::from(k)), 1e-3)).collect();
        line(&points(&list), 0.0).unwrap()
    };
    let concave = of(&|x| 1.0 + x - 0.01 * x * x);
    assert!(
        matches!(concave.shape, LineShape::Concave { standard_errors } if standard_errors > 10.0)
    );
    // Its slowest third: a line through 1, 2, 3 of the parabola meets rest at 1 + 0.01·10/3.
    close(concave.slowest.unwrap().value, 1.0 + 0.1 / 3.0);
    assert!(concave.coulomb.value > concave.slowest.unwrap().value);
    let falling = of(&|x| 1.0 + x + 0.3 * (-x).exp());
    assert!(matches!(falling.shape, LineShape::Convex { .. }), "{falling:?}");
}

#[test]
fn too_few_speeds_are_counted() {
    assert_eq!(line(&[], 0.0), Err(LineError::NoPoints));
    // A chain of small steps is as many speeds as it spans.
    let chain: Vec<_> = (0..20).map(|k| (1.04_f64.powi(k), 1.0 + 1.04_f64.powi(k), 1e-3)).collect();
    assert_eq!(line(&points(&chain), 0.0).unwrap().speeds, 10);
    let one = points(&[(1.0, 2.0, 0.1), (1.049, 2.0, 0.1)]);
    assert_eq!(line(&one, 0.0), Err(LineError::TooFewSpeeds { found: 1 }));
}
