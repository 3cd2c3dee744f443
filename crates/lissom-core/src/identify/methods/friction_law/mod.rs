//! Friction against speed: as a curve without a law, and as the simplest law that the data do not reject.
//!
//! Both are least squares on windows in slip phases, as in the regression. The windows are as short as the sensor
//! allows, because long windows average out the change of friction near rest.

pub(crate) mod choice;
mod column_values;
mod curve;
mod described;
mod friction_law_findings;
mod held;
mod law_estimates;
mod law_in_arm;
mod law_rows;
mod law_term;
mod refine;
mod ripple;
mod rows;
#[cfg(test)]
mod tests;
pub(crate) mod thresholds;

pub use choice::LawCandidate;
pub use curve::CurvePoint;
pub(crate) use curve::CurveSums;
pub(crate) use friction_law_findings::finding;
pub(crate) use law_term::NEAR_REST_STEP;
pub use law_term::{LawTerm, ScaleUnit};

use rayon::prelude::*;

use crate::identify::estimate::Estimate;
use crate::identify::gravity_estimate::Gravity;
use crate::identify::methods::friction_law::thresholds::{
    AFTER_TRAVEL_LEAVES, FASTEST_QUANTILE, LAG_FALLS_TO, NOTHING_LEFT, TORQUE_OF_NOISE,
    TRAVEL_AFTER_REVERSAL,
};
use crate::identify::methods::output_error::OutputError;
use crate::identify::methods::regression::{MissingKind, MotorRegression, Terms};
use crate::identify::prepare::channel_noise::{ChannelNoise, channel_noise};
use crate::identify::prepare::prepared::Prepared;
use crate::identify::thresholds::{RESIDUAL_FALLS_TO, SIGN_SHOWN};
use crate::record::{Campaign, Run};
use choice::Choice;
use described::Described;
use rows::{Cut, Sampled};

/// Fewest samples in a window.
const LEAST_SAMPLES: f64 = 20.0;
/// Ratio of one window tried to that before it.
const LONGER: f64 = std::f64::consts::SQRT_2;

/// Friction against speed, and its law.
#[derive(Debug, Clone, PartialEq)]
pub struct FrictionLaw {
    /// Length of the windows \[s\].
    pub window_s: f64,
    /// Lowest and highest speed of the windows \[rad/s\]; law and curve are valid between these.
    pub speed_range: [f64; 2],
    /// Friction against speed without a law; for each direction ascending in speed.
    pub curve: Vec<CurvePoint>,
    /// All terms that were tried, in order.
    pub candidates: Vec<LawCandidate>,
    /// Estimates with the law that was chosen.
    pub chosen: LawFit,
    /// Relative residual ‖y − X·q‖/‖y‖ with Coulomb friction and one viscous constant, with the chosen law, and with
    /// the curve \[1\].
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
    /// With the curve that the output-error method's arm gives, if there is one that describes the runs: with what it
    /// knows of the arm, or with standard errors that count what it knows of friction.
    pub(crate) fn beside(self, sums: &CurveSums, replay: Option<&OutputError>) -> Self {
        let Some(found) = replay else { return self };
        let curve = match sums.beside_arm(found) {
            Some(curve) => curve,
            None => sums.beside_law(self.curve, found),
        };
        Self { curve, ..self }
    }

    /// Whether beside the law a lag of the command explains nothing that pays for it.
    pub(crate) fn leaves_no_lag(&self) -> bool {
        let lags = self.candidates.iter().filter(|c| c.term == LawTerm::CommandLag);
        let last = lags.max_by_key(|c| c.beside);
        last.is_some_and(|c| c.beside > 0 && c.residual_ratio > LAG_FALLS_TO)
    }

