//! The motor's equation on windows within slip phases.

use std::borrow::Cow;
use std::ops::Range;
use std::sync::Arc;

use nalgebra::DMatrix;
use rayon::iter::{IndexedParallelIterator, IntoParallelRefIterator, ParallelIterator};

use crate::identify::methods::regression::mode_window::{Derivatives, ModeShape, ModeWindow};
use crate::identify::methods::regression::motor_columns::{INERTIA, MotorColumns, VISCOUS};
use crate::identify::methods::regression::normal::{Cluster, Rows};
use crate::identify::methods::regression::row_noise::{ChannelPart, products};
use crate::identify::methods::regression::thresholds::{BLOCKS_WANTED, FEW_PHASES, SURE_SIGN};
use crate::identify::prepare::phases::{LEAST_SMOOTH, Phase, SMOOTHING_LEAST, unreversed_phases};
use crate::identify::prepare::run_noise::RunNoise;
use crate::identify::prepare::window::{SMOOTHED_PART, WINDOW_STEP, Weights, Window};
use crate::record::{Campaign, CommandQuantity, Hold, Run, TipQuantity};

/// The motor's equation on the windows of all runs.
pub(super) struct MotorRows<'a> {
    pub(super) campaign: &'a Campaign,
    pub(super) columns: MotorColumns,
    runs: Arc<Vec<Slipping<'a>>>,
    /// A mode that no tip shows, which the equation counts.
    mode: Option<ModeShape>,
    /// Factor on the noise that the command's samples show.
    command_noise: f64,
    /// Parts that each phase is cut into.
    parts: usize,
}

impl<'a> MotorRows<'a> {
    pub(super) fn of(campaign: &'a Campaign, noise: &'a [RunNoise]) -> Self {
        let runs = campaign.runs.par_iter().zip(noise).with_max_len(1);
        let runs: Vec<_> =
            runs.map(|(run, noise)| Slipping::of(run, noise, campaign.gravity)).collect();
        let phases = runs.iter().map(Slipping::long_phases).sum::<usize>().max(1);
        let parts = if phases < FEW_PHASES { BLOCKS_WANTED.div_ceil(phases) } else { 1 };
        let columns = MotorColumns::of(campaign);
        Self { campaign, columns, runs: Arc::new(runs), mode: None, command_noise: 1.0, parts }
    }

    /// Multiplies the noise of the command by a factor: part of what looks like noise of the sensor can be torque that the
    /// control loop makes from noise of the encoder, and that torque does act on the motor.
    pub(super) fn with_command_noise(&self, factor: f64) -> Self {
        let (columns, runs) = (self.columns.clone(), Arc::clone(&self.runs));
        Self { columns, runs, command_noise: factor, ..*self }
    }

    /// The same with the columns of a mode that no tip shows.
    pub(super) fn with_mode_columns(&self) -> Self {
        let columns = MotorColumns { mode: true, ..self.columns.clone() };
        Self { columns, runs: Arc::clone(&self.runs), ..*self }
    }

    /// The same, counting a mode that no tip shows.
    pub(super) fn with_mode(&self, mode: ModeShape) -> Self {
        let (columns, runs) = (self.columns.clone(), Arc::clone(&self.runs));
        Self { columns, runs, mode: Some(mode), ..*self }
    }

    /// Slip phases that hold a window of a length.
    pub(super) fn phases(&self, length_s: f64) -> usize {
        self.phases_by_run(length_s).sum()
    }

    /// Runs that there are.
    pub(super) fn runs(&self) -> usize {
        self.runs.len()
    }

    /// Runs with a slip phase that holds a window of a length.
    pub(super) fn runs_with_rows(&self, length_s: f64) -> usize {
        self.phases_by_run(length_s).filter(|phases| *phases > 0).count()
    }

