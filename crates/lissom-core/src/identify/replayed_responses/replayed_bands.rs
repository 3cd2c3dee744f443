//! Responses in bands from the replay: the response of the arm, and the residual of the log.

use num_complex::Complex64;

use crate::identify::output_error::OutputError;
use crate::identify::responses::bands::WithoutFriction;
use crate::identify::responses::correct::Response;
use crate::identify::responses::thresholds::NEAREST_BAND;
use crate::record::{Campaign, Hold, TipQuantity};
use crate::replay::{ModalArm, Prediction, Window, predict};
use crate::spectrum::{Band, Bin, Lines, average, groups, hold_factor};

/// Bands of runs that an arm was found to describe from end to end.
pub(crate) struct ReplayedBands<'a> {
    replayed: Replayed<'a>,
    /// Motor first, then tips: what each shows beyond the arm's, as it follows its input.
    beyond: Vec<Vec<Band>>,
}

impl<'a> ReplayedBands<'a> {
    /// Of `runs` of the campaign that was replayed; those cut into several windows are left out.
    /// `None` where nothing drives a band.
    pub(crate) fn new(
        found: &'a OutputError,
        campaign: &'a Campaign,
        runs: &[usize],
    ) -> Option<Self> {
        let windows: Vec<&Window> = runs.iter().filter_map(|&run| whole(found, run)).collect();
        if windows.is_empty() {
            return None;
        }
        let replayed = Replayed { found, campaign, windows };
        let channels = 0..=campaign.channels.tips.len();
        let follow = |channel: &Vec<Vec<Bin>>| channel.iter().map(|b| following(b)).collect();
        let mut beyond: Vec<Vec<Band>> =
            replayed.bins(&found.arm)?.iter().map(follow).collect::<Option<_>>()?;
        let by_parameters = found.variances(&|arm| {
            let bins = replayed.bins(arm)?;
            let response = |channel: usize| {
                let bands = beyond[channel].iter().zip(&bins[channel]);
                let replayed = &replayed;
                bands.map(move |(band, bins)| {
                    Some(replayed.own(arm, channel, band.omega_rad_s) + average(bins)?.response)
                })
            };
            channels.clone().flat_map(response).collect()
        })?;
        for (band, variance) in beyond.iter_mut().flatten().zip(by_parameters) {
            band.std = band.std.hypot(variance.sqrt());
        }
        Some(Self { replayed, beyond })
    }

    fn response(&self, channel: usize, omega_rad_s: f64) -> Option<Response> {
        let distance = |b: &&Band| (b.omega_rad_s / omega_rad_s - 1.0).abs();
        let bands = self.beyond[channel].iter();
        let band = bands.min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
        let own = self.replayed.own(&self.replayed.found.arm, channel, omega_rad_s);
        (distance(&band) < NEAREST_BAND)
            .then(|| Response { value: own + band.response, std: band.std })
    }
}

impl WithoutFriction for ReplayedBands<'_> {
    /// The motor's response to the command without friction, in the band at ω:
    /// `Ĝ(ω) = G(ω) + Σ E·U* / Σ|U|²` over its lines.
    ///
    /// G is the arm's response, E the spectrum of what the motor shows beyond the arm's motion, U that
    /// of the command without friction, as held and as late as it acted. E holds the sensor's noise
    /// and what the arm has not, but no transient, no friction, and nothing of the change of G within
    /// the band: those are in the arm's motion. What is wrong in the arm's parameters is in G and,
    /// with the other sign, in E; what remains of it counts in the standard error. `None` where no band is.
    fn motor(&self, omega_rad_s: f64) -> Option<Response> {
        self.response(0, omega_rad_s)
    }

    /// A tip's response to the motor in the same way, U the motor's angle and E what the tip shows
    /// beyond the arm's, less what of it the motor's own E explains. `None` also of tips that the replay
    /// did not use.
    fn tip(&self, tip: usize, omega_rad_s: f64) -> Option<Response> {
        let used = self.replayed.campaign.channels.tips[tip].calibrated;
        if used { self.response(1 + tip, omega_rad_s) } else { None }
    }
}

/// The window of a run that was replayed in one.
fn whole(found: &OutputError, run: usize) -> Option<&Window> {
    let mut windows = found.windows.iter().filter(|w| w.run == run);
    let window = windows.next()?;
    windows.next().is_none().then_some(window)
}

