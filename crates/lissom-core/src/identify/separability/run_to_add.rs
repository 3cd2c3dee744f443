//! The further run that would say most about what the logs tell least.

use crate::identify::output_error::OutputError;
use crate::identify::separability::direction::Direction;
use crate::identify::separability::judged::Judged;
use crate::identify::separability::thresholds::{RUN_AS_GOOD, RUN_WORTH};
use crate::information::ArmParameter;
use crate::plan::{Addition, Bounds, PlannedMotion, additions};
use crate::record::Campaign;

/// A run worth adding.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RunToAdd {
    /// What the motor is asked to do.
    pub motion: PlannedMotion,
    /// Amplitude of the reference \[rad\].
    pub amplitude_rad: f64,
    /// Time to log \[s\].
    pub record_s: f64,
    /// The parameter that it is for: the one that moves most along the direction least known.
    pub parameter: ArmParameter,
    /// Standard error of that now, in shares of its [size](ArmParameter::size)…
    pub std_now: f64,
    /// …and with the run.
    pub std_then: f64,
}

impl RunToAdd {
    /// Of the motions that a plan would try, within what the logs went to.
    pub(super) fn of(
        oe: &OutputError,
        used: &Campaign,
        judged: &Judged,
        worst: &Direction,
    ) -> Option<Self> {
        let parameter = worst.parts.first()?.parameter;
        let at = judged.parameters.iter().position(|f| *f == parameter)?;
        let bounds = Bounds::of(used)?;
        let tried = additions(&oe.arm, &oe.parameters, &used.channels, &oe.noise, &bounds);
        let column = judged.slopes.columns(at, 1).into_owned();
        let white = |addition: Option<&Addition>| {
            let more = addition.map(|a| &a.information);
            oe.by_run.covariance(&column, None, more)[(0, 0)].sqrt()
        };
        let now = white(None);
        let share = tried.iter().map(|addition| white(Some(addition)) / now);
        let all: Vec<(f64, &Addition)> = share.zip(&tried).filter(|(s, _)| s.is_finite()).collect();
        let best = all.iter().map(|(share, _)| *share).reduce(f64::min)?;
        let as_good = all.iter().filter(|(share, _)| *share <= RUN_AS_GOOD * best);
        let order = |a: &&(f64, &Addition), b: &&(f64, &Addition)| {
            (a.1.record_s, a.0)
                .partial_cmp(&(b.1.record_s, b.0))
                .unwrap_or(std::cmp::Ordering::Equal)
        };
        let (share, chosen) = *as_good.min_by(order)?;
        let std_now = judged.covariance[(at, at)].sqrt();
        (share <= RUN_WORTH).then_some(Self {
            motion: chosen.motion,
            amplitude_rad: chosen.amplitude_rad,
            record_s: chosen.record_s,
            parameter,
            std_now,
            std_then: share * std_now,
        })
    }
}
