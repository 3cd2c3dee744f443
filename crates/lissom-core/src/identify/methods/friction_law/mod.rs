//! A model of the torque: the line (inertia, Coulomb and viscous friction, offset, couplings, gravity) and the terms beyond it
//! that predict better, with friction against speed as a curve without a law.
//!
//! All is least squares on windows in slip phases, as in the regression. The windows are as short as the sensor
//! allows, because long windows average out what changes with speed and place.

mod adopted;
mod blocks;
mod candidates;
pub(crate) mod choice;
mod column_values;
mod curve;
mod lag;
mod law_estimates;
mod law_in_arm;
mod law_term;
mod possible;
mod prediction;
mod projection;
mod ripple;
mod rows;
mod scanned;
#[cfg(test)]
mod tests;
pub(crate) mod thresholds;
mod unadopted;
mod unused_torque;

pub use candidates::{MissingKind, ModelTerm};
pub use choice::LawCandidate;
pub use curve::CurvePoint;
pub(crate) use curve::{CurveSums, KnownArm};
pub(crate) use lag::delayed;
pub use lag::{AngleLag, LagShape};
pub(crate) use law_term::NEAR_REST_STEP;
pub use law_term::{LawTerm, ScaleUnit};
pub(crate) use projection::Motion;
pub use unadopted::{MissingTerm, Moved, MovingTerm};
pub(crate) use unadopted::{PossibleTerm, widened};
pub(crate) use unused_torque::Unused;
pub use unused_torque::UnusedTorque;

use rayon::prelude::*;

use crate::identify::estimate::Estimate;
use crate::identify::gravity_estimate::Gravity;
use crate::identify::methods::friction_law::blocks::BlockRows;
use crate::identify::methods::friction_law::choice::{LAG, Search, choose};
use crate::identify::methods::friction_law::prediction::{ByBlock, Divided, Improvement};
use crate::identify::methods::friction_law::thresholds::{
    FASTEST_QUANTILE, LAG_SETTLED, LAG_SHAPE_TOLD, TORQUE_OF_NOISE,
};
use crate::identify::methods::regression::{ModeShape, MotorRegression, Terms};
use crate::identify::prepare::channel_noise::{ChannelNoise, channel_noise};
use crate::identify::prepare::prepared::Prepared;
use crate::identify::prepare::run_noise::RunNoise;
use crate::load::GravityLoad;
use crate::record::{Campaign, Run};
use rows::{Cut, Sampled};

/// Fewest samples in a window.
const LEAST_SAMPLES: f64 = 20.0;
/// Ratio of one window tried to that before it.
const LONGER: f64 = std::f64::consts::SQRT_2;
/// A lag is found in at most this many rounds, each corrected by the one before.
const LAG_ROUNDS: usize = 4;

/// The model of the torque that slip phases give, and friction against speed.
#[derive(Debug, Clone, PartialEq)]
pub struct FrictionLaw {
    /// Length of the windows \[s\].
    pub window_s: f64,
    /// Lowest and highest speed of the windows \[rad/s\]; law and curve are valid between these.
    pub speed_range: [f64; 2],
    /// Slowest and fastest speed of the line of Coulomb and viscous friction that stands for the law \[rad/s\].
    pub line_speed_range: [f64; 2],
    /// Friction against speed without a law; for each direction ascending in speed.
    pub curve: Vec<CurvePoint>,
    /// All terms that were tried, in order.
    pub candidates: Vec<LawCandidate>,
    /// Estimates with the terms that were adopted.
    pub chosen: LawFit,
    /// Effects that the logs show and the model does not contain, with what they do to the estimates.
    pub missing: Vec<MissingTerm>,
    /// Lag of the angle behind the command that the estimates take into account, if it was adopted.
    pub lag: Option<AngleLag>,
    /// Terms that are not known to be absent.
    pub(crate) possible: Vec<PossibleTerm>,
    /// What line and model leave of blocks that were left out of their fit.
    pub(crate) unused: Unused,
    /// Squared residuals of left-out blocks in the windows of the regression, as shares of the squared torque; `None` if these
    /// windows are too few.
    left_out_of_regression: Option<ByBlock>,
    /// The motion that the line is fitted to.
    pub(crate) motion: Motion,
    /// Relative residual ‖y − X·q‖/‖y‖ of the line, of the chosen model, and of the curve \[1\].
    pub relative_residual: [f64; 3],
}