    fn phases_by_run(&self, length_s: f64) -> impl Iterator<Item = usize> {
        let of_run = move |slipping: &Slipping<'_>| {
            let n = (length_s / slipping.run.sample_time_s()).round() as usize;
            let (phases, _) = slipping.phases(n);
            phases.iter().filter(|phase| phase.to - phase.from > n).count()
        };
        self.runs.iter().map(of_run)
    }

    /// Sums of every slip phase of every run, for one length of window.
    pub(super) fn clusters(&self, length_s: f64) -> Vec<Cluster> {
        self.of_runs(length_s, false)
    }

    /// The same, with the column `∫ẇτ` of a later command before the right side.
    pub(super) fn clusters_with_delay(&self, length_s: f64) -> Vec<Cluster> {
        self.of_runs(length_s, true)
    }

    fn of_runs(&self, length_s: f64, with_delay: bool) -> Vec<Cluster> {
        let windows =
            Window::of_runs(&self.campaign.runs, length_s, |index, n| self.runs[index].may_hold(n));
        let of_run = |(index, window): (usize, &Option<Arc<Window>>)| {
            window.as_ref().map_or_else(Vec::new, |w| self.of_run(index, w, with_delay))
        };
        windows.par_iter().with_max_len(1).enumerate().flat_map_iter(of_run).collect()
    }

    fn of_run(&self, index: usize, window: &Window, with_delay: bool) -> Vec<Cluster> {
        let (campaign, slipping) = (self.campaign, &self.runs[index]);
        let (run, n) = (slipping.run, window.len());
        let columns = self.columns.count() + 1 + usize::from(with_delay);
        let step = ((n as f64 * WINDOW_STEP) as usize).max(1);
        let (phases, _) = slipping.phases(n);
        let t = run.sample_time_s();
        let derivatives = self.columns.mode.then(|| Derivatives::of(window, t));
        let known = self.mode.map(|shape| ModeWindow::of(window, shape, t));
        let plain = MotorEquation {
            campaign,
            run,
            columns: &self.columns,
            gravity: slipping.gravity.as_ref(),
            window,
            mode: ModeTerms::of(known.as_ref(), derivatives.as_ref()),
        };
        let of_run = &RunNoise {
            command: self.command_noise * slipping.noise.command,
            ..slipping.noise.clone()
        };
        let noise = plain.noise(of_run, with_delay.then_some(Further::LaterTorque));
        let cluster = |(phase, part): (&Phase, Range<usize>)| {
            let mut cluster = Cluster::new(index, phase.sign, columns);
            let windows = part.step_by(step);
            if with_delay {
                cluster.add_windows(windows, &WithDelay(plain), &noise);
            } else {
                cluster.add_windows(windows, &plain, &noise);
            }
            if let Some(mode) = self.columns.of_mode() {
                cluster.take_out_noise_of_right(mode.torque_twice);
            }
            cluster
        };
        let long = phases.iter().filter(|phase| phase.to - phase.from > n);
        let parts = |phase| in_parts(phase, n, self.parts).map(move |part| (phase, part));
        long.flat_map(parts).map(cluster).collect()
    }
}

/// First samples of the windows of `n` samples in a phase, cut into as many parts as are wanted and hold two windows each.
fn in_parts(phase: &Phase, n: usize, wanted: usize) -> impl Iterator<Item = Range<usize>> {
    let (from, starts) = (phase.from, phase.to - n - phase.from);
    // Windows of neighbouring blocks overlap: in blocks of two lengths and more that is little.
    let parts = wanted.min(starts / (2 * n)).max(1);
    (0..parts).map(move |i| from + starts * i / parts..from + starts * (i + 1) / parts)
}

/// A run with the slip phases that its own smoothing shows.
struct Slipping<'a> {
    run: &'a Run,
    needed: usize,
    smooth: usize,
    phases: Vec<Phase>,
    noise: &'a RunNoise,
    gravity: Option<SineAndCosine>,
}

impl<'a> Slipping<'a> {
    fn of(run: &'a Run, noise: &'a RunNoise, gravity: bool) -> Self {
        let needed = noise.needed_smoothing;
        let smooth = needed.max(SMOOTHING_LEAST);
        let phases = unreversed_phases(run.motor(), smooth, run.sample_time_s(), noise.motor);
        let gravity = gravity.then(|| SineAndCosine::of(run.motor()));
        Self { run, needed, smooth, phases, noise, gravity }
    }

    /// Phases long enough that their velocity has a sure sign in windows of their own length.
    fn long_phases(&self) -> usize {
        self.phases.iter().filter(|phase| phase.to - phase.from > 2 * self.smooth).count()
    }

    /// Phases for windows of `n` samples, and what they are smoothed over; none where the velocity
    /// within so short a window has no sure sign.
    fn phases(&self, n: usize) -> (Cow<'_, [Phase]>, usize) {
        let smooth = self.smooth_for(n);
        let phases = if SURE_SIGN * self.needed as f64 > smooth as f64 {
            Cow::Owned(Vec::new())
        } else if smooth == self.smooth {
            Cow::Borrowed(&self.phases[..])
        } else {
            let Self { run, noise, .. } = self;
            Cow::Owned(unreversed_phases(run.motor(), smooth, run.sample_time_s(), noise.motor))
        };
        (phases, smooth)
    }

    /// What phases for windows of `n` samples are smoothed over.
    fn smooth_for(&self, n: usize) -> usize {
        let most = (n as f64 * SMOOTHED_PART) as usize;
        self.smooth.min(most).max(LEAST_SMOOTH)
    }

