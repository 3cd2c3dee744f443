//! The motions that a plan chooses from.

use std::f64::consts::{PI, TAU};
use std::fmt;

use crate::plan::thresholds::{
    HIGHEST_LINE, KEEP_OFF, KEEP_OFF_WIDTHS, LIGHTLY_DAMPED, MULTISINE_PERIODS, NYQUIST_SHARE,
    RUN_LEAST_S, SINE_PERIODS,
};
use crate::replay::ModalArm;
use crate::rig::{Drive, Experiment, Multisine, Reference, RigError, Settle, Sweep};

/// Number of sines tried, each with a sine at three times its frequency.
const SINES: usize = 14;
/// Seeds of multisines' phases.
const PHASES: u64 = 3;
/// Times of a sweep \[s\].
const SWEEPS_S: [f64; 3] = [10.0, 20.0, 40.0];
/// The band where neither beam nor current says one \[rad/s\].
const BAND_RAD_S: (f64, f64) = (1.0, 30.0);

/// Reference motion of the motor, without its amplitude.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PlannedMotion {
    /// A sine of this frequency \[rad/s\].
    Sine {
        /// Frequency ω0 \[rad/s\].
        omega_rad_s: f64,
    },
    /// Odd multiples of a frequency up to another \[rad/s\].
    Multisine {
        /// Frequency of the lowest line \[rad/s\].
        omega_rad_s: f64,
        /// Upper limit of the lines \[rad/s\].
        to_rad_s: f64,
        /// Seed of the phases.
        phases: u64,
    },
    /// A logarithmic sweep from one frequency to another \[rad/s\].
    Chirp {
        /// Frequency at its start \[rad/s\].
        from_rad_s: f64,
        /// Frequency at its end \[rad/s\].
        to_rad_s: f64,
        /// Duration \[s\].
        sweep_s: f64,
    },
}

impl PlannedMotion {
    /// Length of a stretch; a record is a whole number of stretches \[s\].
    pub fn stretch_s(&self) -> f64 {
        let whole = |omega_rad_s: f64, periods: f64| {
            let period_s = TAU / omega_rad_s;
            periods.max((RUN_LEAST_S / period_s).ceil()) * period_s
        };
        match *self {
            Self::Sine { omega_rad_s } => whole(omega_rad_s, SINE_PERIODS),
            Self::Multisine { omega_rad_s, .. } => whole(omega_rad_s, MULTISINE_PERIODS),
            Self::Chirp { sweep_s, .. } => sweep_s,
        }
    }

    /// The highest frequency \[rad/s\].
    pub(super) fn highest_rad_s(&self) -> f64 {
        match *self {
            Self::Sine { omega_rad_s } => omega_rad_s,
            Self::Multisine { to_rad_s, .. } | Self::Chirp { to_rad_s, .. } => to_rad_s,
        }
    }

    /// Largest number of stretches.
    pub(super) fn stretches(&self) -> usize {
        match self {
            Self::Sine { .. } | Self::Multisine { .. } => 4,
            Self::Chirp { .. } => 1,
        }
    }

    /// Periods of a record; `None` for a sweep.
    pub fn periods(&self, record_s: f64) -> Option<usize> {
        match *self {
            Self::Sine { omega_rad_s } | Self::Multisine { omega_rad_s, .. } => {
                Some((record_s * omega_rad_s / TAU).round() as usize)
            }
            Self::Chirp { .. } => None,
        }
    }

    /// The motion as a signal.
    ///
    /// # Errors
    /// [`RigError`] if the numbers are not valid.
    pub fn reference(&self, amplitude_rad: f64) -> Result<Reference, RigError> {
        match *self {
            Self::Sine { omega_rad_s } => Reference::sine(omega_rad_s, amplitude_rad),
            Self::Multisine { omega_rad_s, to_rad_s, phases } => {
                let sum = Multisine::odd(omega_rad_s, to_rad_s, amplitude_rad, phases)?;
                Ok(Reference::Multisine(sum))
            }
            Self::Chirp { from_rad_s, to_rad_s, sweep_s } => {
                let ends = (from_rad_s, to_rad_s);
                Reference::chirp(Sweep::Logarithmic, ends, amplitude_rad, sweep_s)
            }
        }
    }