/// Estimates of the motor's equation with the friction law `τ_F = s·(C + Σ A_k·g_k) + O + V·v + s·D·v`, s = ±1 the
/// direction of motion. Viscous friction is V + D forward and V − D backward.
#[derive(Debug, Clone, PartialEq)]
pub struct LawFit {
    /// Terms in addition to C, V and O, with their amplitudes: for a ripple, those of its cosine and sine and, if the
    /// travel determines it, k itself; otherwise one.
    pub terms: Vec<(LawTerm, Vec<Estimate>)>,
    /// Inertia J \[kg·m²\] or mass \[kg\].
    pub inertia: Option<Estimate>,
    /// Viscous friction V, mean of both directions, without the damping by back-EMF.
    pub viscous: Option<Estimate>,
    /// Coulomb friction C.
    pub coulomb: Option<Estimate>,
    /// The line C + V·|v| nearest to friction at the speeds of the log, weighted with time, without those slower than a
    /// twentieth of the fastest, as that of least squares: Coulomb friction, and viscous friction, under the mean load of the log.
    /// Without terms by speed or load these are C and V.
    pub projected: [Option<Estimate>; 2],
    /// The same Coulomb friction with the offset, forward and backward.
    pub projected_by_direction: [Option<Estimate>; 2],
    /// Friction at rest C + A, if the law has a term near rest.
    pub at_rest: Option<Estimate>,
    /// Offset O.
    pub offset: Option<Estimate>,
    /// Coulomb friction forward, C + O.
    pub forward: Option<Estimate>,
    /// Coulomb friction backward, C − O.
    pub backward: Option<Estimate>,
    /// κ_i of each tip of the campaign \[N·m/rad\], `None` for a tip that measures no angle; empty if none does.
    pub coupling: Vec<Option<Estimate>>,
    /// Sum of κ_i over the tips \[N·m/rad\].
    pub total_coupling: Option<Estimate>,
    /// Gravity, if the campaign has it.
    pub gravity: Option<Gravity>,
    /// The terms of the motor's equation, followed by the amplitudes of the law.
    pub(crate) joint: Terms,
}

impl FrictionLaw {
    /// With the curve that a known arm gives, if there is one that describes the runs: with what is known of the arm, or with standard errors that count what it knows of friction.
    pub(crate) fn beside(self, sums: &CurveSums, known: Option<&dyn KnownArm>) -> Self {
        let Some(found) = known else { return self };
        let curve = match sums.beside_arm(found) {
            Some(curve) => curve,
            None => sums.beside_law(self.curve, found),
        };
        Self { curve, ..self }
    }

    /// Terms with a speed or a period that were tried alone and are not in the law.
    pub(crate) fn further_terms(&self) -> Vec<LawTerm> {
        let alone = |name: &str| {
            let mut tried = self.candidates.iter().filter_map(|c| c.term.law());
            tried.find(|term| term.name() == name)
        };
        let new = |term: &LawTerm| self.chosen.terms.iter().all(|(t, _)| t.name() != term.name());
        ["near-rest", "ripple"].into_iter().filter_map(alone).filter(new).collect()
    }
}

impl LawFit {
    /// Friction against the motion at a speed in a direction (+1 or −1), without ripples; positive if it brakes.
    pub fn friction(&self, speed: f64, direction: f64) -> Option<f64> {
        let mut sum = self.coulomb?.value + self.viscous?.value * speed;
        sum += direction * self.offset.map_or(0.0, |o| o.value);
        for (term, amplitude) in &self.terms {
            let a = amplitude.first().map_or(0.0, |e| e.value);
            sum += term.at_speed(a, speed, direction);
        }
        Some(sum)
    }

