//! Tries one run until it is good, as an engineer who looks at each log.

use lissom::record::Run;
use lissom::rig::{Experiment, Logged, RigError, RigFinding};

use crate::bench::Bench;
use crate::plan::Idea;
use crate::rejected::Dropped;

/// Largest share of a run in which the joint sticks.
pub(crate) const STUCK_MOST: f64 = 0.15;
/// Smallest amplitude of the motor in steps of its encoder.
const STEPS_LEAST: f64 = 20.0;
/// Bending of the beam above which a run is repeated with a smaller amplitude \[rad\].
const BEND_RAD: f64 = 0.8;
/// Amplitude of the motor, relative to the largest intended, above which a run is not enlarged.
const TRAVEL: f64 = 1.2;
/// Factor of the amplitude for a run that is too small.
const LARGER: f64 = 1.35;
/// Factor of the amplitude for a run that is too large.
const SMALLER: f64 = 0.75;
/// Largest number of tries.
const TRIES: usize = 8;

/// Tries a run with falling or growing amplitudes; returns the log and its experiment.
pub(crate) fn tried(
    bench: &Bench,
    idea: &Idea,
    name: &str,
    seed: u64,
) -> Result<(Logged, Experiment), Dropped> {
    let mut amplitude = idea.reference_rad;
    // The first reason: a run is only enlarged or only reduced, never both.
    let mut first: Option<Dropped> = None;
    for _ in 0..TRIES {
        let experiment = idea.shape.experiment(amplitude).map_err(|_| Dropped::Impossible)?;
        let logged = bench.rig.run(name, &experiment, seed).map_err(|error| match error {
            RigError::Unstable { .. } | RigError::BeyondSensor { .. } => Dropped::Unstable,
            _ => Dropped::Impossible,
        })?;
        let Some(wrong) = wrong(bench, &logged) else { return Ok((logged, experiment)) };
        let first = *first.get_or_insert(wrong);
        if first.is_too_large() != wrong.is_too_large() {
            return Err(if first.is_too_large() { first } else { wrong });
        }
        let far = half_range(logged.run.motor()) > TRAVEL * bench.most_rad;
        if far && !wrong.is_too_large() {
            return Err(wrong);
        }
        amplitude *= if wrong.is_too_large() { SMALLER } else { LARGER };
    }
    Err(first.unwrap_or(Dropped::Impossible))
}

/// The reason why a run is not good, if there is one.
fn wrong(bench: &Bench, logged: &Logged) -> Option<Dropped> {
    let limited = |f: &RigFinding| matches!(f, RigFinding::CurrentLimited { .. });
    if logged.findings.iter().any(limited) {
        Some(Dropped::Current)
    } else if bend(&logged.run) > BEND_RAD {
        Some(Dropped::Bend)
    } else if logged.stuck_share > STUCK_MOST {
        Some(Dropped::Sticks)
    } else if half_range(logged.run.motor()) < STEPS_LEAST * bench.step_rad {
        Some(Dropped::TooSmall)
    } else {
        None
    }
}

/// Half of the difference between the highest and the lowest value.
fn half_range(values: &[f64]) -> f64 {
    let (low, high) =
        values.iter().fold((f64::MAX, f64::MIN), |(low, high), v| (low.min(*v), high.max(*v)));
    0.5 * (high - low)
}

/// Largest angle between a tip and the motor \[rad\].
fn bend(run: &Run) -> f64 {
    let against = |tip: &Vec<f64>| {
        tip.iter().zip(run.motor()).fold(0.0_f64, |most, (t, m)| most.max((t - m).abs()))
    };
    run.tips().iter().map(against).fold(0.0, f64::max)
}
