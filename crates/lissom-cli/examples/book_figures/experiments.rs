//! Virtual experiments, and evenly or logarithmically spaced values.

use std::f64::consts::TAU;

use lissom::record::Campaign;
use lissom::rig::{Experiment, Mode, Rig, RigError, Settle};

/// Time before a log begins, in which the beam's transient decays \[s\].
const SETTLE_S: f64 = 300.0;

/// A sine after a whole number of periods, so that its phase is zero where the log begins.
pub(crate) fn settled_sine(
    omega_rad_s: f64,
    amplitude_rad: f64,
    record_s: f64,
) -> Result<Experiment, RigError> {
    let period_s = TAU / omega_rad_s;
    let wait_s = (SETTLE_S / period_s).ceil() * period_s;
    let sine = Experiment::sine(omega_rad_s, amplitude_rad, record_s)?;
    Ok(sine.settling(Settle::Wait { wait_s }))
}

/// Runs of these experiments on the rig with its one tip. The seeds of their noise count up from `seed`.
pub(crate) fn campaign(
    rig: &Rig,
    experiments: &[Experiment],
    seed: u64,
) -> Result<Campaign, Box<dyn std::error::Error>> {
    let run = |(seed, experiment): (u64, &Experiment)| {
        Ok(rig.run(&format!("run {seed}"), experiment, seed)?.run)
    };
    let runs = (seed..).zip(experiments).map(run).collect::<Result<_, RigError>>()?;
    Ok(Campaign::new(rig.channels(0..1)?, runs)?)
}

/// True motor angles and velocities at the rows of a log.
pub(crate) struct Motion {
    /// Since the log began \[s\].
    pub(crate) time_s: Vec<f64>,
    /// Reference \[rad\].
    pub(crate) reference_rad: Vec<f64>,
    /// Motor angle \[rad\].
    pub(crate) angle_rad: Vec<f64>,
    /// Motor velocity; exactly zero while the joint sticks \[rad/s\].
    pub(crate) velocity_rad_s: Vec<f64>,
}

impl Motion {
    /// The true motion in an experiment on the rig with its own controller.
    pub(crate) fn of(rig: &Rig, experiment: &Experiment) -> Result<Self, RigError> {
        let (mut angle_rad, mut velocity_rad_s) = (Vec::new(), Vec::new());
        let mut controller = rig.controller.clone();
        let logged = rig.run_watched(&mut controller, "run", experiment, 0, &mut |row| {
            angle_rad.push(row.state[0]);
            velocity_rad_s.push(row.state[1]);
        })?;
        let time = logged.run.time();
        let time_s: Vec<f64> =
            (0..angle_rad.len()).map(|k| k as f64 * time.sample_time_s).collect();
        let reference = experiment.drive.reference();
        let reference_rad = time_s.iter().map(|t| reference.value(time.start_s + t)).collect();
        Ok(Self { time_s, reference_rad, angle_rad, velocity_rad_s })
    }

    /// The rows from one time to another; the first time becomes zero.
    pub(crate) fn part(&self, from_s: f64, to_s: f64) -> Self {
        let rows: Vec<usize> =
            (0..self.time_s.len()).filter(|k| (from_s..=to_s).contains(&self.time_s[*k])).collect();
        let of = |list: &[f64]| rows.iter().map(|k| list[*k]).collect::<Vec<_>>();
        Self {
            time_s: of(&self.time_s).iter().map(|t| t - from_s).collect(),
            reference_rad: of(&self.reference_rad),
            angle_rad: of(&self.angle_rad),
            velocity_rad_s: of(&self.velocity_rad_s),
        }
    }

    /// Ends of the intervals in which the joint sticks, or slips one way \[s\].
    pub(crate) fn intervals(&self, mode: Mode) -> Vec<(f64, f64)> {
        let same = |k: &usize| match self.velocity_rad_s[*k] {
            v if v > 0.0 => mode == Mode::Forward,
            v if v < 0.0 => mode == Mode::Backward,
            _ => mode == Mode::Stick,
        };
        let rows: Vec<usize> = (0..self.time_s.len()).filter(same).collect();
        let step_s = self.time_s[1] - self.time_s[0];
        rows.chunk_by(|a, b| b - a == 1)
            .map(|part| (self.time_s[part[0]], self.time_s[part[part.len() - 1]] + step_s))
            .collect()
    }
}

/// `count` values from `low` to `high`, evenly spaced.
pub(crate) fn even(low: f64, high: f64, count: usize) -> Vec<f64> {
    (0..count).map(|k| low + (high - low) * k as f64 / (count - 1) as f64).collect()
}

/// Both lists as one, ascending: a grid that meets resonances.
pub(crate) fn merged(mut grid: Vec<f64>, more: Vec<f64>) -> Vec<f64> {
    grid.extend(more);
    grid.sort_by(f64::total_cmp);
    grid
}

/// `count` values from `low` to `high` in equal ratios.
pub(crate) fn ratios(low: f64, high: f64, count: usize) -> Vec<f64> {
    even(low.ln(), high.ln(), count).into_iter().map(f64::exp).collect()
}
