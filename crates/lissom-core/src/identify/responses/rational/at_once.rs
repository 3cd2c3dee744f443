//! Modes from the responses of tips and motor together.

use nalgebra::DVector;
use num_complex::Complex64;

use crate::identify::responses::rational::beam::{BeamFit, TipData, output};
use crate::identify::responses::rational::motor::{self, MotorData, MotorFit, fit_motor};
use crate::identify::responses::rational::pole_damping::Damping;
use crate::identify::responses::rational::refine::{PolePoint, refined, refined_with_delays};
use crate::identify::responses::rational::weighted::{Output, Weighted};
use crate::identify::responses::rational::{information, part_error};
use crate::identify::responses::thresholds::CRITERION_CALLED_FOR;

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
    let alone = fit_motor(motor, Some(&start.modal_poles()))?.weighted_rms;
    let of_tips = part_error(start.weighted_rms);
    let data =
        joined_data(omega_rad_s, tips, motor, &start.mode_poles, [of_tips, part_error(alone)])?;
    let prompt = Joint::new(data.clone(), start, false)?;
    let late = Joint::new(data, start, true);
    let called_for =
        |late: &Joint| late.information() + CRITERION_CALLED_FOR < prompt.information();
    let found = match late.filter(called_for) {
        Some(late) => {
            // The motor's errors by what it leaves with the delay.
            let stretch = [of_tips, part_error(part_error(alone) * late.motor_rms())];
            let data = joined_data(omega_rad_s, tips, motor, &start.mode_poles, stretch)?;
            Joint { stretch: stretch[1], ..Joint::new(data, start, true)? }
        }
        None => Joint { stretch: part_error(alone), ..prompt },
    };
    found.fits(tips, start, motor)
}

/// Responses of the tips, then the motor's torque per angle, on all their frequencies; what is not measured at one has no
/// weight.
fn joined_data(
    omega_rad_s: &[f64],
    tips: &[TipData],
    motor_data: &MotorData,
    modes: &[usize],
    [of_tips, of_motor]: [f64; 2],
) -> Option<Weighted> {
    let mut omega: Vec<f64> = omega_rad_s.iter().chain(&motor_data.omega_rad_s).copied().collect();
    omega.sort_by(f64::total_cmp);
    omega.dedup();
    let spread = |at: &[f64], output: Output| {
        let (mut values, mut weights) = (Vec::new(), Vec::new());
        for w in &omega {
            let measured = at.iter().position(|at| at.total_cmp(w).is_eq());
            values.push(measured.map_or(Complex64::ZERO, |i| output.weighted[i]));
            weights.push(measured.map_or(0.0, |i| output.weights[i]));
        }
        Output { weighted: values, weights, ..output }
    };
    let torque = motor::output(motor_data, modes.to_vec(), of_motor);
    let of_tip = |tip: &TipData| Some(spread(omega_rad_s, output(omega_rad_s, tip, of_tips)?));
    let mut outputs = tips.iter().map(of_tip).collect::<Option<Vec<_>>>()?;
    outputs.push(spread(&motor_data.omega_rad_s, torque));
    Some(Weighted { omega, outputs })
}

/// Tips and motor, fitted together.
struct Joint {
    data: Weighted,
    point: PolePoint,
    /// By which the motor's standard errors are stretched.
    stretch: f64,
}

impl Joint {
    /// From the poles of `start`; with a delay of the motor where it may be late.
    fn new(mut data: Weighted, start: &BeamFit, late: bool) -> Option<Self> {
        let poles = start.poles.clone();
        let point = if late {
            data.outputs.last_mut()?.may_be_late();
            refined_with_delays(&mut data, poles, Damping::Small)?
        } else {
            refined(&data, poles, Damping::Small)?
        };
        Some(Self { data, point, stretch: 1.0 })
    }

    /// How many real numbers are there beyond those that are fitted.
    fn free(&self) -> f64 {
        let of_outputs = self.point.own_estimates.iter().map(DVector::len).sum::<usize>();
        let unknowns = 2 * self.point.poles.len() + of_outputs;
        self.data.readings().saturating_sub(unknowns).max(1) as f64
    }

    fn information(&self) -> f64 {
        let readings = self.data.readings();
        information(readings, readings - self.free() as usize, self.point.cost)
    }

    /// Root mean square of the motor's residual, relative to its stretched standard errors.
    fn motor_rms(&self) -> f64 {
        let last = self.data.outputs.len() - 1;
        let delays = usize::from(self.data.outputs[last].delay_s.is_some());
        let unknowns = self.point.own_estimates[last].len() - delays;
        let free = self.data.outputs[last].readings().saturating_sub(unknowns).max(1);
        (self.point.costs[last] / free as f64).sqrt()
    }

    /// The fits of either side, with standard errors that count those of the poles and the delay.
    fn fits(&self, tips: &[TipData], start: &BeamFit, motor: &MotorData) -> Option<AtOnce> {
        let (point, modes) = (&self.point, &start.mode_poles);
        let spread = (point.cost / self.free()).max(1.0);
        let covariance = point.covariance()? * spread;
        let beam = BeamFit {
            weighted_rms: start.weighted_rms,
            relative_residual: start.relative_residual,
            ..BeamFit::of_point(tips, point, &covariance, modes.clone())
        };
        // The torque per angle comes earlier by what the angle is late.
        let highest_rad_s = self.data.range().1;
        let early_s = self.data.outputs.last()?.delay_s;
        let late = early_s.map(|early_s| [-early_s, -1.0 / highest_rad_s]);
        let constant = motor.torque_per_command;
        let mut motor = MotorFit::of_point(point, &covariance, modes, late, constant)?;
        motor.weighted_rms = self.motor_rms() * self.stretch;
        Some(AtOnce { beam, motor })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identify::responses::correct::Response;
    use crate::identify::responses::rational::Pole;
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
