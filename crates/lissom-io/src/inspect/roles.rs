//! Which channel is probably the time, the command, the motor, a tip.
//!
//! A channel is judged by its unit and by the words of its name. A role is guessed only if one channel fits better than
//! all others.

use lissom_formats::LogData;

use super::clock_facts::ClockFacts;
use super::inspected_channel::InspectedChannel;
use super::relations::Relation;
use super::words::{commanded, is_among, words};
use crate::units::Dimension;

/// Role of a channel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// Time stamps.
    Time,
    /// Current of the motor.
    Current,
    /// Torque, or force, of the drive.
    Torque,
    /// Voltage of the motor.
    Voltage,
    /// Angle or position of the motor.
    Motor,
    /// Speed of the motor.
    Speed,
    /// A point of the arm.
    Tip,
}

impl Role {
    /// Its name in texts.
    pub fn name(self) -> &'static str {
        match self {
            Self::Time => "time",
            Self::Current => "current",
            Self::Torque => "torque",
            Self::Voltage => "voltage",
            Self::Motor => "motor",
            Self::Speed => "speed",
            Self::Tip => "tip",
        }
    }

    /// Words of names that speak for the role.
    fn words(self) -> &'static str {
        match self {
            Self::Time => "t time zeit timestamp stamp temps tiempo x_value sec",
            Self::Current => "i iq current strom courant corriente cur curr amps amp",
            Self::Torque => "torque tau trq effort moment drehmoment force kraft",
            Self::Voltage => "u uq voltage volt volts spannung pwm duty",
            Self::Motor => {
                "q pos position angle theta winkel phi enc encoder lage weg posicion joint motor hub \
                 shaft rotor"
            }
            Self::Speed => {
                "speed velocity vel omega qd dq qdot drehzahl geschwindigkeit vitesse rpm"
            }
            Self::Tip => "tip end ee alpha strain deflection acc accel accelerometer camera beam",
        }
    }

    /// Whether a unit of this dimension fits.
    fn fits(self, dimension: Dimension, text: &str) -> bool {
        match self {
            Self::Time => dimension == Dimension::TIME,
            Self::Current => dimension == Dimension::CURRENT,
            Self::Torque => [Dimension::TORQUE, Dimension::FORCE].contains(&dimension),
            Self::Voltage => dimension == Dimension::VOLTAGE,
            Self::Motor => {
                dimension == Dimension::LENGTH
                    || dimension == Dimension::NUMBER && !["1", "%"].contains(&text)
            }
            Self::Speed => {
                [Dimension::RATE, Dimension::VELOCITY].contains(&dimension) && !text.ends_with("Hz")
            }
            Self::Tip => {
                [Dimension::ACCELERATION, Dimension::ANGULAR_ACCELERATION].contains(&dimension)
            }
        }
    }
}

/// Words of channels that are none of the motor's.
const OTHERS: &str = "id temp temperature status state index flag count";
/// What a unit and a word count.
const UNIT: i32 = 3;
const WORD: i32 = 2;

/// A guess, with the reason.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Guess {
    /// Index of the channel.
    pub channel: usize,
    /// Why.
    pub why: String,
}

/// Which channel is probably what.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Roles {
    guesses: Vec<(Role, Guess)>,
    several: Vec<(Role, Vec<usize>)>,
}

impl Roles {
    /// The guesses for some channels; `stamps` are the time stamps, found before.
    pub(super) fn guessed(channels: &[InspectedChannel], stamps: Option<Guess>) -> Self {
        let mut roles = Self::default();
        let time = stamps.as_ref().map(|guess| guess.channel);
        roles.guesses.extend(stamps.map(|guess| (Role::Time, guess)));
        let drive = [Role::Current, Role::Torque, Role::Voltage];
        for role in drive.into_iter().chain([Role::Motor, Role::Speed, Role::Tip]) {
            let taken = |k: usize| roles.guesses.iter().any(|(_, g)| g.channel == k);
            let open = channels.iter().enumerate().filter(|(k, c)| {
                Some(*k) != time && !taken(*k) && !c.facts.constant && c.not_a_number.is_none()
            });
            let scored: Vec<(i32, usize, String)> = open
                .filter_map(|(k, c)| score(role, c).map(|(points, why)| (points, k, why)))
                .collect();
            let Some(best) = scored.iter().map(|s| s.0).max() else { continue };
            let mut first = scored.into_iter().filter(|s| s.0 == best);
            let Some((_, channel, why)) = first.next() else { continue };
            let others: Vec<usize> = first.map(|s| s.1).collect();
            // A multiple of the first is as good as it.
            let same = |k: &usize| matches!(channels[*k].relation, Some(Relation::Multiple { of, .. }) if of == channel);
            if others.iter().all(same) {
                roles.guesses.push((role, Guess { channel, why }));
            } else {
                roles.several.push((role, [vec![channel], others].concat()));
            }
        }
        roles
    }

