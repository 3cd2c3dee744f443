//! Torque of friction over a cycle, from the replay, in place of the square wave of (30).

use num_complex::Complex64;

use crate::identify::output_error::OutputError;
use crate::identify::prepare::run_analysis::Sinusoidal;
use crate::identify::responses::correct::Response;
use crate::identify::responses::thresholds::WAVEFORM_PERIODS;
use crate::record::{Campaign, Hold};
use crate::replay::{ModalArm, Window, predict};
use crate::spectrum::hold_factor;

/// Lines of the spectrum beside the fundamental that noise is read off, on either side: Hann's window
/// spreads a line over its neighbours, and the next harmonic is as many lines away as there are periods.
const LINES: usize = 6;
/// Harmonics that repeated noise is read off.
const HARMONICS: u32 = 9;

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
    /// itself. Friction's jumps lie between samples: of the ratio they leave up to some 0.1 %. So only
    /// what the motor shows beyond the arm's motion is divided, `G_arm + (θ_m − θ_arm)/(i − f)`.
    ///
    /// The deviation is that of the noise ([`Self::noise`]) and of the arm's parameters. `None` where
    /// the replay covers too few periods.
    pub(crate) fn response(&self) -> Option<Response> {
        let arm = &self.found.arm;
        let net = self.net(arm)?;
        let spectrum = Spectrum::new(self, arm, &net);
        let by_parameters = self.found.variances(&|arm| {
            let spectrum = Spectrum::new(self, arm, &self.net(arm)?);
            Some(vec![self.value(arm, &spectrum.at(0.0))])
        })?;
        let by_parameters = by_parameters.first().copied().unwrap_or(0.0);
        let variance = self.noise(&spectrum, net.periods) + by_parameters;
        Some(Response { value: self.value(arm, &spectrum.at(0.0)), std: variance.sqrt() })
    }

    fn value(&self, arm: &ModalArm, line: &Line) -> Complex64 {
        self.own(arm, 0.0) + line.beyond / line.command
    }

    /// The arm's response `shift` rad/s beside the fundamental.
    fn own(&self, arm: &ModalArm, shift: f64) -> Complex64 {
        let constant = self.campaign.channels.command.torque_per_unit();
        constant * arm.motor_response(self.steady.omega_rad_s + shift)
    }

    /// Variance by what the lines beside the fundamental hold beyond the arm's motion, and by what the
    /// harmonics hold: a sensor's steps err alike in every period, on these lines alone. And no less than what the fundamental itself holds beyond
    /// the arm's: noise of the sensor comes back through the loop, and is then no less in the command.
    fn noise(&self, spectrum: &Spectrum, periods: usize) -> f64 {
        let left = |shift: f64| spectrum.at(shift).beyond.norm_sqr();
        let mean = |powers: &[f64]| powers.iter().sum::<f64>() / powers.len().max(1) as f64;
        let line = std::f64::consts::TAU / spectrum.length_s();
        let beside = (2..=LINES.min(periods - 1)).map(|lines| lines as f64 * line);
        let beside: Vec<f64> = beside.flat_map(|shift| [left(-shift), left(shift)]).collect();
        let fundamental = spectrum.at(0.0);
        let power = fundamental.command.norm_sqr();
        let omega = self.steady.omega_rad_s;
        let highest = 0.8 * std::f64::consts::PI / spectrum.sample_time_s;
        let harmonics = (2..=HARMONICS).map(f64::from).filter(|h| h * omega < highest);
        let repeated: Vec<f64> = harmonics.map(|h| left((h - 1.0) * omega)).collect();
        mean(&beside).max(mean(&repeated)).max(fundamental.beyond.norm_sqr()) / power
    }

    /// The command without friction, over whole periods of the steady state.
    fn net(&self, arm: &ModalArm) -> Option<Net> {
        let replayed = Waveform::new(arm, self.found, self.campaign, self.run)?;
        let first = replayed.first;
        let run = &self.campaign.runs[self.run];
        let steady = &self.steady.steady;
        let period = std::f64::consts::TAU / (self.steady.omega_rad_s * run.sample_time_s());
        let begin = first.max(steady.first);
        let end = (steady.first + steady.len).min(first + replayed.friction_nm.len());
        let periods = (end.checked_sub(begin)? as f64 / period).floor() as usize;
        let len = (periods as f64 * period).round() as usize;
        let part = |x: Vec<f64>| x.into_iter().skip(begin - first).take(len).collect();
        let (friction, motor) = (part(replayed.friction_nm), part(replayed.motor));
        (periods >= WAVEFORM_PERIODS).then_some(Net { begin, len, periods, friction, motor })
    }
}