    /// First amplitude of a term, if the law contains it.
    pub fn term(&self, wanted: impl Fn(&LawTerm) -> bool) -> Option<Estimate> {
        let found = self.terms.iter().find(|(term, _)| wanted(term))?;
        found.1.first().copied()
    }

    /// Whether the model has a term beyond the line.
    pub fn departs(&self) -> bool {
        !self.terms.is_empty()
    }
}

/// What a model of a campaign's torque is made from.
#[derive(Clone, Copy)]
struct Source<'a> {
    campaign: &'a Campaign,
    noise: &'a [RunNoise],
    window_s: f64,
    mode: Option<ModeShape>,
    load: Option<GravityLoad>,
}

impl<'a> Source<'a> {
    /// In the windows of a regression.
    fn of(prepared: &'a Prepared<'_>, motor: &MotorRegression) -> Self {
        Self {
            campaign: prepared.used(),
            noise: prepared.noise(),
            window_s: motor.window_s,
            mode: motor.mode.map(|m| m.shape()),
            load: motor.gravity.map(|g| g.load()),
        }
    }

    fn sampled(&self) -> Sampled<'_> {
        let mut sampled = Sampled::new(self.campaign, self.noise, self.window_s, self.mode);
        sampled.load = self.load;
        sampled
    }
}

/// Model and curve of a campaign whose motor's estimates are roughly known, and the sums that the curve is
/// from; `None` where slip phases are too few or too short.
pub(crate) fn friction_law(
    prepared: &Prepared<'_>,
    motor: &MotorRegression,
) -> Option<(FrictionLaw, CurveSums)> {
    let source = Source::of(prepared, motor);
    let (law, sums) = friction_law_of(source, motor)?;
    let with_load = law.chosen.term(|term| matches!(term, LawTerm::WithLoad { .. }));
    let Some(gravity) = law.chosen.gravity.filter(|_| with_load.is_some()) else {
        return Some((law, sums));
    };
    // Without this term the regression's load is a little off.
    friction_law_of(Source { load: Some(gravity.load()), ..source }, motor)
}

fn friction_law_of(
    source: Source<'_>,
    motor: &MotorRegression,
) -> Option<(FrictionLaw, CurveSums)> {
    let inertia = motor.inertia?.value;
    let Source { campaign, mode, .. } = source;
    let sampled = source.sampled();
    let long = Found::of(&sampled, false);
    let possible = long.as_ref().and_then(Found::possible).unwrap_or_default();
    let left_out_of_regression = long.as_ref().and_then(|found| found.search.left_out_shares());
    let lag = long.as_ref().and_then(|found| found.lag(&source));
    // A mode that no tip shows enters by fourth derivatives, and noise fills short windows; a filter blurs reversals, which short
    // windows are near.
    let blurred = lag.as_ref().is_some_and(|(lag, _)| lag.shape != LagShape::Delay);
    let window_s = if mode.is_some() || blurred {
        motor.window_s
    } else {
        short_windows(&source, motor, inertia)
    };
    let short = Source { window_s, ..source };
    let in_time = short.sampled();
    let (lag, tried) = if let Some(lag) = lag {
        lag
    } else {
        // Beside what varies over less than a long window.
        let same = long.filter(|_| window_s.total_cmp(&motor.window_s).is_eq());
        let found = same.or_else(|| Found::of(&in_time, false))?;
        let Some(lag) = found.lag(&short) else {
            let line = found.search.left_out_by_line()?;
            let (law, sums) = found.law(&in_time, None, possible, line)?;
            return Some((FrictionLaw { left_out_of_regression, ..law }, sums));
        };
        lag
    };
    let late = lag.late(campaign);
    let late = Source { campaign: &late, ..short };
    let sampled = late.sampled();
    let found = Found::of(&sampled, true)?;
    let line = Divided::of(&BlockRows::of(&in_time, &found.cut));
    let line = line.left_out(&(0..found.search.line).collect::<Vec<_>>())?.by_block;
    let (mut law, sums) = found.law(&sampled, Some(lag), possible, line)?;
    law.candidates.insert(0, tried);
    Some((FrictionLaw { left_out_of_regression, ..law }, sums))
}

