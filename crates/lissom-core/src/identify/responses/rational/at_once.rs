//! Modes from the responses of tips and motor together.

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::storage::Owned;
use nalgebra::{DMatrix, DVector, Dyn};
use num_complex::Complex64;

use crate::identify::estimate::{Estimate, ModeEstimate};
use crate::identify::responses::correct::Response;
use crate::identify::responses::rational::beam::{BeamFit, Data, TipData, functions};
use crate::identify::responses::rational::fit_covariance::joined;
use crate::identify::responses::rational::motor::{
    MotorData, MotorFit, Solution, finish, least_squares, solve,
};
use crate::identify::responses::rational::{Pole, information, part_error};
use crate::identify::responses::thresholds::CRITERION_CALLED_FOR;
use crate::information::{Inverse, inverted};

/// Share of an unknown's size over which slopes are taken to either side.
const STEP: f64 = 1e-6;

/// Beam and motor with the same poles.
pub(crate) struct AtOnce {
    pub(crate) beam: BeamFit,
    pub(crate) motor: MotorFit,
}

/// Refines the poles of `start`, which the tips' responses at `omega_rad_s` gave, by these and the motor's
/// response together: what tips show as resonances are notches of the motor's, and where a tip's scale is
/// unknown the motor alone says how much torque goes through each. A delay of the command, which bends
/// inertia and viscous friction, is fitted where it lowers the information criterion by 8.
///
/// Either side counts by its standard errors, stretched to what it leaves of its own accord. `None` where one of
/// them is too few frequencies.
///
/// # Source
/// `[Feliu1989, Section 4, steps 4 and 6(c)]`, both in one fit.
pub(crate) fn fit_at_once(
    omega_rad_s: &[f64],
    tips: &[TipData],
    start: &BeamFit,
    motor: &MotorData,
) -> Option<AtOnce> {
    let data = Data::new(omega_rad_s, tips)?;
    let poles = start.poles.len();
    let alone = solve(motor, &start.modal_poles())?;
    let mut problem = JointProblem {
        tips: &data,
        motor,
        modes: &start.mode_poles,
        tips_weight: 1.0 / part_error(start.weighted_rms),
        motor_weight: 1.0 / part_error(alone.weighted_rms(0)),
        fastest_rad_s: motor.omega_rad_s.iter().copied().fold(0.0, f64::max),
        x: DVector::from_iterator(
            2 * poles,
            start.poles.iter().flat_map(|p| [p.omega_rad_s.ln(), p.damping_ratio]),
        ),
    };
    let minimal = |problem| LevenbergMarquardt::new().with_patience(50).minimize(problem).0;
    problem = minimal(problem);
    let delayed = JointProblem { x: problem.x.push(0.0), ..problem.clone() };
    let delayed = minimal(delayed);
    if delayed.information()? + CRITERION_CALLED_FOR < problem.information()? {
        let left = delayed.linear()?.motor.weighted_rms(0);
        problem = minimal(JointProblem { motor_weight: 1.0 / part_error(left), ..delayed });
    }
    problem.finished(tips, start)
}

/// Unknowns: ln ω_k, ζ_k of each pole, then a delay in radians at the motor's highest frequency, if any. What
/// is linear is solved for.
#[derive(Clone)]
struct JointProblem<'a> {
    tips: &'a Data,
    motor: &'a MotorData,
    /// Poles through which the motor is coupled.
    modes: &'a [usize],
    tips_weight: f64,
    motor_weight: f64,
    fastest_rad_s: f64,
    x: DVector<f64>,
}

/// The linear unknowns at a choice of the others, and what all leave.
struct Linear {
    residues: Vec<DVector<f64>>,
    motor: Solution,
    left: DVector<f64>,
}

