//! The sampled control loop of Sections 5.1 and 6.1: an arm, its instruments and a controller.

use rand_xoshiro::Xoshiro256PlusPlus;

use super::controller::{Controller, Sensed};
use super::error::positive;
use super::experiment::{Drive, Experiment, Reference, Settle};
use super::instrument::{CurrentTrace, DelayLine, Streams};
use super::logged::{Logged, RowTruth};
use super::logging::Log;
use super::settled::Settled;
use super::settling::Settling;
use super::virtual_rig::Rig;
use super::wander::WanderPath;
use super::{HeldArm, Motion, RigError};

/// Angle beyond which a loop is taken for unstable, as a multiple of the largest of: the
/// reference's amplitude, [`LEAST_RAD`], [`STEPS`] steps of the motor's sensor, the start's
/// deflection.
pub(super) const RUN_AWAY: f64 = 5.0;
/// Loops asked for less than this are let move by as much \[rad\].
pub(super) const LEAST_RAD: f64 = 0.1;
/// A loop hunts over some steps of its sensor without being unstable.
const STEPS: f64 = 10.0;

/// Parts of a sample below this are rounding of times.
const WHOLE: f64 = 1e-9;

/// Most samples of a run, waiting and record each.
const SAMPLES_MOST: f64 = 1e8;

/// Most numbers of a log: 1.6 GB.
const NUMBERS_MOST: f64 = 2e8;

/// Streams of random numbers in addition to those of the angles' sensors.
const EXTRA_STREAMS: usize = 3;

/// Fewest rows of a log.
const ROWS_LEAST: f64 = 8.0;

impl Rig {
    /// Runs an experiment with the rig's own controller.
    ///
    /// The same seed gives the same log to the last bit. Without noise the seed has no effect.
    ///
    /// ```
    /// # use lissom::{arm::Arm, beam::{LumpedBeam, Span}, drive::{Coulomb, Motor}};
    /// # use lissom::rig::{Amplifier, Experiment, Instruments, Pd, Rig};
    /// # let span = Span { length_m: 0.2, flexural_rigidity_n_m2: 0.004, mass_kg: 0.05, damping_n_s_per_m: 0.01 };
    /// # let beam = LumpedBeam::new(&[span]).unwrap();
    /// # let arm = Arm::new(beam, Motor::new(6e-4, 1e-3, 0.25).unwrap(), Coulomb::symmetric(0.03).unwrap()).unwrap();
    /// # let instruments = Instruments::ideal(0.003)?;
    /// let rig = Rig::new(arm, instruments, Pd::new(8.0, 0.2)?.into());
    /// let logged = rig.run("slow", &Experiment::sine(2.0, 0.5, 6.0)?, 1)?; // rad/s, rad, s
    /// assert_eq!((logged.run.len(), logged.run.tips().len()), (2000, 1));
    /// assert!(logged.settled.left_rad.unwrap() < 0.5 * 1e-4 && logged.findings.is_empty());
    /// # Ok::<(), lissom::rig::RigError>(())
    /// ```
    ///
    /// # Source
    /// `[Feliu1989, Sections 5.1 and 6.1]`
    ///
    /// # Errors
    /// Those of [`run_with`](Self::run_with).
    pub fn run(&self, name: &str, experiment: &Experiment, seed: u64) -> Result<Logged, RigError> {
        self.run_with(&mut self.controller.clone(), name, experiment, seed)
    }

    /// Runs an experiment with a controller of your own, in place of the rig's.
    ///
    /// # Errors
    /// [`RigError`] if times are not positive, sensors do not fit the beam, the reference is above the Nyquist
    /// frequency, or the run is too long; [`RigError::Controller`] if the controller returns NaN or infinity;
    /// [`RigError::Unstable`] if the motor leaves five times the amplitude of the reference (at least 0.1 rad or 10
    /// steps of its sensor).
    pub fn run_with<C: Controller + ?Sized>(
        &self,
        controller: &mut C,
        name: &str,
        experiment: &Experiment,
        seed: u64,
    ) -> Result<Logged, RigError> {
        self.run_watched(controller, name, experiment, seed, &mut |_| {})
    }