    /// The experiment. Sines wait until their transient has decayed, at most `longest_s`; other motions are logged from
    /// the start.
    ///
    /// # Errors
    /// [`RigError`] if the numbers are not valid.
    pub fn experiment(
        &self,
        amplitude_rad: f64,
        record_s: f64,
        longest_s: f64,
    ) -> Result<Experiment, RigError> {
        let settle = match (self, Settle::DETECTED) {
            (Self::Sine { .. }, Settle::Detected { tolerance, .. }) => {
                Settle::Detected { tolerance, longest_s }
            }
            _ => Settle::AtOnce,
        };
        let drive = Drive::Angle(self.reference(amplitude_rad)?);
        Ok(Experiment::new(drive, record_s)?.settling(settle))
    }
}

/// Motions that are chosen together: a sine with one at three times its frequency, or a single motion.
pub(super) type Group = Vec<PlannedMotion>;

/// Limits of the frequencies that are useful to drive.
#[derive(Debug, Clone, Copy)]
pub(super) struct Reach<'a> {
    pub(super) arm: &'a ModalArm,
    /// Largest torque \[N·m\].
    pub(super) torque_nm: f64,
    /// Largest torque of gravity \[N·m\].
    pub(super) load_nm: f64,
    /// Largest angle of the motor from its start \[rad\].
    pub(super) travel_rad: f64,
    /// Time between two commands \[s\].
    pub(super) command_time_s: f64,
}

/// All motions that a plan can choose from.
pub(super) fn groups(reach: &Reach<'_>, sines_alone: bool) -> Vec<Group> {
    let (low, high) = band(reach);
    let mut found: Vec<Group> = steps(low, high, SINES)
        .into_iter()
        .filter(|omega| is_clear(reach.arm, *omega))
        .filter_map(|omega_rad_s| sine(reach.arm, omega_rad_s, high))
        .collect();
    if sines_alone {
        return found;
    }
    let ends = [(low, high), (0.5 * (low + (low * high).sqrt()), high), (low, (low * high).sqrt())];
    for (from_rad_s, to_rad_s) in ends.map(|(a, b)| (rounded(a), rounded(b))) {
        found.extend(
            SWEEPS_S.map(|sweep_s| vec![PlannedMotion::Chirp { from_rad_s, to_rad_s, sweep_s }]),
        );
        let to_rad_s = to_rad_s.min(rounded(HIGHEST_LINE * from_rad_s));
        found.extend((1..=PHASES).map(|phases| {
            vec![PlannedMotion::Multisine { omega_rad_s: from_rad_s, to_rad_s, phases }]
        }));
    }
    found
}

/// A sine with one at three times its frequency. If that cannot be driven, the sine is tried alone; if that is near a
/// mode, the sine is not tried.
fn sine(arm: &ModalArm, omega_rad_s: f64, high: f64) -> Option<Group> {
    let triple = exactly(3.0 * omega_rad_s);
    let one = PlannedMotion::Sine { omega_rad_s };
    if !is_clear(arm, triple) {
        None
    } else if triple > high {
        Some(vec![one])
    } else {
        Some(vec![one, PlannedMotion::Sine { omega_rad_s: triple }])
    }
}

/// Whether a frequency is away from all lightly damped modes.
fn is_clear(arm: &ModalArm, omega_rad_s: f64) -> bool {
    let ratios = arm.damping_ratios();
    arm.modes.iter().zip(ratios).all(|(mode, ratio)| {
        let off = (omega_rad_s / mode.omega_rad_s - 1.0).abs();
        ratio > LIGHTLY_DAMPED || off > KEEP_OFF.max(KEEP_OFF_WIDTHS * ratio)
    })
}

/// Lowest and highest frequency of all: about those at which the whole travel takes the whole current,
/// and about the modes.
fn band(reach: &Reach<'_>) -> (f64, f64) {
    let arm = reach.arm;
    let carried: f64 =
        arm.modes.iter().map(|m| m.stiffness_nm_per_rad / m.omega_rad_s.powi(2)).sum();
    let left_nm = reach.torque_nm - arm.coulomb_nm - reach.load_nm;
    let corner = (left_nm / ((arm.inertia_kg_m2 + carried) * reach.travel_rad)).sqrt();
    let first = arm.modes.first().map(|m| m.omega_rad_s);
    let last = arm.modes.last().map(|m| m.omega_rad_s);
    let corner = Some(corner).filter(|c| c.is_finite() && *c > 0.0);
    let lowest = corner.into_iter().chain(first).fold(f64::INFINITY, f64::min);
    let highest = corner.map(|c| 3.0 * c).into_iter().chain(last.map(|w| 1.6 * w));
    let highest = highest.fold(0.0, f64::max);
    let (low, high) = if highest > 0.0 { (0.2 * lowest, highest) } else { BAND_RAD_S };
    let fastest = NYQUIST_SHARE * PI / reach.command_time_s;
    (low.min(0.05 * fastest), high.min(fastest))
}

