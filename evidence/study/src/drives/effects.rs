//! Effects of a simulated drive that the simplest equation of motion does not have.

use std::fmt;

use serde::Serialize;

use crate::draw::Draw;

/// The kind of study.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum DriveStudy {
    /// Every campaign has most of the effects of real logs
    Real,
    /// Every campaign has one effect or none, in turn
    Causes,
}

impl fmt::Display for DriveStudy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Real => "real",
            Self::Causes => "causes",
        })
    }
}

/// The only effect in a campaign of [`DriveStudy::Causes`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Cause {
    /// No effect.
    Clean,
    /// Noise of the measured current.
    InputNoise,
    /// Dry friction that wanders.
    Wander,
    /// A mode that no channel measures.
    UnseenMode,
    /// Gravity that the campaign does not declare, or a constant load.
    Load,
    /// A time shift between the logged current and the angle.
    Lag,
}

impl Cause {
    /// All causes, in the order of the campaigns.
    pub const ALL: [Self; 6] =
        [Self::Clean, Self::InputNoise, Self::Wander, Self::UnseenMode, Self::Load, Self::Lag];

    /// The cause of a campaign.
    pub fn of(index: usize) -> Self {
        Self::ALL[index % Self::ALL.len()]
    }
}

impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Clean => "clean",
            Self::InputNoise => "input noise",
            Self::Wander => "wander",
            Self::UnseenMode => "unseen mode",
            Self::Load => "load",
            Self::Lag => "lag",
        })
    }
}

/// The current in the log.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Input {
    /// The command, constant from row to row.
    Held,
    /// A measurement of the current.
    Measured {
        /// Standard deviation of its noise over the planned peak torque \[1\].
        noise_share: f64,
        /// Samples of the controller per row.
        samples_per_row: usize,
    },
}

/// Wandering friction.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Wander {
    /// Relative standard deviation \[1\].
    pub relative_std: f64,
    /// Correlation time \[s\].
    pub correlation_time_s: f64,
}

/// Friction that changes with speed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct NearRest {
    /// Friction at rest over Coulomb friction \[1\]: below one concave friction, above one static friction.
    pub rest_share: f64,
    /// Speed over which it changes, over the peak speed \[1\].
    pub speed_share: f64,
}

/// Gear ripple.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct GearRipple {
    /// Amplitude over Coulomb friction \[1\].
    pub share: f64,
    /// Waves per turn.
    pub per_turn: f64,
    /// Phase at angle zero \[rad\].
    pub phase_rad: f64,
}

/// Gravity of an unbalanced load.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Gravity {
    /// Largest torque over the planned peak torque of the motion \[1\].
    pub share: f64,
    /// The load hangs down at minus this angle \[rad\].
    pub phase_rad: f64,
    /// Whether the campaign declares gravity.
    pub declared: bool,
}

/// A mass on a flexible span that no channel measures.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct UnseenMode {
    /// Inertia of the mass over that of the motor \[1\].
    pub inertia_ratio: f64,
    /// Frequency with the motor clamped, over the highest frequency of the planned motion \[1\].
    pub frequency_ratio: f64,
    /// Damping ratio \[1\].
    pub damping_ratio: f64,
}

/// A time shift between command and angle.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Lag {
    /// A held command acts this many rows after its row.
    Delay {
        /// Rows.
        rows: f64,
    },
    /// A measured current is the mean over the time of one row before it: half a row late.
    MeanBefore,
    /// A measured current is declared as held.
    MeasuredAsHeld,
    /// A held command is declared as measured.
    HeldAsMeasured,
}

/// All effects of a campaign; `None`: the campaign does not have this effect.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Effects {
    /// The current in the log.
    pub input: Input,
    /// Wandering friction.
    pub wander: Option<Wander>,
    /// Concave or static friction.
    pub near_rest: Option<NearRest>,
    /// Gear ripple.
    pub ripple: Option<GearRipple>,
    /// Gravity; a rigid joint only.
    pub gravity: Option<Gravity>,
    /// Constant load over Coulomb friction, signed \[1\].
    pub constant_load: Option<f64>,
    /// A mode that is not measured.
    pub unseen_mode: Option<UnseenMode>,
    /// Largest lateness of time stamps, over the row's time \[1\].
    pub late_stamps: Option<f64>,
    /// Few long strokes.
    pub few_strokes: bool,
    /// Lag of the input.
    pub lag: Option<Lag>,
}

/// Samples of the controller per row of a measured current.
const SAMPLES_PER_ROW: usize = 4;

impl Effects {
    /// No effect.
    pub fn none(input: Input) -> Self {
        Self {
            input,
            wander: None,
            near_rest: None,
            ripple: None,
            gravity: None,
            constant_load: None,
            unseen_mode: None,
            late_stamps: None,
            few_strokes: false,
            lag: None,
        }
    }

    /// The effects of campaign `index`.
    pub(crate) fn draw(draw: &mut Draw, study: DriveStudy, index: usize) -> Self {
        match study {
            DriveStudy::Real => Self::real(draw),
            DriveStudy::Causes => Self::of_cause(draw, Cause::of(index)),
        }
    }