    /// Runs an experiment with a controller of your own, and calls `watch` with the true values at each row of the log.
    ///
    /// # Errors
    /// Those of [`run_with`](Self::run_with).
    pub fn run_watched<C: Controller + ?Sized>(
        &self,
        controller: &mut C,
        name: &str,
        experiment: &Experiment,
        seed: u64,
        watch: &mut dyn FnMut(RowTruth<'_>),
    ) -> Result<Logged, RigError> {
        self.check()?;
        experiment.check()?;
        let line = DelayLine::new(self.instruments.delay, self.instruments.sample_time_s)?;
        let held = self.scene.held(&self.arm, &line.durations_s())?;
        let mut bench = Bench::new(self, held.as_ref(), line, controller, experiment, seed)?;
        let settled = bench.settle()?;
        bench.record(name, settled, watch)
    }
}

/// A run on its way.
struct Bench<'r, C: ?Sized> {
    rig: &'r Rig,
    experiment: &'r Experiment,
    controller: &'r mut C,
    motion: Box<dyn Motion + 'r>,
    line: DelayLine,
    /// Streams of random numbers: motor, masses, current, time stamps, friction.
    streams: Streams,
    wander: Option<WanderPath>,
    /// What multiplies the friction now.
    friction_factor: f64,
    trace: Option<CurrentTrace>,
    /// Samples passed since the start.
    passed: usize,
    bound_rad: f64,
    /// Largest angle at the start \[rad\].
    deflection_rad: f64,
    command_a: f64,
    limited: bool,
    /// Readings of this instant and whether each was cut off, motor first.
    read_rad: Vec<f64>,
    cut_off: Vec<bool>,
    /// Lowest and highest motor angle since they were last taken.
    range_rad: (f64, f64),
    /// State at the instant looked at.
    seen: Vec<f64>,
}

impl<'r, C: Controller + ?Sized> Bench<'r, C> {
    fn new(
        rig: &'r Rig,
        held: Option<&'r HeldArm<'r>>,
        line: DelayLine,
        controller: &'r mut C,
        experiment: &'r Experiment,
        seed: u64,
    ) -> Result<Self, RigError> {
        let masses = rig.arm.beam().len();
        let instruments = &rig.instruments;
        let reference = experiment.drive.reference();
        let nyquist_rad_s = std::f64::consts::PI / instruments.control_time_s();
        if let Some(omega_rad_s) = reference.highest_rad_s().filter(|w| *w >= nyquist_rad_s) {
            return Err(RigError::AboveNyquist { omega_rad_s, nyquist_rad_s });
        }
        let state = experiment.start.state(&rig.arm)?;
        if rig.scene.tip.walls.iter().any(|wall| wall.depth(state[1 + masses]) > 0.0) {
            return Err(RigError::Unsupported { what: "a start with the tip beyond a wall" });
        }
        let deflection = state[2..].iter().fold(0.0_f64, |m, q| m.max(q.abs()));
        let bound_rad = match experiment.drive {
            Drive::Angle(_) => {
                let asked = reference.amplitude(experiment.record_s).max(LEAST_RAD);
                // A load that the loop does not hold hangs half a turn away at most; cogging, half a wave.
                let torque = rig.scene.position_torque();
                let half_waves =
                    torque.waves().iter().map(|w| std::f64::consts::PI / w.per_rad.abs());
                let hangs = half_waves.filter(|angle| angle.is_finite()).fold(0.0, f64::max);
                let asked = asked.max(STEPS * instruments.motor.resolution()).max(deflection);
                RUN_AWAY * asked + hangs
            }
            // The drive alone may turn as far as its current takes it.
            Drive::Current(_) => f64::MAX,
        };
        controller.reset();
        Ok(Self {
            rig,
            experiment,
            controller,
            seen: state.clone(),
            motion: rig.scene.motion(&rig.arm, held, state)?,
            line,
            streams: Streams::new(seed, 1 + masses + EXTRA_STREAMS),
            wander: rig.scene.wander.map(|wander| wander.path(instruments.sample_time_s)),
            friction_factor: 1.0,
            trace: instruments.current.map(|_| CurrentTrace::new(instruments.log_every)),
            passed: 0,
            bound_rad,
            deflection_rad: deflection,
            command_a: 0.0,
            limited: false,
            read_rad: vec![0.0; 1 + masses],
            cut_off: vec![false; 1 + masses],
            range_rad: (f64::INFINITY, f64::NEG_INFINITY),
        })
    }