/// Whether an equation with a mode or tips predicts blocks that were left out better than the one without, each with the terms
/// that it calls for, in windows of the same length, and leaves no more of them with each in its own windows: a ripple is gone
/// in windows that are long enough for a mode.
pub(crate) fn predicts_better(
    with: (&MotorRegression, Option<&FrictionLaw>),
    without: (&Prepared<'_>, &MotorRegression, Option<&FrictionLaw>),
) -> bool {
    let (flexible, law) = with;
    let (prepared, rigid, rigid_law) = without;
    let left = |law: &FrictionLaw| law.unused.shares().model;
    if law.zip(rigid_law).is_some_and(|(with, without)| left(with) >= left(without)) {
        return false;
    }
    let source = Source { window_s: flexible.window_s, ..Source::of(prepared, rigid) };
    let sampled = source.sampled();
    let without = Found::of(&sampled, false).and_then(|found| found.search.left_out_shares());
    let both = without.as_ref().zip(law.and_then(|law| law.left_out_of_regression.as_ref()));
    both.is_some_and(|(without, with)| Improvement::between(without, with, 1).is_sure)
}

/// Whether a lag is a filter or a delay, its time \[s\], and the residual with it over that without.
fn shape_of_lag(
    source: &Source<'_>,
    found: &Found<'_>,
    lag: Estimate,
) -> Option<(LagShape, f64, f64)> {
    let without = found.search.residual_without_lag()?;
    let sample_s = source.campaign.runs.first()?.sample_time_s();
    let settled = |shape: LagShape| -> Option<(f64, f64)> {
        let mut time_s = lag.value;
        let mut left = f64::INFINITY;
        for _ in 0..LAG_ROUNDS {
            let late = &delayed(source.campaign, shape, time_s);
            let sampled = Source { campaign: late, ..*source };
            let (residual, rest) = found.search.with_lagged(&sampled.sampled(), &found.cut)?;
            left = residual;
            time_s += rest;
            if rest.abs() < LAG_SETTLED * sample_s {
                break;
            }
        }
        Some((time_s, left))
    };
    let delay = settled(LagShape::Delay)?;
    // A filter does not look ahead.
    let filter =
        if lag.value > 0.0 { settled(LagShape::Filter).filter(|f| f.0 > 0.0) } else { None };
    let (shape, (time_s, left)) = match filter {
        Some(filter) if filter.1 < LAG_SHAPE_TOLD * delay.1 => (LagShape::Filter, filter),
        Some(filter) if delay.1 > LAG_SHAPE_TOLD * filter.1 => (LagShape::Either, delay),
        _ => (LagShape::Delay, delay),
    };
    Some((shape, time_s, left / without))
}

/// The model that some windows give, before the curve.
struct Found<'a> {
    search: Search<'a>,
    cut: Cut,
    line_residual: f64,
    /// Of the windows, ascending.
    speeds: Vec<f64>,
}

impl<'a> Found<'a> {
    fn of(sampled: &'a Sampled<'a>, lag_known: bool) -> Option<Self> {
        let places = sampled.places();
        let mut speeds: Vec<f64> = places.iter().map(|p| p.speed).collect();
        let mut angles: Vec<f64> = places.iter().map(|p| p.angle).collect();
        rayon::join(
            || speeds.sort_unstable_by(f64::total_cmp),
            || angles.sort_unstable_by(f64::total_cmp),
        );
        let quantile = |x: &[f64], q: f64| x.get((q * x.len() as f64) as usize).copied();
        let fastest = quantile(&speeds, FASTEST_QUANTILE).filter(|v| *v > 0.0)?;
        let cut = Cut {
            middle: quantile(&angles, 0.5)?,
            thirds: [quantile(&speeds, 1.0 / 3.0)?, quantile(&speeds, 2.0 / 3.0)?],
        };
        let (search, line_residual) = choose(sampled, &cut, fastest, lag_known)?;
        Some(Self { search, cut, line_residual, speeds })
    }