    fn real(draw: &mut Draw) -> Self {
        let fast = draw.chance(0.5);
        let input = Input::Measured {
            noise_share: draw.decade(0.003, 0.05),
            samples_per_row: if fast { SAMPLES_PER_ROW } else { 1 },
        };
        let mut all = Self::none(input);
        all.wander = draw.chance(0.85).then(|| wander(draw, (0.01, 0.04)));
        all.near_rest = match draw.whole(0, 9) {
            0..=4 => Some(NearRest {
                rest_share: draw.uniform(0.4, 0.8),
                speed_share: draw.decade(0.2, 1.5),
            }),
            5..=7 => Some(NearRest {
                rest_share: draw.uniform(1.1, 1.6),
                speed_share: draw.decade(0.01, 0.1),
            }),
            _ => None,
        };
        all.ripple = draw.chance(0.6).then(|| GearRipple {
            share: draw.decade(0.02, 0.15),
            per_turn: f64::from(draw.whole(1, 30)),
            phase_rad: draw.uniform(0.0, std::f64::consts::TAU),
        });
        match draw.whole(0, 9) {
            0..=3 => all.gravity = Some(gravity(draw, true)),
            4..=6 => all.unseen_mode = Some(mode(draw)),
            _ => {}
        }
        all.constant_load = draw.chance(0.25).then(|| constant_load(draw));
        all.late_stamps = draw.chance(0.5).then(|| draw.uniform(0.1, 0.9));
        all.few_strokes = draw.chance(0.3);
        all
    }

    fn of_cause(draw: &mut Draw, cause: Cause) -> Self {
        let measured =
            |noise_share, samples_per_row| Input::Measured { noise_share, samples_per_row };
        let per_row = if draw.chance(0.5) { SAMPLES_PER_ROW } else { 1 };
        let plain = if draw.chance(0.5) { Input::Held } else { measured(0.0, per_row) };
        let mut all = Self::none(plain);
        match cause {
            Cause::Clean => {}
            Cause::InputNoise => all.input = measured(draw.decade(0.02, 0.3), per_row),
            Cause::Wander => all.wander = Some(wander(draw, (0.02, 0.1))),
            Cause::UnseenMode => all.unseen_mode = Some(mode(draw)),
            Cause::Load if draw.chance(0.5) => all.gravity = Some(gravity(draw, false)),
            Cause::Load => all.constant_load = Some(constant_load(draw)),
            Cause::Lag => {
                let (lag, input) = match draw.whole(0, 3) {
                    0 => (Lag::Delay { rows: draw.decade(0.5, 4.0) }, Input::Held),
                    1 => (Lag::HeldAsMeasured, Input::Held),
                    2 => (Lag::MeasuredAsHeld, measured(0.0, per_row)),
                    _ => (Lag::MeanBefore, measured(0.0, per_row)),
                };
                (all.lag, all.input) = (Some(lag), input);
            }
        }
        all
    }

    /// Their names, for tables.
    pub fn names(&self) -> Vec<&'static str> {
        let noise = match self.input {
            Input::Measured { noise_share, .. } => noise_share > 0.0,
            Input::Held => false,
        };
        let concave = self.near_rest.is_some_and(|n| n.rest_share < 1.0);
        let rest = self.near_rest.is_some_and(|n| n.rest_share > 1.0);
        let all = [
            ("input-noise", noise),
            ("wander", self.wander.is_some()),
            ("concave", concave),
            ("static", rest),
            ("ripple", self.ripple.is_some()),
            ("gravity", self.gravity.is_some()),
            ("constant-load", self.constant_load.is_some()),
            ("unseen-mode", self.unseen_mode.is_some()),
            ("late-stamps", self.late_stamps.is_some()),
            ("few-strokes", self.few_strokes),
            ("lag", self.lag.is_some()),
        ];
        all.into_iter().filter(|(_, there)| *there).map(|(name, _)| name).collect()
    }

    /// All names of [`names`](Self::names).
    pub const NAMES: [&'static str; 11] = [
        "input-noise",
        "wander",
        "concave",
        "static",
        "ripple",
        "gravity",
        "constant-load",
        "unseen-mode",
        "late-stamps",
        "few-strokes",
        "lag",
    ];
}

fn wander(draw: &mut Draw, relative: (f64, f64)) -> Wander {
    Wander {
        relative_std: draw.decade(relative.0, relative.1),
        correlation_time_s: draw.decade(0.3, 5.0),
    }
}

fn gravity(draw: &mut Draw, declared: bool) -> Gravity {
    let phase_rad = draw.uniform(-std::f64::consts::PI, std::f64::consts::PI);
    Gravity { share: draw.decade(0.1, 1.0), phase_rad, declared }
}

fn constant_load(draw: &mut Draw) -> f64 {
    let sign = if draw.chance(0.5) { 1.0 } else { -1.0 };
    sign * draw.decade(0.1, 1.5)
}

fn mode(draw: &mut Draw) -> UnseenMode {
    UnseenMode {
        inertia_ratio: draw.decade(0.1, 2.0),
        frequency_ratio: draw.decade(3.0, 20.0),
        damping_ratio: draw.decade(0.005, 0.05),
    }
}
