//! Whether a command is held between its samples or measured by a sensor, as the motion shows it.

use crate::identify::estimate::Estimate;
use crate::identify::methods::regression::motor::{MotorRegression, motor_regression};
use crate::identify::methods::regression::thresholds::{HELD_DELAY_MOST, HOLD_MATTERS};
use crate::identify::options::Options;
use crate::identify::prepare::prepared::Prepared;
use crate::identify::thresholds::{CLEARLY_PRESENT, PRESENT, SIGN_SHOWN};
use crate::record::{Campaign, Hold, Run};

/// What the motion shows about a command.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct HoldShown {
    /// How the command acts between its samples.
    pub hold: Hold,
    /// What shows it.
    pub by: HoldEvidence,
}

/// What shows how a command acts between its samples.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum HoldEvidence {
    /// The delay with which the motor's equation has the command act if it is taken as measured \[samples\].
    Delay(Estimate),
    /// Viscous friction is negative for the other one, and positive for this one.
    Viscous {
        /// Viscous friction if the command is taken as measured \[of the campaign's units\].
        measured: Estimate,
        /// Viscous friction if the command is taken as held \[of the campaign's units\].
        held: Estimate,
    },
}

/// Finds whether the command of a campaign is held until the next sample or measured by a sensor.
///
/// A held command acts half a sample later than a measured one with the same samples. The motor's equation is solved for both,
/// each with a delay of the command as a further term: the command is held if this leaves less than 0.4 samples of delay, and
/// less than for a measured one; it is measured if its delay is surely (four standard errors) less than a quarter of a sample.
/// Where neither is shown, it is the one with which viscous friction is positive, if it is negative with the other. `None` if
/// this does not show it, or if the logs do not give the motor's equation.
pub fn hold_shown(campaign: &Campaign) -> Option<HoldShown> {
    let with = |hold| with_hold(campaign, &Options::default(), hold);
    let [measured, held] = [Hold::Measured, Hold::Sampled].map(with);
    let (measured, held) = (measured?, held?);
    by_delay(campaign, &measured, &held).or_else(|| by_viscous(&measured, &held))
}

fn with_hold(campaign: &Campaign, options: &Options, hold: Hold) -> Option<MotorRegression> {
    let mut campaign = campaign.clone();
    campaign.channels.command.hold = hold;
    motor_regression(&Prepared::of(&campaign), options)
}

fn by_delay(
    campaign: &Campaign,
    measured: &MotorRegression,
    held: &MotorRegression,
) -> Option<HoldShown> {
    let sample_s = campaign.runs.iter().map(Run::sample_time_s).fold(f64::INFINITY, f64::min);
    let (measured, held) = (measured.delay?.scaled(1.0 / sample_s), held.delay?);
    if 0.5 < CLEARLY_PRESENT * measured.std {
        return None;
    }
    let late = measured.value > CLEARLY_PRESENT * measured.std;
    let remains = (held.value / sample_s).abs();
    let hold = if late && remains < measured.value.abs().min(HELD_DELAY_MOST) {
        Hold::Sampled
    } else if measured.value.abs() + CLEARLY_PRESENT * measured.std < 0.25 {
        Hold::Measured
    } else {
        // Another delay has another cause.
        return None;
    };
    Some(HoldShown { hold, by: HoldEvidence::Delay(measured) })
}

fn by_viscous(measured: &MotorRegression, held: &MotorRegression) -> Option<HoldShown> {
    // Negative with the one, and not with the other.
    let shows = |one: Estimate, other: Estimate| {
        one.value < -CLEARLY_PRESENT * one.std && other.value > SIGN_SHOWN * other.std
    };
    let (measured, held) = (measured.viscous?, held.viscous?);
    let hold = if shows(measured, held) {
        Hold::Sampled
    } else if shows(held, measured) {
        Hold::Measured
    } else {
        return None;
    };
    Some(HoldShown { hold, by: HoldEvidence::Viscous { measured, held } })
}

/// How the estimates would change if a command acted in the other way between its samples than it is taken to.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct OtherHold {
    /// How the command is taken to act.
    pub taken: Hold,
    /// Inertia now and with the other one, if it changes.
    pub inertia: Option<[Estimate; 2]>,
    /// Viscous friction now and with the other one, if it changes.
    pub viscous: Option<[Estimate; 2]>,
    /// Coulomb friction now and with the other one, if it changes.
    pub coulomb: Option<[Estimate; 2]>,
}

/// What the other hold would change, of what was `found` with these runs and options, by more than three standard errors and a
/// share of 1 %; `None` if nothing does.
pub(crate) fn other_hold(
    campaign: &Campaign,
    options: &Options,
    found: &MotorRegression,
) -> Option<OtherHold> {
    let taken = campaign.channels.command.hold;
    let other = match taken {
        Hold::Measured => Hold::Sampled,
        Hold::Sampled => Hold::Measured,
    };
    let other = with_hold(campaign, options, other)?;
    let changes = |now: Option<Estimate>, then: Option<Estimate>| {
        let (now, then) = (now?, then?);
        let change = (then.value - now.value).abs();
        let matters =
            change > PRESENT * now.std.max(then.std) && change > HOLD_MATTERS * now.value.abs();
        matters.then_some([now, then])
    };
    let found = OtherHold {
        taken,
        inertia: changes(found.inertia, other.inertia),
        viscous: changes(found.viscous, other.viscous),
        coulomb: changes(found.coulomb, other.coulomb),
    };
    let any = found.inertia.or(found.viscous).or(found.coulomb);
    any.map(|_| found)
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
        let HoldEvidence::Delay(delay) = held.by else { panic!("{held:?}") };
        assert!((delay.value - 0.5).abs() < 0.1, "{held:?}");
    }

    #[test]
    fn a_measured_command_is_not_taken_as_held() {
        let found = hold_shown(&campaign(true));
        assert!(found.is_none_or(|found| found.hold == Hold::Measured), "{found:?}");
    }
}