/// Runs to replay through the arm found, or one beside it.
struct Replayed<'a> {
    found: &'a OutputError,
    campaign: &'a Campaign,
    windows: Vec<&'a Window>,
}

impl Replayed<'_> {
    /// Lines of every channel, band by band.
    fn bins(&self, arm: &ModalArm) -> Option<Vec<Vec<Vec<Bin>>>> {
        let motions: Option<Vec<Prediction>> =
            self.windows.iter().map(|w| predict(arm, self.campaign, w)).collect();
        let motions = motions?;
        let channel = |channel: usize| {
            let of = |(window, motion): (&&Window, &Prediction)| match channel.checked_sub(1) {
                None => self.motor_lines(arm, window, motion),
                Some(tip) => self.tip_lines(arm, window, motion, tip),
            };
            groups(&self.windows.iter().zip(&motions).map(of).collect::<Vec<_>>())
        };
        Some((0..=self.campaign.channels.tips.len()).map(channel).collect())
    }

    /// The arm's own response: of the motor to the command, of a tip, as it shows it, to the motor.
    fn own(&self, arm: &ModalArm, channel: usize, omega_rad_s: f64) -> Complex64 {
        let Some(tip) = channel.checked_sub(1) else {
            return self.constant() * arm.motor_response(omega_rad_s);
        };
        let angle = arm.tip_response(tip, omega_rad_s);
        match self.campaign.channels.tips[tip].quantity {
            TipQuantity::Angle => angle,
            TipQuantity::Deflection => angle - 1.0,
            TipQuantity::Acceleration => -omega_rad_s * omega_rad_s * angle,
        }
    }

    /// Torque per command.
    fn constant(&self) -> f64 {
        self.campaign.channels.command.torque_per_unit()
    }

    /// From the command without friction to the motor beyond the arm's.
    fn motor_lines(&self, arm: &ModalArm, window: &Window, motion: &Prediction) -> Lines {
        let run = &self.campaign.runs[window.run];
        let span = *window.samples.start()..*window.samples.end();
        let friction: Vec<f64> = motion.friction_nm.iter().map(|f| f / self.constant()).collect();
        let beyond = beyond(&run.motor()[span.clone()], &motion.channels[0]);
        let mut lines = Lines::new(&run.command()[span], &beyond, run.sample_time_s());
        let friction = Lines::new(&friction, &beyond, run.sample_time_s());
        for (bin, friction) in lines.bins.iter_mut().zip(&friction.bins) {
            let hold = hold_factor(bin.omega_rad_s, run.sample_time_s());
            let held = match self.campaign.channels.command.hold {
                Hold::Sampled => hold,
                Hold::Measured => Complex64::ONE,
            };
            let late = Complex64::from_polar(1.0, -bin.omega_rad_s * arm.command_lag_s);
            // Friction is known by its mean over each sample: turned half a sample forward, and lower.
            bin.input = bin.input * held * late - friction.input / hold.conj();
        }
        lines
    }

    /// From the motor to a tip beyond the arm's.
    fn tip_lines(&self, arm: &ModalArm, window: &Window, motion: &Prediction, tip: usize) -> Lines {
        let run = &self.campaign.runs[window.run];
        let span = *window.samples.start()..*window.samples.end();
        let motor = &run.motor()[span.clone()];
        let beyond_tip = beyond(&run.tips()[tip][span], &motion.channels[1 + tip]);
        let mut lines = Lines::new(motor, &beyond_tip, run.sample_time_s());
        let of_motor = Lines::new(motor, &beyond(motor, &motion.channels[0]), run.sample_time_s());
        for (bin, of_motor) in lines.bins.iter_mut().zip(&of_motor.bins) {
            bin.output -= self.own(arm, 1 + tip, bin.omega_rad_s) * of_motor.output;
        }
        lines
    }
}

fn beyond(logged: &[f64], of_arm: &[f64]) -> Vec<f64> {
    logged.iter().zip(of_arm).map(|(y, p)| y - p).collect()
}

/// How E follows U in a band, and with what standard error.
///
/// E's power at the lines is its mean over the band or its mean at the lines that are driven,
/// whichever is larger: a sensor's steps come back with a repeated motion and err at its lines alone.
/// The standard error is never less than what follows U: that may be what the arm has not, but also
/// noise of the sensor that the loop has brought to the command.
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
