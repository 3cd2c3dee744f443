//! A planned run as a table of reference angles for hardware, with a smooth start and end.

use std::f64::consts::{PI, TAU};

use super::{PlannedMotion, PlannedRun};
use crate::rig::RigError;

/// Shortest time of the smooth start or end \[s\].
const EASE_S: f64 = 0.5;

/// Reference angles at every sample.
#[derive(Debug, Clone, PartialEq)]
pub struct ReferenceTable {
    /// Time \[s\], from zero.
    pub time_s: Vec<f64>,
    /// Reference \[rad\].
    pub reference_rad: Vec<f64>,
    /// 1 for samples that belong to the log, 0 before and after.
    pub log: Vec<f64>,
}

/// The reference of a run, sampled every `sample_time_s`. It begins and ends at rest, contains the wait for the
/// transient, and marks the part to be logged.
///
/// The envelope is `(1 − cos(π·t/e))/2` over a time e of one period of the lowest frequency, half a
/// second at least. A periodic motion is logged after it; a sweep is eased within its own beginning, so
/// that its lowest frequencies are there but smaller.
///
/// # Errors
/// [`RigError`] if the numbers of the run do not make a signal.
pub fn reference_table(run: &PlannedRun, sample_time_s: f64) -> Result<ReferenceTable, RigError> {
    let reference = run.motion.reference(run.amplitude_rad)?;
    let (lowest, periodic) = match run.motion {
        PlannedMotion::Sine { omega_rad_s } | PlannedMotion::Multisine { omega_rad_s, .. } => {
            (omega_rad_s, true)
        }
        PlannedMotion::Chirp { from_rad_s, .. } => (from_rad_s, false),
    };
    let period_s = TAU / lowest;
    let ease_s = period_s.max(EASE_S);
    let before_s = if periodic { ease_s + run.waited_s } else { 0.0 };
    // The log begins with a whole period.
    let first_s = (before_s / period_s).ceil() * period_s;
    let last_s = first_s + run.record_s;
    let end_s = last_s + ease_s;
    let rising = |t: f64| 0.5 * (1.0 - (PI * (t / ease_s).clamp(0.0, 1.0)).cos());
    let samples = (end_s / sample_time_s).ceil() as usize + 1;
    let mut table = ReferenceTable {
        time_s: Vec::with_capacity(samples),
        reference_rad: Vec::with_capacity(samples),
        log: Vec::with_capacity(samples),
    };
    for k in 0..samples {
        let t = k as f64 * sample_time_s;
        table.time_s.push(t);
        table.reference_rad.push(rising(t) * rising(end_s - t) * reference.value(t));
        table.log.push(f64::from(t >= first_s && t < last_s));
    }
    Ok(table)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_begins_and_ends_at_rest_and_logs_the_whole_record() {
        for motion in [
            PlannedMotion::Sine { omega_rad_s: 5.0 },
            PlannedMotion::Multisine { omega_rad_s: 2.0, to_rad_s: 20.0, phases: 1 },
            PlannedMotion::Chirp { from_rad_s: 2.0, to_rad_s: 20.0, sweep_s: 10.0 },
        ] {
            let run = PlannedRun {
                motion,
                amplitude_rad: 0.5,
                record_s: 10.0,
                waited_s: 7.0,
                peak_current_a: 1.0,
                moved_rad: 0.5,
                stuck_share: 0.0,
                paired: false,
                without: None,
            };
            let table = reference_table(&run, 0.01).unwrap_or_else(|e| panic!("{e}"));
            let r = &table.reference_rad;
            let n = r.len();
            assert!(r[0] == 0.0 && r[1].abs() < 1e-3 && r[n - 1].abs() < 1e-3, "{motion:?}");
            // No step is larger than the fastest line makes it.
            let most = r.windows(2).map(|w| (w[1] - w[0]).abs()).fold(0.0, f64::max);
            assert!(most < 1.1 * 0.5 * 20.0 * 0.01, "{motion:?}: {most}");
            assert!((table.log.iter().sum::<f64>() * 0.01 - 10.0).abs() < 0.02);
            let largest = r.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
            assert!((0.45..=0.5 + 1e-12).contains(&largest), "{motion:?}: {largest}");
        }
    }
}