    fn reference(&self) -> &'r Reference {
        self.experiment.drive.reference()
    }

    /// The stream behind those of the angles' sensors: 0 of the current, 1 of time stamps, 2 of friction.
    fn extra_stream(&mut self, place: usize) -> Option<&mut Xoshiro256PlusPlus> {
        self.streams.at(self.read_rad.len() + place)
    }

    /// The friction of the sample that begins now.
    fn wander(&mut self) -> Result<(), RigError> {
        let place = self.read_rad.len() + 2;
        if let (Some(wander), Some(stream)) = (&mut self.wander, self.streams.at(place)) {
            self.friction_factor = wander.next(stream);
            self.motion.scale_friction(self.friction_factor)?;
        }
        Ok(())
    }

    /// One instant: sensors, then the controller where it is its turn.
    fn sense(&mut self, clock_s: f64, reference: f64) -> Result<(), RigError> {
        self.wander()?;
        let instruments = &self.rig.instruments;
        let state = self.motion.state();
        let angle = state[0];
        if angle.abs() > self.bound_rad || angle.is_nan() {
            // What the last reading was: a loop whose sensor is at its end knows no better.
            if let (true, Some(quantiser)) = (self.cut_off[0], instruments.motor.quantiser) {
                let time_s = self.passed as f64 * instruments.sample_time_s;
                let range_rad = quantiser.ends();
                return Err(RigError::BeyondSensor { angle_rad: angle, range_rad, time_s });
            }
            return Err(RigError::Unstable {
                angle_rad: angle,
                bound_rad: self.bound_rad,
                time_s: self.passed as f64 * instruments.sample_time_s,
                state: state.to_vec(),
            });
        }
        self.range_rad = (self.range_rad.0.min(angle), self.range_rad.1.max(angle));
        (self.read_rad[0], self.cut_off[0]) = instruments.motor.read(angle, self.streams.at(0));
        for mass in 0..self.read_rad.len() - 1 {
            let stream = self.streams.at(1 + mass);
            (self.read_rad[1 + mass], self.cut_off[1 + mass]) =
                instruments.tip(mass).read(state[2 + mass], stream);
        }
        if !self.passed.is_multiple_of(instruments.control_every) {
            return Ok(());
        }
        let demand = match self.experiment.drive {
            Drive::Current(_) => reference,
            Drive::Angle(_) => self.controller.current_a(&Sensed {
                time_s: clock_s,
                period_s: instruments.control_time_s(),
                reference_rad: reference,
                motor_rad: self.read_rad[0],
                tips_rad: &self.read_rad[1..],
                limit_a: instruments.amplifier.most_a(),
            }),
        };
        if !demand.is_finite() {
            return Err(RigError::Controller { found: demand, time_s: clock_s });
        }
        self.limited = instruments.amplifier.limits(demand);
        self.command_a = instruments.amplifier.command_a(demand);
        Ok(())
    }

    /// Moves on to the next instant; notes the state `look_s` after this one where that is asked
    /// for.
    fn move_on(&mut self, look_s: Option<f64>) -> Result<(), RigError> {
        let constant = self.rig.arm.motor.torque_constant_nm_per_a();
        let (mut from, mut noted, mut charge) = (0.0, look_s.is_none(), 0.0);
        for (command, duration) in self.line.push(self.command_a) {
            let current = self.rig.instruments.amplifier.current_a(command);
            charge += current * duration;
            let torque = constant * current - self.rig.scene.load_nm;
            let look = look_s.map(|at| at - from).filter(|at| (0.0..duration).contains(at));
            let mut rest = duration;
            if let Some(first) = look {
                if first > 0.0 {
                    self.motion.advance(torque, first)?;
                }
                note(&mut self.seen, self.motion.state(), self.rig.arm.beam().len());
                noted = true;
                rest -= first;
            }
            if rest > 0.0 {
                self.motion.advance(torque, rest)?;
            }
            from += duration;
        }
        if !noted {
            // Rounding of both parts of a sample put it behind them.
            note(&mut self.seen, self.motion.state(), self.rig.arm.beam().len());
        }
        if let Some(trace) = &mut self.trace {
            trace.push(charge / from);
        }
        self.passed += 1;
        Ok(())
    }

    /// Lets the transient go.
    fn settle(&mut self) -> Result<Settled, RigError> {
        let sample = self.rig.instruments.sample_time_s;
        let periodic = self.reference().period_s().is_some();
        let open = matches!(self.experiment.drive, Drive::Current(_));
        let at_once = Settled { waited_s: 0.0, left_rad: None, tolerance_rad: None };
        match self.experiment.settle {
            Settle::AtOnce => Ok(at_once),
            Settle::Wait { wait_s } => {
                let samples = counted("wait_s", wait_s / sample)?;
                self.wait(samples, periodic)?;
                Ok(Settled { waited_s: samples as f64 * sample, ..at_once })
            }
            Settle::Detected { tolerance, longest_s } => {
                let still = self.reference().value(0.0) == 0.0
                    && self.seen.iter().all(|x| *x == 0.0)
                    && self.rig.scene.rests_at_zero(&self.rig.arm);
                // An open drive that is pushed one way never settles.
                if !periodic && (still || open) {
                    return Ok(at_once);
                }
                let most = counted("longest_s", longest_s / sample)?;
                self.detect(tolerance, most)
            }
        }
    }

    /// The clock of the reference `passed` samples after the start, and the reference; one that is
    /// not periodic waits at its first value.
    fn before(&self, periodic: bool) -> (f64, f64) {
        let time = self.passed as f64 * self.rig.instruments.sample_time_s;
        (time, self.reference().value(if periodic { time } else { 0.0 }))
    }

    fn wait(&mut self, samples: usize, periodic: bool) -> Result<(), RigError> {
        for _ in 0..samples {
            let (time, reference) = self.before(periodic);
            self.sense(time, reference)?;
            self.move_on(None)?;
        }
        Ok(())
    }

    fn detect(&mut self, tolerance: f64, most: usize) -> Result<Settled, RigError> {
        let (rig, reference) = (self.rig, self.reference());
        let sample = rig.instruments.sample_time_s;
        let lowest = std::f64::consts::TAU / Settling::lowest_rad_s(&rig.arm);
        let period = reference.period_s();
        let lag = period.unwrap_or(lowest).max(sample);
        let open = matches!(self.experiment.drive, Drive::Current(_));
        let mut settling =
            Settling::new(&rig.arm, &rig.scene.later, self.controller.memory_s(), lag, open);
        let mut left = f64::INFINITY;
        let (mut allowed, mut looks) = (0.0, 0_usize);
        while self.passed < most {
            let (time, value) = self.before(period.is_some());
            self.sense(time, value)?;
            // Within rounding of an instant it is that instant: no sample is split for it.
            let look = looks as f64 * lag - time;
            let look = if look < WHOLE * sample { 0.0 } else { look };
            let due = look < sample;
            self.move_on(due.then_some(look))?;
            if !due {
                continue;
            }
            looks += 1;
            left = settling.look(&self.seen);
            // An open drive is judged by what it moves.
            let amplitude = if open {
                0.5 * (self.range_rad.1 - self.range_rad.0)
            } else {
                reference.amplitude(self.experiment.record_s).max(self.deflection_rad)
            };
            self.range_rad = (f64::INFINITY, f64::NEG_INFINITY);
            allowed = (tolerance * amplitude).max(rig.instruments.resolution_rad());
            if looks > 1 && left <= allowed {
                break;
            }
        }
        let waited_s = self.passed as f64 * sample;
        Ok(Settled { waited_s, left_rad: Some(left), tolerance_rad: Some(allowed) })
    }

    /// Logs the record.
    fn record(
        mut self,
        name: &str,
        mut settled: Settled,
        watch: &mut dyn FnMut(RowTruth<'_>),
    ) -> Result<Logged, RigError> {
        let instruments = &self.rig.instruments;
        let (sample, every) = (instruments.sample_time_s, instruments.log_every);
        let periodic = self.reference().period_s().is_some();
        // The controller acts in the log's first row.
        let late = (instruments.control_every - self.passed % instruments.control_every)
            % instruments.control_every;
        self.wait(late, periodic)?;
        settled.waited_s = if self.passed == 0 { 0.0 } else { self.passed as f64 * sample };
        let rows = (self.experiment.record_s / instruments.log_time_s()).round().max(ROWS_LEAST);
        let rows = counted("record_s", rows * every as f64)? / every;
        let numbers = (rows * (2 + self.read_rad.len() - 1)) as f64;
        if numbers > NUMBERS_MOST {
            let quantity = "the log of record_s, all channels together,";
            return Err(RigError::TooLong { quantity, samples: numbers, most: NUMBERS_MOST });
        }
        let first = self.passed;
        let clock = |passed: usize| {
            let since = if periodic { passed } else { passed - first };
            since as f64 * sample
        };
        let stuck_before = self.motion.stuck_s();
        let start = self.motion.state().to_vec();
        self.range_rad = (f64::INFINITY, f64::NEG_INFINITY);
        let mut log = Log::new(rows, self.read_rad.len());
        if let Some(trace) = &mut self.trace {
            trace.record();
        }
        for k in 0..rows * every {
            let time = clock(self.passed);
            let reference = self.reference().value(time);
            self.sense(time, reference)?;
            log.note(reference, self.command_a, self.limited, &self.cut_off);
            if k.is_multiple_of(every) {
                log.row(self.command_a, &self.read_rad);
                let (state, friction_factor) = (self.motion.state(), self.friction_factor);
                watch(RowTruth { state, friction_factor });
            }
            self.move_on(None)?;
        }
        let recorded_s = (rows * every) as f64 * sample;
        let stuck_share = (self.motion.stuck_s() - stuck_before) / recorded_s;
        let findings = log.findings(
            (&self.rig.instruments, &self.rig.arm, &self.rig.scene),
            self.experiment,
            settled,
            self.range_rad,
        );
        if let Some(measured) = self.measured_a(rows) {
            log.measured(measured);
        }
        let stamps_s = self.stamps_s(rows, clock(first));
        let run = log.run(name, clock(first), instruments.log_time_s())?;
        let run = match self.reference() {
            Reference::Sine(sine) => run.with_omega(sine.omega_rad_s())?,
            _ => run,
        };
        Ok(Logged { run, stamps_s, settled, start, stuck_share, findings })
    }

    /// What the sensor of the current reads at each row \[A\].
    fn measured_a(&mut self, rows: usize) -> Option<Vec<f64>> {
        let (chain, trace) = (self.rig.instruments.current?, self.trace.take()?);
        let read = |row| {
            let current = trace.row_a(row, chain.reading);
            chain.sensor.read(current, self.extra_stream(0)).0
        };
        Some((0..rows).map(read).collect())
    }

    /// Time stamps that are late \[s\].
    fn stamps_s(&mut self, rows: usize, start_s: f64) -> Option<Vec<f64>> {
        let stamps = self.rig.instruments.stamps?;
        let step_s = self.rig.instruments.log_time_s();
        let stream = self.extra_stream(1)?;
        let stamp = |row| start_s + row as f64 * step_s + stamps.draw_s(stream);
        Some((0..rows).map(stamp).collect())
    }
}

/// Notes a state in the layout that `seen` has: another payload may have a coordinate more, or less.
fn note(seen: &mut [f64], state: &[f64], masses: usize) {
    if seen.len() == state.len() {
        seen.copy_from_slice(state);
        return;
    }
    let (mine, theirs) = ((seen.len() - 2) / 2, (state.len() - 2) / 2);
    seen.fill(0.0);
    seen[..2 + masses].copy_from_slice(&state[..2 + masses]);
    seen[2 + mine..2 + mine + masses].copy_from_slice(&state[2 + theirs..2 + theirs + masses]);
}

/// A number of samples that can be simulated.
fn counted(quantity: &'static str, samples: f64) -> Result<usize, RigError> {
    if samples <= SAMPLES_MOST {
        Ok(samples.round() as usize)
    } else {
        positive(quantity, samples)?;
        Err(RigError::TooLong { quantity, samples, most: SAMPLES_MOST })
    }
}
