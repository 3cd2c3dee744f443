//! Prediction of an identified arm with another payload.

use crate::identify::estimate::{Estimate, ModeEstimate};
use crate::identify::findings::{Finding, rows};
use crate::identify::output_error::OutputError;
use crate::identify::responses::correct::Response;
use crate::replay::ModalArm;

/// Prediction of an arm with another load at one of its tips, from runs with the original load.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadedArm {
    /// Inertia about the axis that was added at the point of the tip \[kg·m²\].
    pub added_kg_m2: f64,
    /// Modes with the motor clamped, ascending in frequency.
    pub modes: Vec<ModeEstimate>,
    /// Model of the arm with the new load.
    pub arm: ModalArm,
}

impl LoadedArm {
    /// The finding that says which errors the intervals do not include.
    pub fn caveat(&self) -> Finding {
        Finding::new(rows::PayloadHighestMode { modes: self.modes.len() })
    }
}

impl OutputError {
    /// Predicts the arm with an additional mass Δm at the point of tip `tip`, at the distance r from the axis:
    /// `added_kg_m2` is Δm·r². Standard errors come from the covariance of the arm's parameters.
    ///
    /// The coupling of each mode, and the share of the tip in it, determine how the mode moves under a force at the
    /// tip. This is equivalent to the invariance of zeros, and exact if the arm has no modes beyond those identified.
    /// Modes that the runs do not show are missing: their contribution to the compliance of the tip is missing, too, if
    /// a heavy load bends them.
    ///
    /// `None` if [`ModalArm::with_load`] gives `None`.
    ///
    /// # Source
    /// `[Feliu1989, Section 3, property 4]`
    pub fn with_load(&self, tip: usize, added_kg_m2: f64) -> Option<LoadedArm> {
        let arm = self.arm.with_load(tip, added_kg_m2)?;
        // One that a standard error beside cannot be loaded so has no standard error.
        let of = |k: usize, estimate: fn((f64, f64)) -> f64| -> Estimate {
            self.estimate_of(|arm| {
                let mode =
                    arm.with_load(tip, added_kg_m2).and_then(|a| a.clamped_modes().get(k).copied());
                mode.map_or(f64::NAN, estimate)
            })
        };
        let mode = |k: usize| ModeEstimate {
            natural_frequency_rad_s: of(k, |mode| mode.0),
            damping_ratio: of(k, |mode| mode.1),
        };
        let modes: Vec<ModeEstimate> = (0..arm.modes.len()).map(mode).collect();
        let known = |e: Estimate| e.value.is_finite() && e.std.is_finite();
        let all = modes.iter().all(|m| known(m.natural_frequency_rad_s) && known(m.damping_ratio));
        all.then_some(LoadedArm { added_kg_m2, modes, arm })
    }

    /// Predicts θ_i/θ_m of tip `seen` at given frequencies \[rad/s\] with that load at tip `tip`.
    ///
    /// `None` if [`with_load`](Self::with_load) gives `None`, or if there is no such tip.
    pub fn loaded_tip_response(
        &self,
        (tip, added_kg_m2): (usize, f64),
        seen: usize,
        omega_rad_s: &[f64],
    ) -> Option<Vec<Response>> {
        self.arm.shapes.get(seen)?;
        let at = |arm: &ModalArm| {
            let loaded = arm.with_load(tip, added_kg_m2)?;
            Some(omega_rad_s.iter().map(|w| loaded.tip_response(seen, *w)).collect())
        };
        let variances = self.variances(&at)?;
        let values = at(&self.arm)?;
        let response = |(value, variance): (_, &f64)| Response { value, std: variance.sqrt() };
        Some(values.into_iter().zip(&variances).map(response).collect())
    }
}
