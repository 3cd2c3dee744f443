//! Friction's torque over a cycle, from the replay: what (30) takes for a square wave.

use num_complex::Complex64;

use super::correct::Response;
use super::output_error::OutputError;
use super::run_analysis::Sinusoidal;
use crate::record::{Campaign, Hold};
use crate::replay::{ModalArm, Parameter, Window, predict};
use crate::spectrum::hold_factor;

/// Fewest periods.
const PERIODS: usize = 3;
/// Lines of the spectrum beside the fundamental that noise is read off, on either side: Hann's window
/// spreads a line over its neighbours, and the next harmonic is as many lines away as there are periods.
const LINES: usize = 6;

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
    /// Spectra are taken with Hann's window over whole periods, which keeps what is not yet periodic to
    /// itself. The deviation is that of the lines beside the fundamental, the arm's own response taken
    /// out, and that of the arm's parameters. `None` where the replay covers too few periods.
    pub(crate) fn response(&self) -> Option<Response> {
        let arm = &self.found.arm;
        let net = self.net(arm)?;
        let spectrum = Spectrum::new(self, &net);
        let (motor, command) = spectrum.at(0.0);
        let value = motor / command;
        let line = std::f64::consts::TAU / (net.len as f64 * spectrum.sample_time_s);
        let constant = self.campaign.channels.command.torque_per_command.unwrap_or(1.0);
        let mut noise = 0.0;
        let beside: Vec<usize> = (2..=LINES.min(net.periods - 1)).collect();
        for lines in &beside {
            for side in [-1.0, 1.0] {
                let shift = side * *lines as f64 * line;
                let (motor, command) = spectrum.at(shift);
                let own = constant * arm.motor_response(self.steady.omega_rad_s + shift);
                noise += (motor - own * command).norm_sqr();
            }
        }
        let noise = noise / (2 * beside.len()) as f64 / command.norm_sqr();
        let std = (noise + self.by_parameters(value)?).sqrt();
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
            let (motor, command) = Spectrum::new(self, &self.net(&arm)?).at(0.0);
            Some((motor / command - value) / step)
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
        let len = (periods as f64 * period).round() as usize;
        let friction = torque.into_iter().skip(begin - first).take(len).collect();
        (periods >= PERIODS).then_some(Net { begin, len, periods, friction })
    }
}

/// Friction from sample `begin` on, over whole periods.
struct Net {
    begin: usize,
    len: usize,
    periods: usize,
    friction: Vec<f64>,
}

/// Motor and net command about the fundamental.
struct Spectrum {
    omega_rad_s: f64,
    sample_time_s: f64,
    /// Windowed samples: motor, logged command, friction in the command's unit.
    motor: Vec<f64>,
    command: Vec<f64>,
    friction: Vec<f64>,
    hold: Hold,
    lag_s: f64,
}

impl Spectrum {
    fn new(of: &FrictionWaveform<'_>, net: &Net) -> Self {
        let run = &of.campaign.runs[of.run];
        let channel = &of.campaign.channels.command;
        let len = net.len.min(net.friction.len()).min(run.len() - net.begin);
        let span = net.begin..net.begin + len;
        let constant = channel.torque_per_command.unwrap_or(1.0);
        let windowed = |x: &[f64], scale: f64| {
            let mean = x.iter().sum::<f64>() / len as f64;
            let rate = std::f64::consts::TAU / len as f64;
            let hann = |k: usize| 0.5 - 0.5 * (rate * k as f64).cos();
            x.iter().enumerate().map(|(k, x)| scale * hann(k) * (x - mean)).collect()
        };
        Self {
            omega_rad_s: of.steady.omega_rad_s,
            sample_time_s: run.sample_time_s(),
            motor: windowed(&run.motor()[span.clone()], 1.0),
            command: windowed(&run.command()[span], 1.0),
            friction: windowed(&net.friction[..len], 1.0 / constant),
            hold: channel.hold,
            lag_s: of.found.arm.command_lag_s,
        }
    }

    /// Motor and net command `shift` rad/s beside the fundamental.
    fn at(&self, shift: f64) -> (Complex64, Complex64) {
        let omega = self.omega_rad_s + shift;
        let turn = Complex64::from_polar(1.0, -omega * self.sample_time_s);
        let line = |x: &[f64]| {
            // Horner's scheme: Σ x_k·turn^k.
            x.iter().rev().fold(Complex64::ZERO, |sum, x| sum * turn + x)
        };
        // Friction is a mean over each sample, as a held command is.
        let hold = hold_factor(omega, self.sample_time_s);
        let logged = match self.hold {
            Hold::Sampled => line(&self.command) * hold,
            Hold::Measured => line(&self.command),
        };
        let late = Complex64::from_polar(1.0, -omega * self.lag_s);
        (line(&self.motor), logged * late - line(&self.friction) * hold)
    }
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
