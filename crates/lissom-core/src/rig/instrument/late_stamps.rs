//! Time stamps that are late.

use rand_distr::{Distribution, StandardUniform};
use rand_xoshiro::Xoshiro256PlusPlus;

use crate::rig::RigError;
use crate::rig::error::positive;

/// Time stamps of a log that are late by a random time: independent from row to row, and uniform between zero and
/// [`most_s`](Self::most_s). The samples themselves are taken evenly.
///
/// A program causes such stamps if it reads a device at an even rate and reads the time afterwards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LateStamps {
    most_s: f64,
}

impl LateStamps {
    /// Builds stamps that are late by at most `most_s` \[s\].
    ///
    /// # Errors
    /// [`RigError::NotPositive`] if it is not positive and finite.
    pub fn new(most_s: f64) -> Result<Self, RigError> {
        Ok(Self { most_s: positive("largest lateness of a time stamp in s", most_s)? })
    }

    /// Largest lateness \[s\].
    pub fn most_s(&self) -> f64 {
        self.most_s
    }

    /// Refuses stamps that could pass the next row's.
    pub(super) fn check(self, log_time_s: f64) -> Result<(), RigError> {
        if self.most_s < log_time_s {
            Ok(())
        } else {
            Err(RigError::LateStamps { most_s: self.most_s, log_time_s })
        }
    }

    /// How late the next stamp is \[s\].
    pub(in crate::rig) fn draw_s(self, stream: &mut Xoshiro256PlusPlus) -> f64 {
        let share: f64 = StandardUniform.sample(stream);
        share * self.most_s
    }
}