    /// Terms that were tried last of their kind, those of the law first.
    pub(crate) fn tried(&self) -> Vec<LawTerm> {
        let chosen = self.chosen.terms.iter().map(|(term, _)| *term);
        let mut found: Vec<LawTerm> = chosen.collect();
        for c in self.candidates.iter().rev() {
            if found.iter().all(|t| t.name() != c.term.name()) {
                found.push(c.term);
            }
        }
        found
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

    /// Whether Coulomb friction, surely there, may have grown from `less` than it is.
    fn may_grow_by(&self, less: f64) -> bool {
        let sure = |e: &Estimate| e.value > SIGN_SHOWN * e.std;
        let surely = self.inertia.as_ref().is_some_and(sure);
        surely && self.coulomb.is_some_and(|c| sure(&c) && 0.0 < less && less < c.value)
    }

    /// Whether the law has terms in addition to Coulomb friction and one viscous constant.
    pub fn departs(&self) -> bool {
        self.terms.iter().any(|(term, _)| *term != LawTerm::CommandLag)
    }
}

/// Curve and law of a campaign whose motor's estimates are roughly known, and the sums that the curve is
/// from; `None` where slip phases are too few or too short.
pub(crate) fn friction_law(
    prepared: &Prepared<'_>,
    motor: &MotorRegression,
) -> Option<(FrictionLaw, CurveSums)> {
    let inertia = motor.inertia?.value;
    let (campaign, noise) = (prepared.used(), prepared.noise());
    let runs = campaign.runs.par_iter().with_max_len(1);
    let sensors: Vec<ChannelNoise> = runs.map(|run| channel_noise(run.motor())).collect();
    let step = sensors.iter().map(|sensor| sensor.step).fold(0.0, f64::max);
    let load = motor.gravity.map(|g| g.load());
    let mode = motor.mode.map(|m| m.shape());
    let windows_of = |window_s: f64| {
        let mut sampled = Sampled::new(campaign, noise, window_s, mode);
        (sampled.load, sampled.step) = (load, step);
        sampled
    };
    // A mode that no tip shows enters by fourth derivatives: noise fills short windows.
    let mut sampled = match mode {
        Some(_) => windows_of(motor.window_s),
        None => short_windows(windows_of, campaign, motor, (inertia, &sensors)),
    };
    let found = UnderLaw::of(&sampled)?;
    let (mut law, mut sums) = found.with_curve(&sampled)?;
    let mut described = found.choice.described;
    // In windows so short noise may hide a term that the regression's own windows show.
    let by_speed = motor.missing.is_some_and(|m| m.kind == MissingKind::Stribeck);
    if by_speed && !law.chosen.departs() && sampled.window_s < motor.window_s {
        let longer = windows_of(motor.window_s);
        let found = UnderLaw::of(&longer).filter(|found| found.choice.fit.departs());
        if let Some((with_curve, found)) = found.and_then(|f| Some((f.with_curve(&longer)?, f))) {
            (law, sums) = with_curve;
            described = found.choice.described;
            sampled = longer;
        }
    }
    if described.left(&sampled).beyond_noise() < NOTHING_LEFT {
        return Some((law, sums));
    }
    Some(after_travel(&sampled, &described).unwrap_or((law, sums)))
}

/// The same without what follows reversals, where it describes the rest far better than the law of all
/// windows does: bristles (presliding), a soft transmission or a sensor's play let friction grow over some
/// travel, and no function of speed does.
fn after_travel(sampled: &Sampled<'_>, whole: &Described) -> Option<(FrictionLaw, CurveSums)> {
    let travels = sampled.travels();
    let usual = *travels.get(travels.len() / 2)?;
    let windows = sampled.places().len();
    let shares = TRAVEL_AFTER_REVERSAL.into_par_iter().with_max_len(1);
    let tried = shares.map(|share| {
        let after = sampled.beginning_after(share * usual);
        if after.places().len() < windows / 2 {
            return None;
        }
        let found = UnderLaw::of(&after);
        let found = found.and_then(|found| {
            let described = &found.choice.described;
            let (with, without) = (described.left(&after), whole.left(&after));
            let less = -described.left(sampled).more_friction_without(&with);
            // On the same windows: without some, little may be left of what was never to be explained.
            let worth = with.beyond_noise() < AFTER_TRAVEL_LEAVES * without.beyond_noise()
                && with.relative() < RESIDUAL_FALLS_TO * without.relative();
            found.choice.fit.may_grow_by(less).then_some((found, worth))
        });
        Some((after, found))
    });
    // Of longer travels there are fewer windows yet.
    let tried = tried.collect::<Vec<_>>().into_iter().map_while(|tried| tried);
    let tried = tried.filter_map(|(after, found)| Some((after, found?)));
    let mut tried: Vec<_> = tried.collect();
    tried.iter().any(|(_, (_, worth))| *worth).then_some(())?;
    tried.sort_by(|(_, (a, _)), (_, (b, _))| a.choice.residual.total_cmp(&b.choice.residual));
    tried.iter().find_map(|(after, (found, _))| found.with_curve(after))
}

/// The law of some windows, before the curve.
struct UnderLaw {
    choice: Choice,
    cut: Cut,
    /// Of the windows, ascending.
    speeds: Vec<f64>,
}

impl UnderLaw {
    fn of(sampled: &Sampled<'_>) -> Option<Self> {
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
        let choice = choice::choose(sampled, &cut, fastest)?;
        Some(Self { choice, cut, speeds })
    }

    /// The law with the curve, and the sums that the curve is from.
    fn with_curve(&self, sampled: &Sampled<'_>) -> Option<(FrictionLaw, CurveSums)> {
        let Self { choice, cut, speeds } = self;
        let (columns, terms) = &choice.beside;
        let sums = CurveSums::new(sampled, cut, speeds, (columns, terms))?;
        let (curve, by_curve) = sums.by_phases()?;
        let law = FrictionLaw {
            window_s: sampled.window_s,
            speed_range: [*speeds.first()?, *speeds.last()?],
            curve,
            relative_residual: [choice.simplest, choice.residual, by_curve],
            candidates: choice.candidates.clone(),
            chosen: choice.fit.clone(),
        };
        Some((law, sums))
    }
}

/// The shortest windows in which the motor's sensor makes no more than [`TORQUE_OF_NOISE`] of the torque, and no
/// longer than the regression's.
fn short_windows<'a>(
    windows_of: impl Fn(f64) -> Sampled<'a>,
    campaign: &Campaign,
    motor: &MotorRegression,
    (inertia, sensors): (f64, &[ChannelNoise]),
) -> Sampled<'a> {
    let sample_s = campaign.runs.iter().map(Run::sample_time_s).fold(0.0, f64::max);
    // White noise σ in the angle makes σ·√T of every scaled row.
    let of_run = |(run, sensor): (&Run, &ChannelNoise)| sensor.std * run.sample_time_s().sqrt();
    let sensor = campaign.runs.iter().zip(sensors).map(of_run).fold(0.0, f64::max);
    let mut window_s = LEAST_SAMPLES * sample_s;
    loop {
        let sampled = windows_of(window_s);
        let little = |power: f64| inertia.abs() * sensor < TORQUE_OF_NOISE * power.sqrt();
        let longest = window_s * LONGER >= motor.window_s;
        if longest || sampled.power().is_some_and(little) {
            return sampled;
        }
        window_s *= LONGER;
    }
}
