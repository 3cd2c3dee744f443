//! The coupling torque of the equivalent beam, and its motor: step 6 of Section 4 of the 1989 report.

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

/// The equivalent arm, (17)-(18) and (14): a beam with as many points as modes, and its motor.
///
/// Torques are in N·m, or in the unit of the command if the torque constant is unknown (taken as one).
#[derive(Debug, Clone)]
pub struct EquivalentArm {
    /// Â and B̂, with the points and gains behind them.
    pub beam: EquivalentBeam,
    /// The modes of the arm.
    pub poles: Vec<Pole>,
    /// Ĥ, coupling torque per angle of each point \[N·m/rad\].
    pub h: Vec<Estimate>,
    /// ĥ_{n+1}, coupling torque per angle of the motor \[N·m/rad\].
    pub h_motor: Estimate,
    /// ζ_w of each mode: the part of its damping ratio that acts within the beam \[1\].
    pub damping_within: Vec<f64>,
    /// c_k, coupling through each mode \[N·m/rad\]: without damping within the beam,
    /// `C_t/θ_m = Σ c_k·(s² + d_k·s)/(s² + d_k·s + ω_k²)` with `d_k = 2ζ_kω_k`.
    pub coupling: Vec<Estimate>,
    /// Inertia J \[kg·m²\]. It includes the inertia of the beam that belongs to modes that are left out.
    pub inertia: Estimate,
    /// Viscous friction V \[N·m·s/rad\], with the damping by back-EMF.
    pub viscous: Estimate,
    /// Covariance of the unknowns: those of the fit in the order of [`SharedPoles::covariance`], then J, V and c_k.
    pub covariance: DMatrix<f64>,
    /// Delay of the motor relative to the command \[s\], if its response shows one.
    pub delay_s: Option<Estimate>,
    /// Coulomb friction that remains in the motor's response: a torque against the motion that does not grow with
    /// speed, divided by its standard error \[1\].
    pub friction_left: f64,
    /// Root mean square of the residual of the motor's response, divided by its standard errors: about one if the model
    /// is as good as the data.
    pub weighted_rms: f64,
    /// Torque per command used.
    torque_per_command: f64,
}

/// Computes the whole equivalent arm from the responses of points with shared poles and the motor's response corrected
/// for friction: steps 5 and 6 of Section 4.
///
/// Once the poles are known, the torque of the motor per angle is linear in J, V and c_k (step 6(c)). With ρ, the gains
/// of the points at rest by mode, `Ĥ = −cᵀ·ρ⁻¹` and `ĥ_{n+1} = Σ c_k`, which is the result of step 6(d) in exact
/// arithmetic. Standard errors are to first order in both covariances; errors of the poles count in c_k, too. `Ĥ·1 + ĥ`
/// is zero only as far as ρ·1 is one: see [`EquivalentArm::strainless`].
///
/// # Errors
/// Those of [`equivalent_beam`]; [`EquivalentError::MotorTooFew`] if the motor's response has too few frequencies;
/// [`EquivalentError::MotorResponse`] if one of its values is zero or not finite, or has no standard error.
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
    let estimate = |i: usize| Estimate {
        value: coupled.value[i],
        std: covariance[(first + i, first + i)].max(0.0).sqrt(),
    };
    let c = coupled.value.rows(2, modes).into_owned();
    let inverse = &beam.inverse;
    let ModalForm { h, h_motor, .. } = ModalForm::new(&beam.gains, inverse, &beam.squares, &c);
    // dĤ = −dcᵀ·ρ⁻¹ − Ĥ·dR·ρ⁻¹.
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
        coupling: (0..modes).map(|k| estimate(2 + k)).collect(),
        inertia: estimate(0),
        viscous: estimate(1),
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
    /// The form for use as an arm, in which turning as one body does not bend the beam: see
    /// [`EquivalentBeam::strainless`].
    pub fn strainless(&self) -> Option<StrainlessForm> {
        let coupling: Vec<f64> = self.coupling.iter().map(|c| c.value).collect();
        self.beam.strainless(&coupling)
    }

    /// State space model from the command to the angles of motor and points, in modal coordinates. It contains the
    /// damping of the modes where that is positive. `names` are the names of the points, and `unit` is the unit of
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

    /// Converts to a beam that is known by its modes, for an [`Arm`](crate::arm::Arm). Negative
    /// estimates of damping become zero.
    ///
    /// # Errors
    /// [`BeamError`] if the coupling of a mode is not positive, or if the modes look alike at the points once the gains
    /// of each point add up to one.
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

    /// Torque per unit of command that was used \[N·m/A or the like\]; one if it is unknown.
    pub fn torque_per_command(&self) -> f64 {
        self.torque_per_command
    }

    /// θ_m per unit of command at a frequency, with the delay.
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
