//! A random arm in its loop, with the numbers that an engineer knows before the experiments.

use std::f64::consts::PI;

use lissom::arm::Arm;
use lissom::rig::{
    Amplifier, Instruments, JointFriction, Noise, Quantiser, Rig, RigError, Scene, Sensor,
};
use num_complex::Complex64;

use crate::arm::{clamped_modes, random_arm};
use crate::draw::Draw;
use crate::law::{Law, joint};
use crate::position_loop::{Gains, Task, random_loop};
use crate::rejected::Rejected;
use crate::stratum::Stratum;

/// Largest frequency of the beam's highest mode in radians per sample: six samples in a period.
const LAST_MODE: f64 = 1.0;
/// Amplitude that the drive's torque allows at [`RATED`] times the first frequency \[rad\].
const RATED_RAD: (f64, f64) = (0.08, 0.5);
/// See [`RATED_RAD`].
const RATED: f64 = 1.5;
/// The smallest value of that amplitude, in steps of the motor's encoder.
const RATED_STEPS: f64 = 25.0;
/// Largest amplitude of the motor \[rad\].
const MOST_RAD: (f64, f64) = (0.6, 1.5);
/// The limit of the amplifier relative to the planned peak torque.
const HEADROOM: f64 = 2.0;

/// The properties of the rig that are the same in all runs.
pub(crate) struct Bench {
    pub(crate) rig: Rig,
    pub(crate) gains: Gains,
    /// Planned peak torque \[N·m\].
    pub(crate) peak_nm: f64,
    /// Friction at speed \[N·m\].
    pub(crate) coulomb_nm: f64,
    /// Largest amplitude of the motor \[rad\].
    pub(crate) most_rad: f64,
    /// Step of the motor's encoder \[rad\].
    pub(crate) step_rad: f64,
    /// Natural frequencies, motor clamped \[rad/s\].
    pub(crate) modes_rad_s: Vec<f64>,
}

impl Bench {
    pub(crate) fn draw(draw: &mut Draw, stratum: &Stratum, law: Law) -> Result<Self, Rejected> {
        let inside = law == Law::BeamDamping;
        let (beam, motor) = random_arm(draw, stratum.masses, stratum.damping_ratio, inside)?;
        let modes_rad_s: Vec<f64> = clamped_modes(beam.poles()).iter().map(|m| m.0).collect();
        let (first, last) = (modes_rad_s[0], modes_rad_s[modes_rad_s.len() - 1]);
        if last * stratum.sample_time_s > LAST_MODE {
            return Err(Rejected::FastMode);
        }
        let step_rad = stratum.motor_step_rad();
        let rated_rad = draw.decade(RATED_RAD.0, RATED_RAD.1).max(RATED_STEPS * step_rad);
        let turned = motor.inertia_kg_m2() + beam.inertia_kg_m2();
        let linear_nm = turned * (RATED * first).powi(2) * rated_rad;
        let peak_nm = linear_nm / (1.0 - stratum.coulomb_share);
        let coulomb_nm = stratum.coulomb_share * peak_nm;
        let speed = RATED * first * rated_rad;
        let estimates = (coulomb_nm, motor.viscous_nm_s_per_rad(), motor.inertia_kg_m2());
        let (coulomb, friction) = joint(law, draw, estimates, speed)?;
        let arm = Arm::new(beam, motor, coulomb)?;
        let most_rad = draw.uniform(MOST_RAD.0, MOST_RAD.1);
        let task = Task {
            first_rad_s: first,
            peak_nm,
            coulomb_nm,
            most_rad,
            jump_rad: stratum.motor_jump_rad(),
            sample_time_s: stratum.sample_time_s,
        };
        let gains = random_loop(draw, &arm, &task).ok_or(Rejected::NoLoop)?;
        let rig = rig(arm, friction, &gains, stratum, peak_nm)?;
        Ok(Self { rig, gains, peak_nm, coulomb_nm, most_rad, step_rad, modes_rad_s })
    }

    /// Highest frequency of any reference: half the Nyquist frequency \[rad/s\].
    pub(crate) fn fastest_rad_s(&self) -> f64 {
        0.5 * PI / self.rig.instruments.sample_time_s
    }

    /// Torque per angle of the arm without Coulomb friction \[N·m/rad\].
    pub(crate) fn impedance(&self, omega: f64) -> Complex64 {
        let constant = self.rig.arm.motor.torque_constant_nm_per_a();
        constant / self.rig.arm.motor_response(omega)
    }

    /// Torque per angle of the loop \[N·m/rad\].
    fn stiffness(&self, omega: f64) -> Complex64 {
        self.rig.arm.motor.torque_constant_nm_per_a() * self.gains.response(omega)
    }

    /// Torque per reference without Coulomb friction \[N·m/rad\].
    pub(crate) fn torque_per_reference(&self, omega: f64) -> f64 {
        let (z, c) = (self.impedance(omega), self.stiffness(omega));
        (z * c / (z + c)).norm()
    }

    /// Amplitude of the reference that moves the motor by `amplitude`, with the fundamental of
    /// friction: `|A + (Z·A + j·4CF/π)/C|` \[rad\].
    pub(crate) fn reference_rad(&self, omega: f64, amplitude: f64) -> f64 {
        let friction = Complex64::new(0.0, 4.0 / PI * self.coulomb_nm);
        let torque = self.impedance(omega) * amplitude + friction;
        (amplitude + torque / self.stiffness(omega)).norm()
    }

    /// Amplitude below which the joint sticks for more than a tenth of a slow cycle \[rad\].
    pub(crate) fn least_rad(&self) -> f64 {
        let dead_rad = self.coulomb_nm / self.stiffness(0.0).re;
        2.0 * dead_rad / (1.0 - (0.1 * PI).cos())
    }

    /// The bending of the beam per angle of the motor: the largest |θ_i/θ_m − 1|.
    pub(crate) fn bend(&self, omega: f64) -> f64 {
        let tips = self.rig.arm.tip_response(omega);
        tips.iter().fold(0.0_f64, |most, tip| most.max((tip - 1.0).norm()))
    }
}

fn rig(
    arm: Arm,
    friction: JointFriction,
    gains: &Gains,
    stratum: &Stratum,
    peak_nm: f64,
) -> Result<Rig, RigError> {
    let sensor = |bits: u32| -> Result<Sensor, RigError> {
        let quantiser = Quantiser::encoder(1 << bits)?;
        let noise = stratum.noise_steps.map(|steps| Noise::new(steps * quantiser.step()));
        Ok(Sensor { noise: noise.transpose()?, quantiser: Some(quantiser) })
    };
    let mut instruments = Instruments::ideal(stratum.sample_time_s)?;
    instruments.motor = sensor(stratum.motor_bits)?;
    instruments.tips = vec![sensor(stratum.tip_bits)?];
    let limit_a = HEADROOM * peak_nm / arm.motor.torque_constant_nm_per_a();
    instruments.amplifier = Amplifier::ideal().with_limit(limit_a)?;
    let mut rig = Rig::new(arm, instruments, gains.pd()?.into());
    rig.scene = Scene { friction, ..Scene::default() };
    Ok(rig)
}
