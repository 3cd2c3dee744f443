//! The coupling torque of the equivalent beam, and the motor that it loads: step 6 of Section 4.

use nalgebra::{DMatrix, DVector, DVectorView};
use num_complex::Complex64;

use crate::beam::{BeamError, KnownMode, ModalBeam, ModalForm};
use crate::identify::equivalent::{
    EquivalentBeam, EquivalentError, StrainlessForm, deviation, equivalent_beam, moved,
};
use crate::identify::estimate::Estimate;
use crate::identify::responses::correct::Response;
use crate::identify::responses::model::{CoupledMode, modal};
use crate::identify::responses::rational::{
    CouplingFit, MotorData, Pole, SharedPoles, coupled, fit_coupling,
};
use crate::lti::StateSpace;

/// (17)-(18) and (14): an arm of as many points as modes, and its motor.
///
/// The units of torque are those of the command's constant: N·m, or the command's own where the constant is
/// one because it is not known.
#[derive(Debug, Clone)]
pub struct EquivalentArm {
    /// Â and B̂.
    pub beam: EquivalentBeam,
    /// The modes that they are of.
    pub poles: Vec<Pole>,
    /// Ĥ \[N·m/rad\].
    pub h: Vec<Estimate>,
    /// ĥ_{n+1} \[N·m/rad\].
    pub h_motor: Estimate,
    /// ζ_w of each mode: what of its damping ratio is within the beam.
    pub damping_within: Vec<f64>,
    /// c_k of each mode \[N·m/rad\]: without damping within the beam, `C_t/θ_m = Σ c_k·(s² + d_k·s)/(s² + d_k·s + ω_k²)`,
    /// `d_k = 2ζ_kω_k`.
    pub coupling: Vec<Estimate>,
    /// J \[kg·m²\], with what the modes left out carry of the beam's inertia.
    pub inertia: Estimate,
    /// V \[N·m·s/rad\], back-EMF included.
    pub viscous: Estimate,
    /// Covariance of the fit's unknowns, in the order of [`SharedPoles::covariance`], then of J, V and c_k.
    pub covariance: DMatrix<f64>,
    /// By how much the motor comes later than the command \[s\], where its response calls for that.
    pub delay_s: Option<Estimate>,
    /// Coulomb friction left in the motor's response: how many deviations a torque against the motion that does
    /// not grow with its speed is from zero.
    pub friction_left: f64,
    /// Root mean square of what the motor's response leaves, in its deviations: one where the model is as
    /// good as the data.
    pub weighted_rms: f64,
    /// Torque per command used.
    torque_per_command: f64,
}

/// Steps 5 and 6: from responses of points with shared poles and the motor's response, friction taken out,
/// the whole arm.
///
/// The motor's torque per angle is linear in J, V and c_k once the poles are known (step 6(c)). With R the points'
/// gains at rest, mode by mode, `Ĥ = −cᵀ·R⁻¹` and `ĥ_{n+1} = Σ c_k`: what step 6(d) comes to in exact
/// numbers. Deviations are to first order in both covariances, the poles' errors counted in c_k too.
/// `Ĥ·1 + ĥ` is zero only as far as R·1 is one: see [`EquivalentArm::strainless`].
///
/// # Errors
/// As [`equivalent_beam`]; a motor's response with too few frequencies, a value that is none, or no deviation.
///
/// # Source
/// `[Feliu1989, Section 4, step 6, eq. (18)]`
pub fn equivalent_arm(
    fit: &SharedPoles,
    motor: &MotorData,
) -> Result<EquivalentArm, EquivalentError> {
    arm_below(fit, motor, &[])
}

/// The same where poles `beyond` the frequencies measured carry torque within them.
pub(super) fn arm_below(
    fit: &SharedPoles,
    motor: &MotorData,
    beyond: &[Pole],
) -> Result<EquivalentArm, EquivalentError> {
    let beam = equivalent_beam(fit)?;
    let sound = |(w, r): (&f64, &Response)| {
        let value = r.value.is_finite() && r.value.norm() > 0.0;
        w.is_finite() && *w > 0.0 && value && r.std.is_finite() && r.std > 0.0
    };
    let pairs = motor.omega_rad_s.iter().zip(&motor.response);
    let (count, others) = (motor.omega_rad_s.len(), motor.response.len());
    let odd = (count != others).then_some(count.min(others));
    if let Some(index) = pairs.into_iter().position(|p| !sound(p)).or(odd) {
        return Err(EquivalentError::MotorResponse { index });
    }
    let modes = fit.poles.len();
    let (frequencies, unknowns) = (motor.response.len(), 2 + modes);
    let coupled = fit_coupling(motor, fit, beyond)
        .ok_or(EquivalentError::MotorTooFew { frequencies, unknowns })?;
    let covariance = joined(fit, &coupled);
    let first = fit.covariance.nrows();
    let figure = |i: usize| Estimate {
        value: coupled.value[i],
        std: covariance[(first + i, first + i)].max(0.0).sqrt(),
    };
    let c = coupled.value.rows(2, modes).into_owned();
    let inverse = &beam.inverse;
    let ModalForm { h, h_motor, .. } = ModalForm::new(&beam.gains, inverse, &beam.squares, &c);
    // dĤ = −dcᵀ·R⁻¹ − Ĥ·dR·R⁻¹.
    let slopes: Vec<DVector<f64>> = (0..covariance.nrows())
        .map(|unknown| match unknown.checked_sub(first + 2) {
            Some(k) => -inverse.row(k).transpose(),
            None => -inverse.tr_mul(&moved(fit, unknown).0.tr_mul(&h)),
        })
        .collect();
    let h_std = |i: usize| deviation(&covariance, |u| slopes[u][i]);
    let h_motor_std = deviation(&covariance, |u| f64::from(u >= first + 2));
    Ok(EquivalentArm {
        damping_within: coupled.damping_within,
        delay_s: coupled.delay_s,
        friction_left: coupled.friction_left,
        poles: fit.poles.clone(),
        h: h.iter().enumerate().map(|(i, &value)| Estimate { value, std: h_std(i) }).collect(),
        h_motor: Estimate { value: h_motor, std: h_motor_std },
        coupling: (0..modes).map(|k| figure(2 + k)).collect(),
        inertia: figure(0),
        viscous: figure(1),
        weighted_rms: coupled.weighted_rms,
        torque_per_command: motor.torque_per_command,
        covariance,
        beam,
    })
}