    /// The guess for a role.
    pub fn of(&self, role: Role) -> Option<&Guess> {
        self.guesses.iter().find(|(r, _)| *r == role).map(|(_, guess)| guess)
    }

    /// The channels that fit a role equally well.
    pub fn several(&self, role: Role) -> Option<&[usize]> {
        self.several.iter().find(|(r, _)| *r == role).map(|(_, all)| &all[..])
    }

    /// All guesses.
    pub fn all(&self) -> &[(Role, Guess)] {
        &self.guesses
    }
}

/// Points of a channel for a role, with the reason; `None` if nothing speaks for it.
fn score(role: Role, channel: &InspectedChannel) -> Option<(i32, String)> {
    let words = words(&channel.name);
    let has = |list: &str| words.iter().find(|w| is_among(w, list));
    let other_motion = [Role::Speed, Role::Current, Role::Torque, Role::Voltage];
    let not_a_position =
        role == Role::Motor && other_motion.iter().any(|other| has(other.words()).is_some());
    let wish = commanded(&words);
    // What the controller wished is no motion.
    let wished_motion = wish.is_some() && [Role::Motor, Role::Speed, Role::Tip].contains(&role);
    if has(OTHERS).is_some() || not_a_position || wished_motion {
        return None;
    }
    let mut points = 0;
    let mut why = Vec::new();
    if let Some(unit) = &channel.unit
        && let Some((_, dimension)) = unit.known
    {
        let fits = role.fits(dimension, &unit.text);
        if !fits && (role != Role::Tip || dimension != Dimension::NUMBER) {
            return None;
        }
        if fits {
            points += UNIT;
            why.push(format!("its unit is {}", unit.text));
        }
    }
    if let Some(word) = has(role.words()) {
        points += WORD;
        why.push(format!("its name has \"{word}\""));
    }
    if points == 0 {
        return None;
    }
    if let Some(word) = wish {
        points -= WORD;
        why.push(format!("but also \"{word}\""));
    }
    let of_tip = role != Role::Tip && has(Role::Tip.words()).is_some();
    // A point of the arm is no motor because its unit is that of a position.
    let only_unit = role == Role::Motor && has(role.words()).is_none();
    if of_tip && only_unit {
        return None;
    }
    if of_tip {
        points -= WORD;
    }
    if role == Role::Motor && has("motor m act actual ist meas measured").is_some() {
        points += 1;
    }
    if role == Role::Current && has("q iq act actual ist meas measured").is_some() {
        points += 1;
    }
    (points > 0).then(|| (points, why.join(", ")))
}

/// The time stamps: a channel that grows, with a unit of time or the name of one, or the first of a table without names.
pub(super) fn looks_like_time(channels: &[InspectedChannel], data: &LogData) -> Option<Guess> {
    let grows = |k: &usize| {
        let stamps = &data.channels[*k].values;
        channels[*k].not_a_number.is_none()
            && ClockFacts::of(stamps).is_some_and(|clock| clock.grows(stamps.len()))
    };
    let own = channels.iter().find_map(|c| c.time).filter(grows);
    if let Some(channel) = own {
        return Some(Guess { channel, why: "the format says so".to_owned() });
    }
    // Columns of an array are called `data[1]`, `data[2]` and so on.
    let array =
        |name: &str| name.split_once('[').map_or(String::new(), |(array, _)| array.to_owned());
    let first_array = channels.first().map_or(String::new(), |c| array(&c.name));
    let unnamed = channels
        .iter()
        .all(|c| c.name.is_empty() || c.name.ends_with(']') && array(&c.name) == first_array);
    let scored = (0..channels.len()).filter(grows).filter_map(|k| {
        let channel = &channels[k];
        let unit = channel.dimension() == Some(Dimension::TIME);
        let name = channel.name.to_lowercase();
        let word = words(&channel.name).into_iter().find(|w| is_among(w, Role::Time.words()));
        let word = word.or_else(|| (name == "x_value").then_some(name));
        let first = k == 0 && unnamed;
        let points = 2 * i32::from(unit) + 2 * i32::from(word.is_some()) + i32::from(first);
        let why = match (unit, word) {
            (true, _) => "it grows and has a unit of time".to_owned(),
            (false, Some(word)) => format!("it grows and its name has \"{word}\""),
            (false, None) => "it is the first column, and it grows".to_owned(),
        };
        (points > 0).then_some((points, k, why))
    });
    // Of equal ones the first.
    let best = scored.reduce(|best, next| if next.0 > best.0 { next } else { best });
    best.map(|(_, channel, why)| Guess { channel, why })
}
