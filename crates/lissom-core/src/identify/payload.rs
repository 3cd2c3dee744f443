//! What another payload does to an arm that was identified with one.

use crate::identify::estimate::{Estimate, ModeEstimate};
use crate::identify::findings::{Finding, PayloadFinding};
use crate::identify::methods::output_error::OutputError;
use crate::identify::responses::correct::Response;
use crate::replay::ModalArm;

/// An arm with another load at one of its tips, as the runs with the load that it had predict it.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadedArm {
    /// Inertia about the axis that was put to the tip's point \[kg·m²\].
    pub added_kg_m2: f64,
    /// Modes with the motor clamped, ascending.
    pub modes: Vec<ModeEstimate>,
    /// The arm.
    pub arm: ModalArm,
}

impl LoadedArm {
    /// What its intervals do not count.
    pub fn caveat(&self) -> Finding {
        Finding::new(PayloadFinding::PayloadHighestMode { modes: self.modes.len() })
    }
}

impl OutputError {
    /// The arm with a mass Δm more at the point of tip `tip`, at the distance r from the axis: `added_kg_m2` is
    /// Δm·r². Deviations are those that the covariance of the arm's figures gives.
    ///
    /// The coupling of each mode, and the tip's share in it, say what force at the tip moves it; that is the same
    /// as the zeros' invariance, and as exact as the modes are all there are. Modes that the runs do not show
    /// are not in it: their share of the tip's compliance is missing where a heavy load would bend them.
    ///
    /// `None` where [`ModalArm::with_load`] is.
    ///
    /// # Source
    /// `[Feliu1989, Section 3, property 4]`
    pub fn with_load(&self, tip: usize, added_kg_m2: f64) -> Option<LoadedArm> {
        let arm = self.arm.with_load(tip, added_kg_m2)?;
        // One that a deviation beside cannot be loaded so has no deviation.
        let of = |k: usize, figure: fn((f64, f64)) -> f64| -> Estimate {
            self.figure(|arm| {
                let mode =
                    arm.with_load(tip, added_kg_m2).and_then(|a| a.clamped_modes().get(k).copied());
                mode.map_or(f64::NAN, figure)
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

    /// θ_i/θ_m of tip `seen` at some frequencies \[rad/s\] with that load at tip `tip`.
    ///
    /// `None` where [`with_load`](Self::with_load) is, or there is no such tip.
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
