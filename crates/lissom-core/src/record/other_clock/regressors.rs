//! What of the motor's motion another signal follows.

use super::even_signal::EvenSignal;

/// What a signal of another log follows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Follows {
    /// The angle of the motor, as the angle of a point of the arm does.
    Angle,
    /// The acceleration of the motor, as a deflection or an acceleration of the arm does. Scale and sign may be unknown.
    Acceleration,
    /// The motion by its torque: the current or torque of the motor itself.
    Torque,
}

/// Speeds below this share of the usual one (rms) are near standstill, where the torque does not follow from the motion.
const SLOW: f64 = 0.1;
/// Time before and after standstill that is left out \[s\].
const AROUND_S: f64 = 0.02;

/// The motor's motion, as another signal may follow it.
pub(super) struct Regressors<'a> {
    pub(super) motion: &'a EvenSignal,
    pub(super) follows: Follows,
    /// Distance of neighbouring points \[s\].
    pub(super) step_s: f64,
    /// Half of the length of a kernel, in steps.
    pub(super) reach: usize,
    usual_speed: f64,
}

impl<'a> Regressors<'a> {
    pub(super) fn new(motion: &'a EvenSignal, follows: Follows, step_s: f64, reach_s: f64) -> Self {
        let reach = match follows {
            Follows::Torque => 3,
            _ => (reach_s / step_s).round() as usize,
        };
        let mut new = Self { motion, follows, step_s, reach, usual_speed: 0.0 };
        let count = ((motion.end_s() - motion.start_s) / step_s) as usize;
        let speeds = (0..count).map(|k| new.speed(motion.start_s + k as f64 * step_s));
        let squares: f64 = speeds.map(|v| v * v).sum();
        new.usual_speed = (squares / count.max(1) as f64).sqrt();
        new
    }

    fn speed(&self, time_s: f64) -> f64 {
        let half = 0.5 * self.step_s;
        (self.motion.at(time_s + half) - self.motion.at(time_s - half)) / self.step_s
    }

    /// Number of regressors.
    pub(super) fn count(&self) -> usize {
        match self.follows {
            Follows::Torque => 6,
            _ => self.reach + 2,
        }
    }

    /// Writes the regressors at a time of the reference.
    ///
    /// A signal of the arm follows by a symmetric kernel, ∫h(u)·θ(t − u)du with h(−u) = h(u): the response of an undamped
    /// arm has no phase but 0 and π, so that any shift in time shows. A torque follows acceleration, speed, its sign and
    /// the sine and cosine of the angle.
    pub(super) fn write(&self, time_s: f64, row: &mut [f64]) {
        let theta = |at: f64| self.motion.at(at);
        let now = theta(time_s);
        row[0] = 1.0;
        if self.follows == Follows::Torque {
            let (after, before) = (theta(time_s + self.step_s), theta(time_s - self.step_s));
            let speed = self.speed(time_s);
            row[1] = (after - 2.0 * now + before) / (self.step_s * self.step_s);
            row[2] = speed;
            row[3] = speed.signum();
            row[4] = now.sin();
            row[5] = now.cos();
            return;
        }
        row[1] = now;
        for m in 1..=self.reach {
            let away = m as f64 * self.step_s;
            row[m + 1] = theta(time_s + away) + theta(time_s - away) - 2.0 * now;
        }
    }

    /// Whether the signal follows the motion at this time.
    pub(super) fn holds(&self, time_s: f64) -> bool {
        let steps = (AROUND_S / self.step_s).ceil() as i32;
        self.follows != Follows::Torque
            || (-steps..=steps).all(|k| {
                let speed = self.speed(time_s + f64::from(k) * self.step_s);
                speed.abs() > SLOW * self.usual_speed
            })
    }
}