/// Covariance of the fit's unknowns and, through the poles too, of J, V and c_k.
fn joined(fit: &SharedPoles, coupled: &CouplingFit) -> DMatrix<f64> {
    let (first, more) = (fit.covariance.nrows(), coupled.value.len());
    let poles = coupled.by_poles.ncols();
    let across = &coupled.by_poles * fit.covariance.rows(0, poles);
    let own = &coupled.covariance + across.columns(0, poles) * coupled.by_poles.transpose();
    let mut all = DMatrix::zeros(first + more, first + more);
    all.view_mut((0, 0), (first, first)).copy_from(&fit.covariance);
    all.view_mut((first, 0), (more, first)).copy_from(&across);
    all.view_mut((0, first), (first, more)).copy_from(&across.transpose());
    all.view_mut((first, first), (more, more)).copy_from(&own);
    all
}

impl EquivalentArm {
    /// The form for use as an arm, in which turning as one body strains nothing: see
    /// [`EquivalentBeam::strainless`].
    pub fn strainless(&self) -> Option<StrainlessForm> {
        let coupling: Vec<f64> = self.coupling.iter().map(|c| c.value).collect();
        self.beam.strainless(&coupling)
    }

    /// The form for use as a state space, from the command to the motor's angle and those of the points, called
    /// `names`: in the modes' own coordinates, with their damping where it is above zero. `unit` is that of
    /// angles, `rad` or `m`.
    pub fn state_space(&self, names: &[&str], unit: &str) -> StateSpace {
        let each = self.poles.iter().zip(&self.coupling);
        let mode = |(pole, c): (&Pole, &Estimate)| {
            let damping_ratio = pole.damping_ratio.max(0.0);
            CoupledMode { pole: Pole { damping_ratio, ..*pole }, coupling: c.value }
        };
        let modes: Vec<CoupledMode> = each.map(mode).collect();
        let rows = self.beam.completed.row_iter().map(|row| row.iter().copied().collect());
        let points: Vec<(String, Vec<f64>)> =
            names.iter().map(|name| (*name).to_owned()).zip(rows).collect();
        let motor = [self.inertia.value, self.viscous.value];
        modal(motor, self.torque_per_command, &modes, &points, unit)
    }

    /// The same as a beam known by its modes, for an [`Arm`](crate::arm::Arm): damping that came out below zero
    /// is none.
    ///
    /// # Errors
    /// [`BeamError`] where a mode's coupling is not above zero, or gains that add up to one at every point cannot
    /// tell the modes apart.
    pub fn modal_beam(&self) -> Result<ModalBeam, BeamError> {
        let each = self.poles.iter().zip(&self.coupling).zip(self.beam.completed.column_iter());
        let mode = |((pole, c), gains): ((&Pole, &Estimate), DVectorView<'_, f64>)| KnownMode {
            omega_rad_s: pole.omega_rad_s,
            damping_ratio: pole.damping_ratio.max(0.0),
            coupling_nm_per_rad: c.value,
            gains: gains.iter().copied().collect(),
        };
        ModalBeam::new(each.map(mode).collect())
    }

    /// Torque per command used.
    pub fn torque_per_command(&self) -> f64 {
        self.torque_per_command
    }

    /// θ_m per command at a frequency, the delay in it.
    pub fn motor_response(&self, omega_rad_s: f64) -> Complex64 {
        let s = Complex64::new(0.0, omega_rad_s);
        let each = self.poles.iter().zip(&self.damping_within).zip(&self.coupling);
        let through = |((pole, within), c): ((&Pole, &f64), &Estimate)| {
            c.value * coupled(pole, *within, omega_rad_s)
        };
        let torque: Complex64 = each.map(through).sum();
        let late = Complex64::cis(-omega_rad_s * self.delay_s.map_or(0.0, |d| d.value));
        late * self.torque_per_command
            / (s * (s * self.inertia.value + self.viscous.value) + torque)
    }
}