impl JointProblem<'_> {
    fn poles(&self) -> Vec<Pole> {
        let pole =
            |k: usize| Pole { omega_rad_s: self.x[2 * k].exp(), damping_ratio: self.x[2 * k + 1] };
        (0..self.x.len() / 2).map(pole).collect()
    }

    fn modal_poles(&self) -> Vec<Pole> {
        let poles = self.poles();
        self.modes.iter().map(|&k| poles[k]).collect()
    }

    fn has_delay(&self) -> bool {
        !self.x.len().is_multiple_of(2)
    }

    /// The motor's response as it would be without the delay.
    fn undelayed(&self) -> MotorData {
        if !self.has_delay() {
            return self.motor.clone();
        }
        let delay_s = self.x[self.x.len() - 1] / self.fastest_rad_s;
        let each = self.motor.omega_rad_s.iter().zip(&self.motor.response);
        let early = |(w, r): (&f64, &Response)| Response {
            value: r.value * Complex64::cis(w * delay_s),
            ..*r
        };
        MotorData { response: each.map(early).collect(), ..self.motor.clone() }
    }

    fn linear(&self) -> Option<Linear> {
        let poles = self.poles();
        let motor = solve(&self.undelayed(), &self.modal_poles())?;
        let mut left: Vec<f64> = motor.left.iter().map(|r| r * self.motor_weight).collect();
        let mut residues = Vec::new();
        for tip in 0..self.tips.len() {
            let (found, rest) = self.tips.residues_of(tip, &poles)?;
            left.extend(rest.iter().map(|r| r * self.tips_weight));
            residues.push(found);
        }
        let left = DVector::from_vec(left);
        left.iter().all(|v| v.is_finite()).then_some(Linear { residues, motor, left })
    }

    /// How many numbers are fitted.
    fn unknowns(&self) -> usize {
        self.x.len() + 2 + self.modes.len() + self.tips.len() * (self.x.len() / 2)
    }

    fn information(&self) -> Option<f64> {
        let left = self.linear()?.left;
        Some(information(left.len(), self.unknowns(), left.norm_squared()))
    }

    /// Slopes of what `of` makes of the linear unknowns, by the others.
    fn slopes(&self, of: impl Fn(&Linear) -> DVector<f64>) -> Option<DMatrix<f64>> {
        let beside = |k: usize, step: f64| {
            let mut moved = self.clone();
            moved.x[k] += step;
            Some(of(&moved.linear()?))
        };
        let column = |k| Some((beside(k, STEP)? - beside(k, -STEP)?) / (2.0 * STEP));
        let columns = (0..self.x.len()).map(column).collect::<Option<Vec<_>>>()?;
        let slopes = DMatrix::from_columns(&columns);
        slopes.iter().all(|v| v.is_finite()).then_some(slopes)
    }

    /// Slopes of ω_k and ζ_k of each pole and of the delay \[s\] by the unknowns: one a row.
    fn units(&self) -> DMatrix<f64> {
        let n = self.x.len();
        let poles = self.poles();
        let unit = |k: usize| match poles.get(k / 2) {
            Some(pole) if k.is_multiple_of(2) => pole.omega_rad_s,
            Some(_) => 1.0,
            None => 1.0 / self.fastest_rad_s,
        };
        DMatrix::from_diagonal(&DVector::from_iterator(n, (0..n).map(unit)))
    }

    /// Slopes of J, V and c_k by the modes' ω_k and ζ_k and by the delay, and the covariance of these.
    fn of_motor(&self, covariance: &DMatrix<f64>) -> Option<(DMatrix<f64>, DMatrix<f64>)> {
        let units = self.units();
        let slopes = self.slopes(|l| l.motor.value.clone())?;
        let delay = 2 * (self.x.len() / 2);
        let places: Vec<usize> =
            self.modes.iter().flat_map(|&k| [2 * k, 2 * k + 1]).chain([delay]).collect();
        let n = places.len();
        // Without a delay its row and column are zero.
        let others = (&units * covariance * &units).resize(delay + 1, delay + 1, 0.0);
        let others = DMatrix::from_fn(n, n, |i, k| others[(places[i], places[k])]);
        let by_unit =
            DMatrix::from_fn(slopes.nrows(), slopes.ncols(), |i, k| slopes[(i, k)] / units[(k, k)]);
        let by_unit = by_unit.resize_horizontally(delay + 1, 0.0);
        Some((DMatrix::from_fn(slopes.nrows(), n, |i, k| by_unit[(i, places[k])]), others))
    }

    /// Covariance of ω_k and ζ_k of each pole, then of the residues tip by tip.
    fn beam_covariance(
        &self,
        poles: &[Pole],
        spread: f64,
        covariance: &DMatrix<f64>,
    ) -> Option<DMatrix<f64>> {
        let (count, tips) = (poles.len(), self.tips.len());
        let mut known = DMatrix::zeros(count * tips, count * tips);
        for tip in 0..tips {
            let (rows, b) = self.tips.residue_rows(tip, poles);
            let (_, own) = least_squares(&rows, &b)?;
            let scale = (spread / self.tips_weight).powi(2);
            let first = tip * count;
            known.view_mut((first, first), (count, count)).copy_from(&(own * scale));
        }
        let of_residues = |l: &Linear| {
            let all = l.residues.iter().flat_map(|r| r.iter().copied());
            DVector::from_iterator(count * tips, all)
        };
        let residues_first = joined(&known, &self.slopes(of_residues)?, covariance);
        // The poles first, in their units, and no delay.
        let places: Vec<usize> =
            (0..2 * count).map(|k| count * tips + k).chain(0..count * tips).collect();
        let units = self.units();
        let unit = |i: usize| if i < 2 * count { units[(i, i)] } else { 1.0 };
        let n = places.len();
        Some(DMatrix::from_fn(n, n, |i, k| {
            residues_first[(places[i], places[k])] * unit(i) * unit(k)
        }))
    }

    /// The fits of either side, with standard errors that count those of the poles and the delay.
    fn finished(&self, tips: &[TipData], start: &BeamFit) -> Option<AtOnce> {
        let linear = self.linear()?;
        let free = linear.left.len().saturating_sub(self.unknowns()).max(1) as f64;
        let spread = (linear.left.norm_squared() / free).sqrt().max(1.0);
        let jacobian = self.slopes(|l| l.left.clone())?;
        let Inverse { matrix, lost } = inverted(&jacobian.tr_mul(&jacobian));
        if lost.iter().any(|lost| *lost) {
            return None;
        }
        let covariance = matrix * (spread * spread);
        let std = |k: usize| covariance[(k, k)].max(0.0).sqrt();
        let poles = self.poles();
        if !poles.is_sorted_by(|a, b| a.omega_rad_s < b.omega_rad_s) {
            return None;
        }
        let mode = |&k: &usize| ModeEstimate {
            natural_frequency_rad_s: Estimate {
                value: poles[k].omega_rad_s,
                std: poles[k].omega_rad_s * std(2 * k),
            },
            damping_ratio: Estimate { value: poles[k].damping_ratio, std: std(2 * k + 1) },
        };
        let of_beam = self.beam_covariance(&poles, spread, &covariance)?;
        let count = poles.len();
        let residue = |tip: usize, k: usize| {
            let place = 2 * count + tip * count + k;
            let std = of_beam[(place, place)].max(0.0).sqrt();
            Estimate { value: linear.residues[tip][k], std }
        };
        let residues: Vec<Vec<Estimate>> =
            (0..tips.len()).map(|tip| (0..count).map(|k| residue(tip, k)).collect()).collect();
        let beam = BeamFit {
            modes: self.modes.iter().map(mode).collect(),
            transfer_functions: functions(&poles, &residues, &start.forms),
            residues,
            covariance: of_beam,
            poles,
            ..start.clone()
        };

        let motor = finish(&self.undelayed(), &self.modal_poles(), true, &linear.motor);
        let (slopes, others) = self.of_motor(&covariance)?;
        let mut motor = motor.with_errors_of(&slopes, &others);
        let last = self.x.len() - 1;
        motor.delay_s = self.has_delay().then(|| {
            Estimate { value: self.x[last], std: std(last) }.scaled(1.0 / self.fastest_rad_s)
        });
        Some(AtOnce { beam, motor })
    }
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for JointProblem<'_> {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;
    type ParameterStorage = Owned<f64, Dyn>;

    fn set_params(&mut self, x: &DVector<f64>) {
        self.x.copy_from(x);
    }
    fn params(&self) -> DVector<f64> {
        self.x.clone()
    }
    fn residuals(&self) -> Option<DVector<f64>> {
        Some(self.linear()?.left)
    }
    fn jacobian(&self) -> Option<DMatrix<f64>> {
        self.slopes(|l| l.left.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identify::responses::rational::beam::{TipForm, fit_beam};
    use crate::identify::responses::rational::motor::{MotorData, fit_motor};

    const POLES: [Pole; 2] = [
        Pole { omega_rad_s: 15.0, damping_ratio: 0.01 },
        Pole { omega_rad_s: 110.0, damping_ratio: 0.02 },
    ];
    const INERTIA: f64 = 0.4;
    const VISCOUS: f64 = 12.0;
    const COUPLING: [f64; 2] = [170.0, 90.0];

    fn omega() -> Vec<f64> {
        (0..80).map(|k| 2.0 * 1.058_f64.powi(k)).collect()
    }

    /// Of an accelerometer of unknown scale.
    fn tip(std: f64) -> TipData {
        let second = |w: f64| {
            let sum = 0.002 * 225.0 / POLES[0].denominator(w)
                - 0.001 * 12_100.0 / POLES[1].denominator(w);
            -w * w * sum
        };
        let response = |w: &f64| Response { value: second(*w), std: std * second(*w).norm() };
        TipData {
            form: TipForm::SecondDerivative,
            response: omega().iter().map(response).collect(),
        }
    }

    fn motor(delay_s: f64, std: f64) -> MotorData {
        let at = |w: &f64| {
            let s = Complex64::new(0.0, *w);
            let shape = |k: usize| 1.0 - POLES[k].omega_rad_s.powi(2) / POLES[k].denominator(*w);
            let torque =
                INERTIA * s * s + VISCOUS * s + COUPLING[0] * shape(0) + COUPLING[1] * shape(1);
            let value = Complex64::cis(-w * delay_s) / torque;
            Response { value, std: std * value.norm() }
        };
        let response = omega().iter().map(at).collect();
        MotorData { omega_rad_s: omega(), response, torque_per_command: 1.0 }
    }

    #[test]
    fn modes_torque_and_delay_are_found_together() {
        let tips = [tip(0.02)];
        let start = fit_beam(&omega(), &tips).unwrap();
        let both = fit_at_once(&omega(), &tips, &start, &motor(0.003, 0.02)).unwrap();
        let found = &both.motor;
        let delay = found.delay_s.unwrap();
        assert!((delay.value / 0.003 - 1.0).abs() < 1e-6, "{delay:?}");
        assert!((found.inertia.value / INERTIA - 1.0).abs() < 1e-6, "{found:?}");
        assert!((found.viscous.value / VISCOUS - 1.0).abs() < 1e-6, "{found:?}");
        for (mode, pole) in both.beam.modes.iter().zip(POLES) {
            let frequency = mode.natural_frequency_rad_s;
            assert!((frequency.value / pole.omega_rad_s - 1.0).abs() < 1e-8, "{frequency:?}");
        }
        // Both know the poles: neither alone knows them as well.
        let alone = start.modes[0].natural_frequency_rad_s.std;
        assert!(both.beam.modes[0].natural_frequency_rad_s.std < alone);
        let late = motor(0.003, 0.02);
        let (w, expected) = (late.omega_rad_s[40], late.response[40].value);
        assert!((found.response(w) / expected - 1.0).norm() < 1e-6);
    }

    #[test]
    fn without_a_delay_there_is_none() {
        let tips = [tip(0.02)];
        let start = fit_beam(&omega(), &tips).unwrap();
        let data = motor(0.0, 0.02);
        let both = fit_at_once(&omega(), &tips, &start, &data).unwrap();
        assert!(both.motor.delay_s.is_none());
        let alone = fit_motor(&data, Some(&start.modal_poles())).unwrap();
        assert!((both.motor.inertia.value / alone.inertia.value - 1.0).abs() < 1e-6);
    }
}