/// Frequencies in even steps of their logarithm.
fn steps(low: f64, high: f64, count: usize) -> Vec<f64> {
    let ratio = (high / low).powf(1.0 / (count - 1) as f64);
    (0..count).map(|k| rounded(low * ratio.powf(k as f64))).collect()
}

/// Rounds to three digits, so that the printed plan is exactly the one that was simulated.
pub(super) fn rounded(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap_or(value)
}

/// A multiple of such a number without the tail of its binary digits.
fn exactly(value: f64) -> f64 {
    format!("{value:.6e}").parse().unwrap_or(value)
}

/// `sine at 2 rad/s`, `chirp from 1 to 20 rad/s`.
impl fmt::Display for PlannedMotion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Sine { omega_rad_s } => write!(f, "sine at {omega_rad_s} rad/s"),
            Self::Multisine { omega_rad_s, to_rad_s, .. } => {
                write!(f, "multisine from {omega_rad_s} to {to_rad_s} rad/s")
            }
            Self::Chirp { from_rad_s, to_rad_s, .. } => {
                write!(f, "chirp from {from_rad_s} to {to_rad_s} rad/s")
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::replay::{DryTerms, Oscillator};

    #[test]
    #[expect(clippy::float_cmp, reason = "the same text, read twice")]
    fn numbers_have_three_digits() {
        assert_eq!([rounded(0.012_345), rounded(98_765.0), rounded(3.0)], [0.0123, 98_800.0, 3.0]);
        assert_eq!([rounded(0.0), exactly(3.0 * 18.6)], [0.0, 55.8]);
    }

    fn mode(omega_rad_s: f64, ratio: f64) -> Oscillator {
        let within_per_s = 2.0 * ratio * omega_rad_s;
        Oscillator { omega_rad_s, stiffness_nm_per_rad: 0.1, within_per_s, grounded_per_s: 0.0 }
    }

    /// Of the frequencies tried those go that are within 12 % or four half-widths of a lightly damped mode, or whose triple
    /// is. One that is damped by more than a tenth sends none away.
    #[test]
    fn sines_and_their_triples_keep_off_lightly_damped_modes() {
        let arm = ModalArm {
            inertia_kg_m2: 1e-3,
            viscous_nm_s_per_rad: [1e-3; 2],
            coulomb_nm: 0.04,
            offset_nm: 0.0,
            dry_terms: DryTerms::default(),
            modes: vec![mode(8.0, 0.002), mode(27.0, 0.3), mode(60.0, 0.05)],
            shapes: Vec::new(),
            at_points_per_s: Vec::new(),
            gravity: None,
            torque_ripples: Vec::new(),
            command_lag_s: 0.0,
            tip_lags_s: Vec::new(),
        };
        let reach = Reach {
            arm: &arm,
            torque_nm: 1.8,
            load_nm: 0.0,
            travel_rad: 1.0,
            command_time_s: 2e-3,
        };
        let near =
            |omega: f64| (omega / 8.0 - 1.0).abs() < 0.12 || (omega / 60.0 - 1.0).abs() < 0.2;
        let (low, high) = band(&reach);
        let tried = steps(low, high, SINES);
        let clear: Vec<f64> =
            tried.iter().copied().filter(|w| !near(*w) && !near(3.0 * w)).collect();
        let by_itself = tried.iter().filter(|w| near(**w)).count();
        let by_triple = tried.iter().filter(|w| !near(**w) && near(3.0 * **w)).count();
        assert!(by_itself > 0 && by_triple > 0, "{tried:?}");
        assert!(clear.iter().any(|w| (w / 27.0 - 1.0).abs() < 0.12), "{clear:?}");
        let omega = |motion: &PlannedMotion| match *motion {
            PlannedMotion::Sine { omega_rad_s } => omega_rad_s,
            _ => f64::NAN,
        };
        let offered = groups(&reach, true);
        assert_eq!(offered.iter().map(|group| omega(&group[0])).collect::<Vec<_>>(), clear);
        for pair in offered.iter().filter(|group| group.len() > 1) {
            assert!((omega(&pair[1]) / omega(&pair[0]) - 3.0).abs() < 1e-6, "{pair:?}");
        }
    }
}