/// Friction's torque and the arm's motion from sample `begin` on, over whole periods.
struct Net {
    begin: usize,
    len: usize,
    periods: usize,
    friction: Vec<f64>,
    motor: Vec<f64>,
}

/// Spectra at one frequency.
struct Line {
    /// What the motor shows beyond the arm's motion.
    beyond: Complex64,
    /// The command without friction.
    command: Complex64,
}

/// Motor and net command about the fundamental.
struct Spectrum {
    omega_rad_s: f64,
    sample_time_s: f64,
    /// Windowed samples: logged motor, the arm's, logged command, friction in the command's unit.
    motor: Vec<f64>,
    of_arm: Vec<f64>,
    command: Vec<f64>,
    friction: Vec<f64>,
    hold: Hold,
    lag_s: f64,
}

impl Spectrum {
    fn new(of: &FrictionWaveform<'_>, arm: &ModalArm, net: &Net) -> Self {
        let run = &of.campaign.runs[of.run];
        let channel = &of.campaign.channels.command;
        let len = net.len.min(net.friction.len()).min(run.len() - net.begin);
        let span = net.begin..net.begin + len;
        let constant = channel.torque_per_unit();
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
            of_arm: windowed(&net.motor[..len], 1.0),
            command: windowed(&run.command()[span], 1.0),
            friction: windowed(&net.friction[..len], 1.0 / constant),
            hold: channel.hold,
            lag_s: arm.command_lag_s,
        }
    }

    fn length_s(&self) -> f64 {
        self.motor.len() as f64 * self.sample_time_s
    }

    /// The spectra `shift` rad/s beside the fundamental.
    fn at(&self, shift: f64) -> Line {
        let omega = self.omega_rad_s + shift;
        let turn = Complex64::from_polar(1.0, -omega * self.sample_time_s);
        let line = |x: &[f64]| {
            // Horner's scheme: Σ x_k·turn^k.
            x.iter().rev().fold(Complex64::ZERO, |sum, x| sum * turn + x)
        };
        let hold = hold_factor(omega, self.sample_time_s);
        let logged = match self.hold {
            Hold::Sampled => line(&self.command) * hold,
            Hold::Measured => line(&self.command),
        };
        let late = Complex64::from_polar(1.0, -omega * self.lag_s);
        let motor = line(&self.motor);
        Line {
            beyond: motor - line(&self.of_arm),
            // Friction is known by its mean over each sample: turned half a sample forward, and lower.
            command: logged * late - line(&self.friction) / hold.conj(),
        }
    }
}

/// Replay of a run, from its first window's first sample on.
struct Waveform {
    first: usize,
    /// Mean torque of friction from each sample to the next.
    friction_nm: Vec<f64>,
    /// The arm's motor at each sample.
    motor: Vec<f64>,
}

impl Waveform {
    fn new(arm: &ModalArm, found: &OutputError, campaign: &Campaign, run: usize) -> Option<Self> {
        let windows: Vec<&Window> = found.windows.iter().filter(|w| w.run == run).collect();
        let first = *windows.first()?.samples.start();
        let (mut friction_nm, mut motor) = (Vec::new(), Vec::new());
        for (k, window) in windows.iter().enumerate() {
            // Up to where the next one begins: windows begin where the motor moves, and leave out rests.
            let end = windows.get(k + 1).map_or(*window.samples.end(), |w| *w.samples.start());
            let whole = Window { samples: *window.samples.start()..=end, ..(*window).clone() };
            let found = predict(arm, campaign, &whole)?;
            motor.extend(&found.channels[0][..found.friction_nm.len()]);
            friction_nm.extend(found.friction_nm);
        }
        Some(Self { first, friction_nm, motor })
    }
}
