//! The output error's arm as figures of friction, drive and beam.

use super::OutputError;
use crate::identify::{Beam, Estimate, Friction, ModeEstimate};
use crate::record::{Channels, TipQuantity};
use crate::replay::{ModalArm, Parameter};

/// Residual beside the sensors' noise beyond which something else is in it.
const BEYOND: f64 = 3.0;

impl OutputError {
    /// Friction, the damping of the command's back-EMF taken out.
    pub fn friction(&self, back_emf_viscous: f64) -> Friction {
        let viscous = |direction: usize| {
            self.figure(|arm| arm.viscous_nm_s_per_rad[direction] - back_emf_viscous)
        };
        let mean = |arm: &ModalArm| Parameter::Viscous.of(arm) - back_emf_viscous;
        let split = self.parameters.contains(&Parameter::ViscousDifference);
        Friction {
            coulomb: self.estimate(Parameter::Coulomb),
            forward: Some(self.figure(|arm| arm.coulomb_nm + arm.offset_nm)),
            backward: Some(self.figure(|arm| arm.coulomb_nm - arm.offset_nm)),
            offset: self.estimate(Parameter::Offset),
            viscous: Some(self.figure(mean)),
            viscous_by_direction: split.then(|| (viscous(0), viscous(1))),
        }
    }

    /// Inertia J.
    pub fn inertia(&self) -> Option<Estimate> {
        self.estimate(Parameter::Inertia)
    }

    /// Modes and coupling.
    pub fn beam(&self, channels: &Channels) -> Beam {
        let modes = (0..self.arm.modes.len()).map(|j| ModeEstimate {
            natural_frequency_rad_s: self.figure(|arm| arm.modes[j].omega_rad_s),
            damping_ratio: self.figure(|arm| arm.damping_ratios()[j]),
        });
        let mut modes: Vec<ModeEstimate> = modes.collect();
        let omega = |m: &ModeEstimate| m.natural_frequency_rad_s.value;
        modes.sort_by(|a, b| omega(a).total_cmp(&omega(b)));
        let tips = &channels.tips;
        let known = |i: usize| tips[i].calibrated && tips[i].quantity != TipQuantity::Acceleration;
        let by_tip = self.arm.coupling_by_tip().map_or(Vec::new(), |found| {
            let figure =
                |i: usize| self.figure(|arm| arm.coupling_by_tip().map_or(f64::NAN, |k| k[i]));
            (0..found.len()).map(|i| known(i).then(|| figure(i))).collect()
        });
        Beam {
            modes,
            coupling: (!self.arm.modes.is_empty())
                .then(|| self.figure(ModalArm::coupling_nm_per_rad)),
            coupling_by_tip: by_tip,
        }
    }

    /// Whether the arm describes the runs from end to end: the residual of whole runs is that of
    /// short windows, and no more than a few times what the sensors show of noise by themselves.
    pub fn stands(&self) -> bool {
        let finite = self.covariance.diagonal().iter().all(|v| v.is_finite() && *v > 0.0);
        self.whole_runs && self.beyond_noise < BEYOND && finite && self.arm.inertia_kg_m2 > 0.0
    }
}
