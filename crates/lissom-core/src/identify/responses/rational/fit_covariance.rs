//! Covariance of all unknowns of a rational fit, and of the coefficients of its transfer function.

use nalgebra::{DMatrix, DVector};

use crate::lti::{CoefficientCovariance, TransferFunction};

/// Share of the standard error of an unknown over which slopes are taken to either side.
const STEP: f64 = 0.01;

/// Covariance of unknowns y, then of x on which they depend: `known` is that of y where x is known, `slopes` is ∂y/∂x,
/// `others` the covariance of x.
pub(super) fn joined(
    known: &DMatrix<f64>,
    slopes: &DMatrix<f64>,
    others: &DMatrix<f64>,
) -> DMatrix<f64> {
    let (first, rest) = (known.nrows(), others.nrows());
    let shared = slopes * others;
    let mut all = DMatrix::zeros(first + rest, first + rest);
    all.view_mut((0, 0), (first, first)).copy_from(&(known + &shared * slopes.transpose()));
    all.view_mut((0, first), (first, rest)).copy_from(&shared);
    all.view_mut((first, 0), (rest, first)).copy_from(&shared.transpose());
    all.view_mut((first, first), (rest, rest)).copy_from(others);
    all
}

/// Covariance of the coefficients of `function` and of a delay, which is the last of the unknowns.
///
/// `None` if it is not finite.
pub(super) fn of_coefficients(
    unknowns: &DVector<f64>,
    covariance: &DMatrix<f64>,
    function: impl Fn(&DVector<f64>) -> TransferFunction,
) -> Option<CoefficientCovariance> {
    let delay = unknowns.len().checked_sub(1)?;
    let coefficients = |at: &DVector<f64>| {
        let g = function(at);
        let all = g.num.iter().chain(&g.den).copied().chain([at[delay]]);
        DVector::from_iterator(g.num.len() + g.den.len() + 1, all)
    };
    let column = |k: usize| {
        let step = STEP * covariance[(k, k)].max(0.0).sqrt();
        let beside = |step: f64| {
            let mut moved = unknowns.clone();
            moved[k] += step;
            coefficients(&moved)
        };
        // What is known exactly adds nothing.
        let width = if step > 0.0 { 2.0 * step } else { 1.0 };
        (beside(step) - beside(-step)) / width
    };
    let columns: Vec<_> = (0..unknowns.len()).map(column).collect();
    let slopes = DMatrix::from_columns(&columns);
    let matrix = &slopes * covariance * slopes.transpose();
    matrix.iter().all(|v| v.is_finite()).then_some(CoefficientCovariance { matrix })
}

#[cfg(test)]
mod tests {
    use num_complex::Complex64;
    use rand_distr::{Distribution as _, StandardNormal};
    use rand_xoshiro::Xoshiro256PlusPlus;
    use rand_xoshiro::rand_core::SeedableRng as _;

    use crate::identify::Response;
    use crate::identify::responses::rational::{
        MotorData, MotorFit, Pole, TipData, TipForm, fit_at_once, fit_beam, fit_motor, fit_motor_at,
    };
    use crate::lti::{CoefficientCovariance, TransferFunction};

    const POLE: Pole = Pole { omega_rad_s: 15.0, damping_ratio: 0.02 };
    const DELAY_S: f64 = 0.003;
    /// Relative standard error of each response.
    const NOISE: f64 = 0.05;
    const DRAWS: u64 = 60;
    /// Frequencies at which the errors are compared: below, at and above the mode.
    const COMPARED_RAD_S: [f64; 4] = [3.0, 13.0, 15.5, 60.0];

    fn omega() -> Vec<f64> {
        (0..60).map(|k| 2.0 * 1.07_f64.powi(k)).collect()
    }

    fn of_tip(w: f64) -> Complex64 {
        225.0 / POLE.denominator(w)
    }

    fn of_motor(w: f64) -> Complex64 {
        let s = Complex64::new(0.0, w);
        1.0 / (0.4 * s * s + 12.0 * s + 170.0 * (1.0 - of_tip(w)))
    }

    fn noisy(exact: impl Fn(f64) -> Complex64, source: &mut Xoshiro256PlusPlus) -> Vec<Response> {
        let at = |w: &f64| {
            let value = exact(*w);
            let std = NOISE * value.norm();
            let mut part = || -> f64 { StandardNormal.sample(source) };
            let error = Complex64::new(part(), part()) * (std * std::f64::consts::FRAC_1_SQRT_2);
            Response { value: value + error, std }
        };
        omega().iter().map(at).collect()
    }