    /// Whether a phase may be longer than `n` samples: surely none is where this is false.
    fn may_hold(&self, n: usize) -> bool {
        let longer = |phase: &Phase| phase.to - phase.from > n;
        self.smooth_for(n) != self.smooth || self.phases.iter().any(longer)
    }
}

/// Sine and cosine of the motor's angle at every sample: what gravity follows.
#[derive(Debug)]
pub(crate) struct SineAndCosine(pub(super) [Vec<f64>; 2]);

impl SineAndCosine {
    pub(crate) fn of(motor: &[f64]) -> Self {
        Self([motor.iter().map(|x| x.sin()).collect(), motor.iter().map(|x| x.cos()).collect()])
    }
}

/// A row of [`MotorColumns`], scaled by the noise that it carries.
#[derive(Clone, Copy)]
pub(crate) struct MotorEquation<'a> {
    pub(crate) campaign: &'a Campaign,
    pub(crate) run: &'a Run,
    pub(crate) columns: &'a MotorColumns,
    /// Of this run, where [`MotorColumns::gravity`] says so.
    pub(crate) gravity: Option<&'a SineAndCosine>,
    pub(crate) window: &'a Window,
    /// A mode that no tip shows.
    pub(crate) mode: ModeTerms<'a>,
}

/// What the equation has of a mode that no tip shows.
#[derive(Debug, Clone, Copy)]
pub(crate) enum ModeTerms<'a> {
    /// Nothing.
    None,
    /// Columns of their own, as [`MotorColumns::mode`] says.
    Sought(&'a Derivatives),
    /// The weights of a known one.
    Known(&'a ModeWindow),
}

impl<'a> ModeTerms<'a> {
    pub(crate) fn of(known: Option<&'a ModeWindow>, sought: Option<&'a Derivatives>) -> Self {
        let sought = || sought.map_or(Self::None, Self::Sought);
        known.map_or_else(sought, Self::Known)
    }
}

impl Rows for MotorEquation<'_> {
    #[inline(always)]
    fn fill(&self, k: usize, row: &mut Vec<f64>) {
        let Self { campaign, run, window, .. } = *self;
        let (t, motor, command) = (run.sample_time_s(), &run.motor()[k..], &run.command()[k..]);
        row.clear();
        // From the window's first: ẇ and ẅ integrate constants to zero only up to rounding.
        let [inertia, viscous] = self.of_angle();
        row.push(inertia.dot_from(motor, motor[0]) * t);
        row.push(-viscous.dot_from(motor, motor[0]) * t);
        row.push(window.area);
        for &i in &self.columns.tips {
            row.push(behind(campaign, run, i, window, k));
        }
        if let Some(SineAndCosine(waves)) = self.gravity {
            row.extend(waves.iter().map(|wave| window.value.dot(&wave[k..]) * t));
        }
        if let ModeTerms::Sought(mode) = self.mode {
            row.push(mode.fourth.dot_from(motor, motor[0]) * t);
            row.push(self.torque_by(&window.second, &mode.held, command));
            row.push(self.torque_by(&window.first, &window.rise, command));
            row.push(-mode.third.dot_from(motor, motor[0]) * t);
        }
        row.push(self.torque(command));
        for value in row {
            *value *= window.row_scale;
        }
    }
}

/// A column beside those of the equation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Further {
    /// `∫ẇτ`, which has the noise of the command.
    LaterTorque,
    /// One that the sensors' noise hardly changes.
    WithoutNoise,
}

