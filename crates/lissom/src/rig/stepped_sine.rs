//! The report's experiment: the motor follows one sinusoid after another.

use super::{HeldStep, Hybrid, Pd, Quantiser, RigError};
use crate::arm::Arm;
use crate::record::{Run, TimeBase};

/// Angle beyond which a loop is taken for unstable, as a multiple of the amplitude asked for.
pub(super) const RUN_AWAY: f64 = 20.0;

/// An arm in its sampled loop.
#[derive(Debug, Clone)]
pub struct Rig {
    /// The arm.
    pub arm: Arm,
    /// The loop.
    pub controller: Pd,
    /// Sample time T \[s\].
    pub sample_time_s: f64,
    /// The motor's sensor; `None` is ideal.
    pub motor_sensor: Option<Quantiser>,
    /// The sensor of each mass's angle; `None` is ideal.
    pub tip_sensor: Option<Quantiser>,
    /// The converter of the current command; `None` is ideal.
    pub current_converter: Option<Quantiser>,
}

/// One sinusoidal run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SteppedSine {
    /// Drive frequency ω0 \[rad/s\].
    pub omega_rad_s: f64,
    /// Amplitude of the reference \[rad\].
    pub amplitude_rad: f64,
    /// Time that the loop runs before the log begins \[s\].
    pub settle_s: f64,
    /// Time that is logged \[s\].
    pub record_s: f64,
}

impl Rig {
    /// Runs the loop on `r(t) = A·sin(ω0·t)` from rest and logs its last part: commanded current,
    /// the motor's angle and each mass's as the sensors give them.
    ///
    /// Sample k of the current is held from the instant of sample k of the angles on.
    ///
    /// ```
    /// # use lissom::{arm::Arm, beam::{LumpedBeam, Span}, drive::{Coulomb, Motor}};
    /// # use lissom::rig::{Pd, Rig, SteppedSine};
    /// # let span = Span { length_m: 0.2, flexural_rigidity_n_m2: 0.004, mass_kg: 0.05, damping_n_s_per_m: 0.0 };
    /// # let beam = LumpedBeam::new(&[span]).unwrap();
    /// # let arm = Arm::new(beam, Motor::new(6e-4, 1e-3, 0.25).unwrap(), Coulomb::symmetric(0.03).unwrap()).unwrap();
    /// # let controller = Pd { proportional_a_per_rad: 8.0, derivative_a_s_per_rad: 0.2, limit_a: 4.0 };
    /// # let rig = Rig { arm, controller, sample_time_s: 0.003, motor_sensor: None, tip_sensor: None, current_converter: None };
    /// let drive = SteppedSine { omega_rad_s: 2.0, amplitude_rad: 0.5, settle_s: 3.0, record_s: 6.0 };
    /// let run = rig.stepped_sine("slow", &drive)?;
    /// assert_eq!((run.len(), run.tips().len()), (2000, 1));
    /// assert!(run.motor().iter().all(|angle| angle.abs() < 0.55)); // the loop follows
    /// # Ok::<(), lissom::rig::RigError>(())
    /// ```
    ///
    /// # Source
    /// `[Feliu1989, Sections 5.1 and 6.1]`. The report prints no gains.
    ///
    /// # Errors
    /// [`RigError::NotPositive`] for times and frequencies that are not, [`RigError::Unstable`]
    /// where the loop runs away.
    pub fn stepped_sine(&self, name: &str, drive: &SteppedSine) -> Result<Run, RigError> {
        let positive = [
            ("sample_time_s", self.sample_time_s),
            ("omega_rad_s", drive.omega_rad_s),
            ("amplitude_rad", drive.amplitude_rad),
            ("record_s", drive.record_s),
        ];
        for (quantity, found) in positive {
            if !(found > 0.0 && found.is_finite()) {
                return Err(RigError::NotPositive { quantity, found });
            }
        }
        let t = self.sample_time_s;
        let settle = (drive.settle_s.max(0.0) / t).round() as usize;
        let record = (drive.record_s / t).round().max(8.0) as usize;
        let n = self.arm.beam().len();
        let mut current = Vec::with_capacity(record);
        let mut motor = Vec::with_capacity(record);
        let mut tips = vec![Vec::with_capacity(record); n];
        let step = HeldStep::new(&self.arm, t);
        let mut hybrid = Hybrid::at_rest(&self.arm);
        let mut error_before = None;
        for k in 0..settle + record {
            let time = k as f64 * t;
            let read = |sensor: Option<Quantiser>, v: f64| sensor.map_or(v, |s| s.read(v));
            let angle = read(self.motor_sensor, hybrid.state()[0]);
            if angle.abs() > RUN_AWAY * drive.amplitude_rad.max(0.1) {
                return Err(RigError::Unstable { angle_rad: angle, time_s: time });
            }
            let error = drive.amplitude_rad * (drive.omega_rad_s * time).sin() - angle;
            let demand = self.controller.current_a(error, error_before.unwrap_or(error), t);
            error_before = Some(error);
            let command = read(self.current_converter, demand);
            if k >= settle {
                current.push(command);
                motor.push(angle);
                for (i, tip) in tips.iter_mut().enumerate() {
                    tip.push(read(self.tip_sensor, hybrid.state()[2 + i]));
                }
            }
            hybrid.advance_held(&step, self.arm.motor.torque_constant_nm_per_a * command);
        }
        let base = TimeBase::uniform(settle as f64 * t, t);
        Run::new(name, base, current, motor, tips)
            .and_then(|run| run.with_omega(drive.omega_rad_s))
            .map_err(RigError::Record)
    }
}
