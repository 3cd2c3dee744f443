//! What models leave of torque that was not used for their fit.

use crate::identify::methods::friction_law::LagShape;
use crate::identify::methods::friction_law::blocks::{Acts, BlockRows, Regressor};
use crate::identify::methods::friction_law::candidates::law_regressors;
use crate::identify::methods::friction_law::lag::delayed;
use crate::identify::methods::friction_law::law_term::{Column, LawTerm};
use crate::identify::methods::friction_law::prediction::{ByBlock, Divided, Improvement};
use crate::identify::methods::friction_law::rows::{Cut, Sampled};
use crate::identify::methods::regression::MotorColumns;
use crate::identify::prepare::run_noise::RunNoise;
use crate::record::Campaign;
use crate::replay::ModalArm;

/// Rms of what remains of the torque in windows of slip phases that were left out of the fit, as a share of it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct UnusedTorque {
    /// With the line: inertia, Coulomb friction, one viscous constant, an offset, couplings, and gravity if it is declared \[1\].
    pub line: f64,
    /// With the model of the result \[1\].
    pub model: f64,
}

/// The same, block by block.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Unused {
    pub(super) line: ByBlock,
    pub(super) model: ByBlock,
    /// Squared torque of all windows.
    pub(super) power: f64,
    /// Where the windows are cut into kinds of motion.
    pub(super) cut: Cut,
}

impl Unused {
    pub(crate) fn shares(&self) -> UnusedTorque {
        let share = |left: &ByBlock| (left.all() / self.power).sqrt();
        UnusedTorque { line: share(&self.line), model: share(&self.model) }
    }

    /// Whether the line, or the `other` model, is better than the model, by the rule that adopts terms.
    pub(crate) fn is_worse(&self, other: Option<&Self>) -> bool {
        let models = [Some(&self.line), other.map(|other| &other.model)];
        models
            .into_iter()
            .flatten()
            .any(|better| Improvement::between(&self.model, better, 1).is_sure)
    }

    /// The same with the arm of another method, which was not fitted to this torque. `None` of an arm with modes.
    pub(crate) fn with_arm(
        &self,
        campaign: &Campaign,
        noise: &[RunNoise],
        window_s: f64,
        arm: &ModalArm,
    ) -> Option<Self> {
        let late = delayed(campaign, LagShape::Delay, arm.command_lag_s);
        let sampled = Sampled::new(&late, noise, window_s, None);
        let (regressors, values) = equation(arm, &MotorColumns::of(&late))?;
        let mut rows = BlockRows::of(&sampled, &self.cut);
        rows.add(&sampled, &regressors, &[]);
        let columns: Vec<usize> = (0..rows.width()).collect();
        let model = Divided::of(&rows).left_by(&columns, &values.into());
        Some(Self { model, ..self.clone() })
    }
}

/// Regressors beyond those of the line, and the values of all.
fn equation(arm: &ModalArm, own: &MotorColumns) -> Option<(Vec<Regressor>, Vec<f64>)> {
    if !arm.modes.is_empty() || !own.tips.is_empty() || arm.gravity.is_some() != own.gravity {
        return None;
    }
    let [forward, backward] = arm.viscous_nm_s_per_rad;
    let mut values =
        vec![arm.inertia_kg_m2, 0.5 * (forward + backward), arm.coulomb_nm, arm.offset_nm];
    values.extend(arm.gravity.iter().flat_map(|g| [g.sine_nm, g.cosine_nm]));
    let mut regressors = law_regressors(LawTerm::ViscousByDirection);
    values.push(0.5 * (forward - backward));
    let mut with = |term: LawTerm, own: &[f64]| {
        regressors.extend(law_regressors(term));
        values.extend(own);
    };
    let terms = &arm.dry_terms;
    if let Some(near) = terms.near_rest {
        let (speed, falloff) = (near.speed_rad_s, near.falloff);
        with(LawTerm::NearRest { speed, falloff }, &[near.torque_nm]);
    }
    if let Some(root) = terms.root {
        with(LawTerm::Root, &[root.torque_nm_per_root_rad_s]);
    }
    if let Some(term) = terms.with_load {
        with(LawTerm::WithLoad { load: term.load }, &[term.coefficient]);
    }
    for r in &terms.ripples {
        with(LawTerm::Ripple { per_angle: r.per_rad }, &[r.cosine_nm, r.sine_nm]);
    }
    for r in &arm.torque_ripples {
        with(LawTerm::TorqueRipple { per_angle: r.per_rad }, &[r.cosine_nm, r.sine_nm]);
    }
    if let Some(near) = terms.near_rest {
        let column = Column::NearRest(near.speed_rad_s, near.falloff);
        regressors.push(Regressor::Function(column, Acts::Alike));
        values.push(near.offset_nm);
    }
    Some((regressors, values))
}