    fn motor_data(response: Vec<Response>) -> MotorData {
        MotorData { omega_rad_s: omega(), response, torque_per_command: 1.0 }
    }

    fn tip_data(response: Vec<Response>) -> TipData {
        TipData { form: TipForm::Angle, response }
    }

    /// A model of one draw: coefficients and delay, covariance, and the exact response.
    struct Drawn {
        function: TransferFunction,
        delay_s: f64,
        covariance: CoefficientCovariance,
        exact: fn(f64) -> Complex64,
    }

    /// Root mean square, over draws and frequencies, of the errors of magnitude and phase in their standard errors.
    fn z_scores(draw: impl Fn(&mut Xoshiro256PlusPlus) -> Drawn) -> [f64; 2] {
        let mut sums = [0.0, 0.0];
        for seed in 0..DRAWS {
            let drawn = draw(&mut Xoshiro256PlusPlus::seed_from_u64(seed));
            for w in COMPARED_RAD_S {
                let late = Complex64::cis(-w * drawn.delay_s);
                let error = (drawn.function.response(w) * late / (drawn.exact)(w)).ln();
                let std = drawn.covariance.of_response(&drawn.function, w).unwrap();
                sums[0] += (error.re / std.relative_magnitude).powi(2);
                sums[1] += (error.im / std.phase_rad).powi(2);
            }
        }
        sums.map(|sum| (sum / (DRAWS as f64 * COMPARED_RAD_S.len() as f64)).sqrt())
    }

    fn assert_about_one(z: [f64; 2]) {
        assert!(z.iter().all(|z| (0.75..1.3).contains(z)), "{z:?}");
    }

    fn drawn(fit: &MotorFit, exact: fn(f64) -> Complex64) -> Drawn {
        Drawn {
            function: fit.transfer_function.clone(),
            delay_s: fit.delay_s.map_or(0.0, |d| d.value),
            covariance: fit.coefficient_covariance().unwrap(),
            exact,
        }
    }

    #[test]
    fn errors_of_a_pole_that_the_motor_alone_shows_are_as_stated() {
        assert_about_one(z_scores(|source| {
            let fit = fit_motor(&motor_data(noisy(of_motor, source)), None).unwrap();
            assert_eq!(fit.poles.len(), 1);
            drawn(&fit, of_motor)
        }));
    }

    #[test]
    fn errors_with_poles_of_the_beam_are_as_stated() {
        assert_about_one(z_scores(|source| {
            let tips = [tip_data(noisy(of_tip, source))];
            let beam = fit_beam(&omega(), &tips).unwrap();
            let data = motor_data(noisy(of_motor, source));
            let of_poles = beam.modal_covariance();
            let fit = fit_motor_at(&data, &beam.modal_poles(), of_poles.as_ref()).unwrap();
            drawn(&fit, of_motor)
        }));
    }

    #[test]
    fn errors_of_the_beam_are_as_stated() {
        assert_about_one(z_scores(|source| {
            let beam = fit_beam(&omega(), &[tip_data(noisy(of_tip, source))]).unwrap();
            Drawn {
                function: beam.transfer_functions[0].clone(),
                delay_s: 0.0,
                covariance: beam.coefficient_covariance(0).unwrap(),
                exact: of_tip,
            }
        }));
    }

    #[test]
    fn errors_of_motor_and_beam_with_one_pole_are_as_stated() {
        let late = |w: f64| of_motor(w) * Complex64::cis(-w * DELAY_S);
        let both = |source: &mut Xoshiro256PlusPlus| {
            let tips = [tip_data(noisy(of_tip, source))];
            let start = fit_beam(&omega(), &tips).unwrap();
            let data = motor_data(noisy(late, source));
            fit_at_once(&omega(), &tips, &start, &data).unwrap()
        };
        assert_about_one(z_scores(|source| {
            drawn(&both(source).motor, |w| of_motor(w) * Complex64::cis(-w * DELAY_S))
        }));
        assert_about_one(z_scores(|source| {
            let beam = both(source).beam;
            Drawn {
                function: beam.transfer_functions[0].clone(),
                delay_s: 0.0,
                covariance: beam.coefficient_covariance(0).unwrap(),
                exact: of_tip,
            }
        }));
    }
}
