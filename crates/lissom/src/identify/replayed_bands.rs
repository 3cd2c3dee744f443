//! Corrected responses in bands from the replay: what the arm shows, and what the log shows beyond it.

use num_complex::Complex64;

use super::correct::Response;
use super::output_error::OutputError;
use crate::record::{Campaign, Hold};
use crate::replay::{ModalArm, Window, predict};
use crate::spectrum::{Band, Bin, Lines, average, groups, hold_factor};

/// A band's frequency is another's to this share.
const NEAR: f64 = 0.03;

/// Bands of runs that an arm was found to describe from end to end.
pub(crate) struct ReplayedBands<'a> {
    found: &'a OutputError,
    /// Torque per command.
    constant: f64,
    /// From the command without friction to what the motor shows beyond the arm's motion.
    beyond: Vec<Band>,
}

impl<'a> ReplayedBands<'a> {
    /// Of `runs` of the campaign that was replayed; those cut into several windows are left out.
    /// `None` where nothing drives a band.
    pub(crate) fn new(found: &'a OutputError, campaign: &Campaign, runs: &[usize]) -> Option<Self> {
        let constant = campaign.channels.command.torque_per_command.unwrap_or(1.0);
        let lines = |arm: &ModalArm| -> Vec<Vec<Bin>> {
            let windows = runs.iter().filter_map(|&run| whole(found, run));
            let beyond = windows.filter_map(|w| beyond(arm, campaign, w, constant));
            groups(&beyond.collect::<Vec<_>>())
        };
        let bands: Option<Vec<Band>> = lines(&found.arm).iter().map(|b| following(b)).collect();
        let mut beyond = bands?;
        let by_parameters = found.variances(&|arm| {
            let response = |(band, bins): (&Band, &Vec<Bin>)| {
                let own = constant * arm.motor_response(band.omega_rad_s);
                Some(own + average(bins)?.response)
            };
            beyond.iter().zip(&lines(arm)).map(response).collect()
        })?;
        for (band, variance) in beyond.iter_mut().zip(by_parameters) {
            band.std = band.std.hypot(variance.sqrt());
        }
        Some(Self { found, constant, beyond })
    }

    /// `Ĝ(ω) = G(ω) + Σ E·U* / Σ|U|²` over the lines of the band at ω.
    ///
    /// G is the arm's response, E the spectrum of what the motor shows beyond the arm's motion, U that
    /// of the command without friction, as held and as late as it acted. E holds the sensor's noise
    /// and what the arm has not, but no transient, no friction, and nothing of the change of G within
    /// the band: those are in the arm's motion. What is wrong in the arm's parameters is in G and,
    /// with the other sign, in E; what remains of it counts in the deviation. `None` where no band is.
    pub(crate) fn response(&self, omega_rad_s: f64) -> Option<Response> {
        let distance = |b: &&Band| (b.omega_rad_s / omega_rad_s - 1.0).abs();
        let band = self.beyond.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
        let own = self.constant * self.found.arm.motor_response(omega_rad_s);
        (distance(&band) < NEAR).then(|| Response { value: own + band.response, std: band.std })
    }
}

/// The window of a run that was replayed in one.
fn whole(found: &OutputError, run: usize) -> Option<&Window> {
    let mut windows = found.windows.iter().filter(|w| w.run == run);
    let window = windows.next()?;
    windows.next().is_none().then_some(window)
}

/// Spectra of the command without friction, and of the motor beyond the arm's motion.
fn beyond(arm: &ModalArm, campaign: &Campaign, window: &Window, constant: f64) -> Option<Lines> {
    let motion = predict(arm, campaign, window)?;
    let run = &campaign.runs[window.run];
    let span = *window.samples.start()..*window.samples.end();
    let friction: Vec<f64> = motion.friction_nm.iter().map(|f| f / constant).collect();
    let logged = &run.motor()[span.clone()];
    let left: Vec<f64> = logged.iter().zip(&motion.channels[0]).map(|(y, p)| y - p).collect();
    let mut lines = Lines::new(&run.command()[span], &left, run.sample_time_s());
    let friction = Lines::new(&friction, &left, run.sample_time_s());
    for (bin, friction) in lines.bins.iter_mut().zip(&friction.bins) {
        let hold = hold_factor(bin.omega_rad_s, run.sample_time_s());
        let held = match campaign.channels.command.hold {
            Hold::Sampled => hold,
            Hold::Measured => Complex64::ONE,
        };
        let late = Complex64::from_polar(1.0, -bin.omega_rad_s * arm.command_lag_s);
        // Friction is known by its mean over each sample: turned half a sample forward, and lower.
        bin.input = bin.input * held * late - friction.input / hold.conj();
    }
    Some(lines)
}

/// How E follows U in a band, and with what deviation.
///
/// E's power at the lines is its mean over the band or its mean at the lines that are driven,
/// whichever is larger: a sensor's steps come back with a repeated motion and err at its lines alone.
/// What follows U beyond that is counted in the deviation too: it may be what the arm has not, but
/// also noise of the sensor that the loop has brought to the command.
fn following(bins: &[Bin]) -> Option<Band> {
    let band = average(bins)?;
    let (mut driven, mut all, mut power) = (0.0, 0.0, 0.0);
    for bin in bins {
        driven += bin.input.norm_sqr() * bin.output.norm_sqr();
        all += bin.output.norm_sqr();
        power += bin.input.norm_sqr();
    }
    let noise = (driven / power).max(all / bins.len() as f64) / power;
    Some(Band { std: noise.max(band.response.norm_sqr()).sqrt(), ..band })
}
