//! The log of a run while it is recorded, and statistics of the run.

use super::experiment::{Drive, Experiment};
use super::finding::{RigFinding, SensorPlace};
use super::instrument::Instruments;
use super::scene::Scene;
use super::settled::Settled;
use crate::arm::Arm;
use crate::record::{RecordError, Run, TimeBase};

/// A motor that moves by less in a whole record stands still \[rad\].
const STILL_RAD: f64 = 1e-9;

/// Channels and counts.
pub(super) struct Log {
    current: Vec<f64>,
    /// Motor, then tips.
    angles: Vec<Vec<f64>>,
    samples: usize,
    limited: usize,
    cut_off: Vec<usize>,
    reference: (f64, f64),
    largest_a: f64,
}

impl Log {
    pub(super) fn new(rows: usize, sensors: usize) -> Self {
        Self {
            current: Vec::with_capacity(rows),
            angles: (0..sensors).map(|_| Vec::with_capacity(rows)).collect(),
            samples: 0,
            limited: 0,
            cut_off: vec![0; sensors],
            reference: (f64::INFINITY, f64::NEG_INFINITY),
            largest_a: 0.0,
        }
    }

    /// Counts a sample, whether it is logged or not.
    pub(super) fn note(&mut self, reference: f64, command_a: f64, limited: bool, cut_off: &[bool]) {
        self.samples += 1;
        self.limited += usize::from(limited);
        for (count, cut) in self.cut_off.iter_mut().zip(cut_off) {
            *count += usize::from(*cut);
        }
        self.reference = (self.reference.0.min(reference), self.reference.1.max(reference));
        self.largest_a = self.largest_a.max(command_a.abs());
    }

    /// Logs a row.
    pub(super) fn row(&mut self, command_a: f64, read_rad: &[f64]) {
        self.current.push(command_a);
        for (channel, read) in self.angles.iter_mut().zip(read_rad) {
            channel.push(*read);
        }
    }

    /// Puts the readings of a sensor of the current in place of the commands.
    pub(super) fn measured(&mut self, current_a: Vec<f64>) {
        self.current = current_a;
    }

    /// What the counts say; `moved_rad` is the lowest and highest true angle of the motor.
    pub(super) fn findings(
        &self,
        (instruments, arm, scene): (&Instruments, &Arm, &Scene),
        experiment: &Experiment,
        settled: Settled,
        moved_rad: (f64, f64),
    ) -> Vec<RigFinding> {
        let share = |count: usize| count as f64 / self.samples as f64;
        let moved = moved_rad.1 - moved_rad.0;
        let mut findings = Vec::new();
        if let (Some(left_rad), Some(tolerance_rad)) = (settled.left_rad, settled.tolerance_rad)
            && left_rad > tolerance_rad
        {
            let waited_s = settled.waited_s;
            findings.push(RigFinding::NotSettled { left_rad, tolerance_rad, waited_s });
        }
        if self.limited > 0 {
            let asked = self.reference.1 - self.reference.0;
            let follows = matches!(experiment.drive, Drive::Angle(_)) && asked > 0.0;
            findings.push(RigFinding::CurrentLimited {
                share: share(self.limited),
                limit_a: instruments.amplifier.most_a(),
                reached: follows.then(|| moved / asked),
            });
        }
        if moved <= STILL_RAD {
            let current = instruments.amplifier.current_a(self.largest_a);
            findings.push(RigFinding::NeverMoved {
                torque_nm: arm.motor.torque_constant_nm_per_a() * current,
                coulomb_nm: scene.holds_nm(arm),
            });
        }
        for (place, count) in self.cut_off.iter().enumerate().filter(|(_, count)| **count > 0) {
            let (sensor, chain) = match place.checked_sub(1) {
                None => (SensorPlace::Motor, instruments.motor),
                Some(mass) => (SensorPlace::Tip(mass), instruments.tip(mass)),
            };
            if let Some(quantiser) = chain.quantiser {
                let range_rad = quantiser.ends();
                findings.push(RigFinding::SensorRange { sensor, share: share(*count), range_rad });
            }
        }
        let (control_every, log_every) = (instruments.control_every, instruments.log_every);
        if instruments.current.is_none() && !control_every.is_multiple_of(log_every) {
            findings.push(RigFinding::CurrentBetweenSamples { control_every, log_every });
        }
        findings
    }

    pub(super) fn run(
        mut self,
        name: &str,
        start_s: f64,
        log_time_s: f64,
    ) -> Result<Run, RecordError> {
        let tips = self.angles.split_off(1);
        let motor = self.angles.pop().unwrap_or_default();
        Run::new(name, TimeBase::uniform(start_s, log_time_s), self.current, motor, tips)
    }
}