    /// The lag of the command that was adopted in a source's windows, and the term as it was tried.
    fn lag(&self, source: &Source<'_>) -> Option<(AngleLag, LawCandidate)> {
        let first = self.search.lag()?;
        let tried = self.search.candidates.iter().rev().find(|c| c.taken && c.term == LAG);
        let (shape, time_s, residual_ratio) = shape_of_lag(source, self, first)?;
        let samples = time_s / source.campaign.runs.first()?.sample_time_s();
        let lag = AngleLag { time_s, samples, shape, residual_ratio, std_s: first.std };
        Some((lag, *tried?))
    }

    /// The terms that are not known to be absent.
    fn possible(&self) -> Option<Vec<PossibleTerm>> {
        self.search.possible(&Motion::of(&self.search.sampled.motion())?)
    }

    /// The model with the curve, and the sums that the curve is from.
    fn law(
        &self,
        sampled: &Sampled<'_>,
        lag: Option<AngleLag>,
        possible: Vec<PossibleTerm>,
        line: ByBlock,
    ) -> Option<(FrictionLaw, CurveSums)> {
        let Self { search, cut, speeds, line_residual } = self;
        let in_motion = sampled.motion();
        let motion = Motion::of(&in_motion)?;
        let (fit, residual, missing) = search.fit(&motion, lag)?;
        let sums = CurveSums::new(sampled, cut, speeds, &search.not_by_speed())?;
        let (curve, by_curve) = sums.by_blocks()?;
        let law = FrictionLaw {
            window_s: sampled.window_s,
            speed_range: [*speeds.first()?, *speeds.last()?],
            line_speed_range: in_motion
                .iter()
                .fold([f64::INFINITY, 0.0], |[low, high], [v, _]| [low.min(*v), high.max(*v)]),
            curve,
            relative_residual: [*line_residual, residual, by_curve],
            candidates: search.candidates.clone(),
            chosen: fit,
            missing,
            lag,
            possible,
            unused: Unused {
                line,
                model: search.left_out_by_law()?,
                power: search.divided.total().power(),
                cut: *cut,
            },
            left_out_of_regression: None,
            motion,
        };
        Some((law, sums))
    }
}

/// Length of the shortest windows in which the motor's sensor makes no more than [`TORQUE_OF_NOISE`] of the torque, and no
/// longer than the regression's.
fn short_windows(source: &Source<'_>, motor: &MotorRegression, inertia: f64) -> f64 {
    let campaign = source.campaign;
    let sample_s = campaign.runs.iter().map(Run::sample_time_s).fold(0.0, f64::max);
    // White noise σ in the angle makes σ·√T of every scaled row.
    let of_run = |run: &Run| {
        let sensor: ChannelNoise = channel_noise(run.motor());
        sensor.std * run.sample_time_s().sqrt()
    };
    let sensor = campaign.runs.par_iter().with_max_len(1).map(of_run).reduce(|| 0.0, f64::max);
    let mut window_s = LEAST_SAMPLES * sample_s;
    loop {
        let sampled_source = Source { window_s, ..*source };
        let sampled = sampled_source.sampled();
        let little = |power: f64| inertia.abs() * sensor < TORQUE_OF_NOISE * power.sqrt();
        let longest = window_s * LONGER >= motor.window_s;
        if longest || sampled.power().is_some_and(little) {
            return window_s;
        }
        window_s *= LONGER;
    }
}