impl MotorEquation<'_> {
    /// What noise adds to a row's products, in expectation, with a `further` column before the right side.
    pub(crate) fn noise(&self, of_run: &RunNoise, further: Option<Further>) -> DMatrix<f64> {
        let window = self.window;
        let [inertia, viscous] = self.of_angle();
        let mut of_motor: Vec<ChannelPart<'_>> =
            vec![(INERTIA, inertia, 1.0), (VISCOUS, viscous, -1.0)];
        let tips = &self.columns.tips;
        let mut channels = Vec::with_capacity(2 + tips.len());
        for (place, &i) in tips.iter().enumerate() {
            let column = MotorColumns::tip(place);
            if self.campaign.channels.tips[i].quantity != TipQuantity::Deflection {
                of_motor.push((column, &window.value, 1.0));
            }
            let of_tip: Vec<ChannelPart<'_>> = vec![(column, &window.value, -1.0)];
            channels.push((of_run.tips[i], of_tip));
        }
        let count = self.columns.count() + usize::from(further.is_some()) + 1;
        let command = &self.campaign.channels.command;
        let mut of_command: Vec<ChannelPart<'_>> = vec![(count - 1, self.of_torque().0, 1.0)];
        if further == Some(Further::LaterTorque) {
            of_command.push((self.columns.count(), &window.first, 1.0));
        }
        if let (Some(place), ModeTerms::Sought(weights)) = (self.columns.of_mode(), self.mode) {
            of_motor.push((place.fourth, &weights.fourth, 1.0));
            of_motor.push((place.third, &weights.third, -1.0));
            of_command.push((place.torque_twice, &window.second, 1.0));
            of_command.push((place.torque_once, &window.first, 1.0));
        }
        if command.hold == Hold::Measured {
            channels.push((of_run.command * command.torque_per_unit(), of_command));
        }
        channels.push((of_run.motor, of_motor));
        let noise = products(count, channels);
        noise * (self.run.sample_time_s() * window.row_scale).powi(2)
    }

    /// The right side of the row of the window that begins at sample `k`.
    #[inline(always)]
    pub(crate) fn right(&self, k: usize) -> f64 {
        self.torque(&self.run.command()[k..]) * self.window.row_scale
    }

    /// `∫wτ` of what is commanded from the window's first sample on.
    #[inline(always)]
    fn torque(&self, command: &[f64]) -> f64 {
        let (at, held) = self.of_torque();
        self.torque_by(at, held, command)
    }

    /// Weights of the angle, for inertia and viscous friction.
    #[inline(always)]
    fn of_angle(&self) -> [&Weights; 2] {
        match self.mode {
            ModeTerms::Known(mode) => [&mode.inertia, &mode.viscous],
            _ => [&self.window.second, &self.window.first],
        }
    }

    /// Weights of a torque, at samples and held over their intervals.
    #[inline(always)]
    pub(crate) fn of_torque(&self) -> (&Weights, &Weights) {
        match self.mode {
            ModeTerms::Known(mode) => (&mode.torque, &mode.held),
            _ => (&self.window.value, &self.window.held),
        }
    }

    /// The integral of a torque by weights `at` samples, and those over its intervals for a `held` command.
    #[inline(always)]
    fn torque_by(&self, at: &Weights, held: &Weights, command: &[f64]) -> f64 {
        self.campaign.channels.command.torque_per_unit()
            * match self.campaign.channels.command.hold {
                Hold::Sampled => held.dot(command),
                Hold::Measured => at.dot(command) * self.run.sample_time_s(),
            }
    }

    /// `∫ẇτ`: what a torque that acts later leaves, by its delay. Of a servo the goal alone acts later: `∫ẇ·gain·goal`.
    #[inline(always)]
    pub(crate) fn later(&self, k: usize) -> f64 {
        let late = self.torque_by(&self.window.first, &self.window.rise, &self.run.command()[k..]);
        let command = &self.campaign.channels.command;
        if command.quantity != CommandQuantity::PositionError {
            return late;
        }
        let motor = &self.run.motor()[k..];
        let angle = self.window.first.dot_from(motor, motor[0]) * self.run.sample_time_s();
        late + command.torque_per_unit() * angle
    }
}

impl MotorEquation<'_> {
    /// `∫w(θ̇_m − θ̇_i)` of the coupled tip of number `place`: what damping within the beam adds.
    #[inline(always)]
    pub(crate) fn behind_rate(&self, place: usize, k: usize) -> f64 {
        let (first, i) = (&self.window.first, self.columns.tips[place]);
        let (motor, tip) = (&self.run.motor()[k..], &self.run.tips()[i][k..]);
        self.run.sample_time_s()
            * match self.campaign.channels.tips[i].quantity {
                TipQuantity::Deflection => first.dot_from(tip, tip[0]),
                _ => -first.dot_difference(motor, tip),
            }
    }
}

/// `∫w(θ_m − θ_i)`.
#[inline(always)]
pub(super) fn behind(campaign: &Campaign, run: &Run, i: usize, window: &Window, k: usize) -> f64 {
    let (motor, tip) = (&run.motor()[k..], &run.tips()[i][k..]);
    run.sample_time_s()
        * match campaign.channels.tips[i].quantity {
            TipQuantity::Deflection => -window.value.dot(tip),
            _ => window.value.dot_difference(motor, tip),
        }
}

/// `∫ẇτ` before the right side.
struct WithDelay<'a>(MotorEquation<'a>);

impl Rows for WithDelay<'_> {
    #[inline(always)]
    fn fill(&self, k: usize, row: &mut Vec<f64>) {
        self.0.fill(k, row);
        row.insert(row.len() - 1, self.0.later(k) * self.0.window.row_scale);
    }
}
