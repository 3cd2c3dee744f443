//! Whether a command is held between its samples or measured by a sensor, from the delay with which it acts.

use crate::identify::methods::regression::motor::motor_regression;
use crate::identify::methods::regression::thresholds::HELD_DELAY_MOST;
use crate::identify::options::Options;
use crate::identify::prepare::prepared::Prepared;
use crate::identify::thresholds::CLEARLY_PRESENT;
use crate::record::{Campaign, Hold, Run};

/// What the motion shows about a command.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HoldShown {
    /// How the command acts between its samples.
    pub hold: Hold,
    /// Delay with which the motor's equation has it act if the command is taken as measured \[samples\].
    pub delay_samples: f64,
    /// Standard error of this delay \[samples\].
    pub delay_std_samples: f64,
}

/// Finds whether the command of a campaign is held until the next sample or measured by a sensor.
///
/// A held command acts half a sample later than a measured one with the same samples. The motor's equation is solved for both,
/// each with a delay of the command as a further term: the command is held if this leaves less than 0.4 samples of delay, and
/// less than for a measured one. `None` if the logs show no delay of a measured command (four standard errors), would not show
/// one of half a sample, or do not give the motor's equation.
pub fn hold_shown(campaign: &Campaign) -> Option<HoldShown> {
    let delay = |hold: Hold| {
        let mut campaign = campaign.clone();
        campaign.channels.command.hold = hold;
        motor_regression(&Prepared::of(&campaign), &Options::default())?.delay
    };
    let sample_s = campaign.runs.iter().map(Run::sample_time_s).fold(f64::INFINITY, f64::min);
    let measured = delay(Hold::Measured).filter(|d| d.value > CLEARLY_PRESENT * d.std)?;
    let is_known = 0.5 * sample_s > CLEARLY_PRESENT * measured.std;
    let held = delay(Hold::Sampled).filter(|_| is_known)?;
    // A longer delay has another cause.
    let explains = held.value.abs() < measured.value.abs().min(HELD_DELAY_MOST * sample_s);
    let hold = if explains { Hold::Sampled } else { Hold::Measured };
    Some(HoldShown {
        hold,
        delay_samples: measured.value / sample_s,
        delay_std_samples: measured.std / sample_s,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::{Axis, Channels, Command, CommandQuantity, TimeBase};

    /// A controller that holds its current, on a joint with friction, and a sensor of the current.
    fn campaign(measured: bool) -> Campaign {
        const STEPS: usize = 50;
        let (sample_s, inertia, viscous, coulomb) = (2e-3, 0.02, 0.1, 0.3);
        let (mut angle, mut speed) = (0.0_f64, 0.0_f64);
        let (mut command, mut motor) = (Vec::new(), Vec::new());
        for k in 0..8000 {
            let t = k as f64 * sample_s;
            let goal = (2.0 * t).sin() + 0.3 * (7.0 * t).sin();
            let rate = 2.0 * (2.0 * t).cos() + 2.1 * (7.0 * t).cos();
            let torque = 20.0 * (goal - angle) + 1.0 * (rate - speed);
            // The sensor shows a straight line from one sample to the next one.
            command.push(torque);
            motor.push(angle);
            let start = command[command.len().saturating_sub(2)];
            for j in 0..STEPS {
                let share = (j as f64 + 0.5) / STEPS as f64;
                let acts = if measured { start + share * (torque - start) } else { torque };
                let friction = viscous * speed + coulomb * speed.signum();
                speed += (acts - friction) / inertia * sample_s / STEPS as f64;
                angle += speed * sample_s / STEPS as f64;
            }
        }
        if measured {
            // It acts as the sensor shows it, a sample later.
            command.insert(0, command[0]);
            command.pop();
        }
        let command_channel = Command {
            quantity: CommandQuantity::Current,
            hold: Hold::Measured,
            torque_per_command: Some(1.0),
            back_emf_viscous: 0.0,
            limit: None,
        };
        let run = Run::new("run", TimeBase::uniform(0.0, sample_s), command, motor, vec![]);
        let channels = Channels { axis: Axis::Rotary, command: command_channel, tips: vec![] };
        Campaign::new(channels, vec![run.unwrap()]).unwrap()
    }

    #[test]
    fn a_held_command_acts_half_a_sample_later() {
        let held = hold_shown(&campaign(false)).unwrap();
        assert_eq!(held.hold, Hold::Sampled);
        assert!((held.delay_samples - 0.5).abs() < 0.1, "{held:?}");
    }

    #[test]
    fn a_measured_command_is_not_taken_as_held() {
        let found = hold_shown(&campaign(true));
        assert!(found.is_none_or(|found| found.hold == Hold::Measured), "{found:?}");
    }
}
