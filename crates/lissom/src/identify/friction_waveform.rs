//! Friction's torque over a cycle, from the replay: what (30) takes for a square wave.

use num_complex::Complex64;

use super::correct::Response;
use super::output_error::OutputError;
use super::run_analysis::Sinusoidal;
use crate::record::{Campaign, Hold};
use crate::replay::{ModalArm, Parameter, Window, predict};
use crate::spectrum::{hold_factor, least_squares};

/// Harmonics fitted.
const HARMONICS: usize = 9;
/// Pieces of whole periods that the deviation is taken from, at most.
const PIECES: usize = 8;

/// A sinusoidal run whose friction is known over time.
pub(crate) struct FrictionWaveform<'a> {
    pub(crate) found: &'a OutputError,
    /// The campaign that was replayed, and the run's place in it.
    pub(crate) campaign: &'a Campaign,
    pub(crate) run: usize,
    pub(crate) steady: &'a Sinusoidal,
}

impl FrictionWaveform<'_> {
    /// `G(ω) = θ_m/(i − f)`, f friction's torque in the command's unit.
    ///
    /// While the motor slips f is ±CF (and the offset); while it sticks it is what holds it,
    /// `K·i − C_t`. Both follow from the replay, whose windows fit the log to its noise: the ends of a
    /// stick are known far better than from the angle's steps. Where the command was found to lag, G
    /// is from what acted.
    ///
    /// The deviation is that of pieces of whole periods about the whole, which holds noise and what
    /// is not yet periodic, and that of the arm's parameters. `None` where the replay covers less than
    /// two periods of the steady state.
    pub(crate) fn response(&self) -> Option<Response> {
        let arm = &self.found.arm;
        let net = self.net(arm)?;
        let value = self.ratio(&net, 0, net.periods)?;
        let pieces = PIECES.min(net.periods);
        let each = net.periods / pieces;
        let mut scatter = 0.0;
        for piece in 0..pieces {
            scatter += (self.ratio(&net, piece * each, each)? - value).norm_sqr();
        }
        let scatter = scatter / (pieces as f64 * (pieces as f64 - 1.0).max(1.0));
        let std = (scatter + self.by_parameters(value)?).sqrt();
        Some(Response { value, std })
    }

    /// Variance that the arm's parameters give the response.
    fn by_parameters(&self, value: Complex64) -> Option<f64> {
        let covariance = &self.found.covariance;
        let slope = |(i, p): (usize, &Parameter)| {
            let step = covariance[(i, i)].max(0.0).sqrt();
            if step <= 0.0 {
                return Some(Complex64::ZERO);
            }
            let mut arm = self.found.arm.clone();
            p.set(&mut arm, p.of(&self.found.arm) + step);
            let net = self.net(&arm)?;
            Some((self.ratio(&net, 0, net.periods)? - value) / step)
        };
        let slopes: Vec<Complex64> =
            self.found.parameters.iter().enumerate().map(slope).collect::<Option<_>>()?;
        let mut variance = 0.0;
        for (i, a) in slopes.iter().enumerate() {
            for (j, b) in slopes.iter().enumerate() {
                variance += covariance[(i, j)] * (a * b.conj()).re;
            }
        }
        Some(variance.max(0.0))
    }

    /// The command without friction, over whole periods of the steady state.
    fn net(&self, arm: &ModalArm) -> Option<Net> {
        let (first, torque) = waveform(arm, self.found, self.campaign, self.run)?;
        let run = &self.campaign.runs[self.run];
        let steady = &self.steady.steady;
        let period = std::f64::consts::TAU / (self.steady.omega_rad_s * run.sample_time_s());
        let begin = first.max(steady.first);
        let end = (steady.first + steady.len).min(first + torque.len());
        let periods = (end.checked_sub(begin)? as f64 / period).floor() as usize;
        let friction = torque.into_iter().skip(begin - first).collect();
        (periods >= 2).then_some(Net { begin, period, periods, friction })
    }

    /// Motor angle per net command over `periods` periods from `from` on.
    fn ratio(&self, net: &Net, from: usize, periods: usize) -> Option<Complex64> {
        let run = &self.campaign.runs[self.run];
        let channel = &self.campaign.channels.command;
        let (t, omega) = (run.sample_time_s(), self.steady.omega_rad_s);
        let harmonics = HARMONICS.min((0.4 * net.period) as usize).max(1);
        let at = (from as f64 * net.period).round() as usize;
        let len = (periods as f64 * net.period).round() as usize;
        let fit = |x: &[f64]| Some(least_squares(x, omega, t, harmonics)?.get(1)?.value);
        let samples = net.begin + at..(net.begin + at + len).min(run.len());
        let motor = fit(&run.motor()[samples.clone()])?;
        // Friction is a mean over each sample, as a held command is.
        let hold = hold_factor(omega, t);
        let friction = fit(net.friction.get(at..(at + len).min(net.friction.len()))?)? * hold;
        let constant = channel.torque_per_command.unwrap_or(1.0);
        let logged = fit(&run.command()[samples])?;
        let logged = match channel.hold {
            Hold::Sampled => logged * hold,
            Hold::Measured => logged,
        };
        let late = Complex64::from_polar(1.0, -omega * self.found.arm.command_lag_s);
        Some(motor / (logged * late - friction / constant))
    }
}

/// Friction from sample `begin` on, over whole periods of so many samples.
struct Net {
    begin: usize,
    period: f64,
    periods: usize,
    friction: Vec<f64>,
}

/// Mean torque of friction from each sample to the next, from the first window's first sample on.
fn waveform(
    arm: &ModalArm,
    found: &OutputError,
    campaign: &Campaign,
    run: usize,
) -> Option<(usize, Vec<f64>)> {
    let windows: Vec<&Window> = found.windows.iter().filter(|w| w.run == run).collect();
    let first = *windows.first()?.samples.start();
    let mut torque = Vec::new();
    for (k, window) in windows.iter().enumerate() {
        // Up to where the next one begins: windows begin where the motor moves, and leave out rests.
        let end = windows.get(k + 1).map_or(*window.samples.end(), |w| *w.samples.start());
        let whole = Window { samples: *window.samples.start()..=end, ..(*window).clone() };
        torque.extend(predict(arm, campaign, &whole)?.friction_nm);
    }
    Some((first, torque))
}
