//! The arm that is exported, and what a target needs to know of it.

use std::path::Path;

use lissom_core::arm::Arm;
use lissom_core::load::TorqueRipple;
use lissom_core::lti::{StateSpace, TransferFunction};
use lissom_core::record::{Axis, CommandQuantity};
use lissom_core::replay::{ModalArm, Oscillator, Ripple};

use super::export_error::ExportError;
use super::friction_pair::FrictionPair;
use crate::io_error::Error;
use crate::result::{
    FrequencyResponseEntry, FrictionEntry, ListedParameter, ParameterList, ResultFile, UnitNames,
};

/// An arm for another program.
#[derive(Debug, Clone)]
pub struct ExportModel {
    /// The file that it is from.
    pub file: String,
    /// Units of the numbers.
    pub names: UnitNames,
    /// Torque per unit of command; 1 if it is unknown, torques are then in the unit of the command.
    pub torque_per_command: f64,
    /// The arm. Its viscous friction contains the damping by back-EMF.
    pub arm: ModalArm,
    /// Names of the tips.
    pub tips: Vec<String>,
    /// The estimates with their standard errors; empty for a description.
    pub parameters: Vec<ListedParameter>,
    /// The measured responses; `None` for a description.
    pub responses: Option<FrequencyResponseEntry>,
    /// Coulomb friction \[N·m\] and viscous friction \[N·m·s/rad\] of the line that stands for a law of friction, with the damping by
    /// back-EMF; `None` without a law or if one of both is not given.
    pub friction_line: Option<[f64; 2]>,
    /// Largest speed at which friction was identified \[rad/s\]; `None` if it is unknown.
    pub speed_most_rad_s: Option<f64>,
    /// Whether the joint has bristles (LuGre), which the arm does not contain.
    pub bristles: bool,
}

/// The model of a `result.json`.
///
/// # Errors
/// [`Error::Result`] if the file is no result, [`ExportError::NoArm`] if the result has no arm,
/// [`ExportError::NoModes`] if its arm does not move what is behind the motor.
pub fn export_model_of_result(path: &Path) -> Result<ExportModel, Error> {
    let file = path.display().to_string();
    let text = crate::read_text::read_text(path)
        .map_err(|source| ExportError::Read { file: file.clone(), source })?;
    export_model_of_text(file, &text)
}

/// The model of the text of a `result.json`, which errors call `file`.
///
/// # Errors
/// As [`export_model_of_result`].
pub fn export_model_of_text(file: String, text: &str) -> Result<ExportModel, Error> {
    let result = ResultFile::of_text(&file, text)?;
    let listed = ParameterList::of(&result);
    let Some(entry) = &result.arm else { return Err(ExportError::NoArm { file }.into()) };
    let found = entry.found(listed.names).map_err(|wrong| crate::result::ResultError::Key {
        file: file.clone(),
        key: wrong.key,
        expected: wrong.expected,
    })?;
    if !found.moves() {
        return Err(ExportError::NoModes { file }.into());
    }
    let speeds = result.friction.curve.iter().map(|p| p.speed.value);
    Ok(ExportModel {
        friction_line: friction_line(&result.friction, &found.arm),
        file,
        names: listed.names,
        speed_most_rad_s: speeds.fold(None, |most, s| Some(most.map_or(s, |m: f64| m.max(s)))),
        torque_per_command: result.torque_per_command.unwrap_or(1.0),
        tips: entry.tips.iter().map(|tip| tip.name.clone()).collect(),
        arm: found.arm,
        parameters: listed.parameters,
        bristles: false,
        responses: Some(result.frequency_response),
    })
}

/// The line of a result's friction beside its law. The arm's viscous friction is that of the law and the damping by back-EMF.
fn friction_line(friction: &FrictionEntry, arm: &ModalArm) -> Option<[f64; 2]> {
    let law = friction.law.as_ref()?.viscous.as_ref()?.value;
    let coulomb = friction.coulomb.coulomb.as_ref()?.value;
    let viscous = friction.viscous.as_ref()?.value;
    let [forward, backward] = arm.viscous_nm_s_per_rad;
    Some([coulomb, viscous + 0.5 * (forward + backward) - law])
}

/// The model of an arm that an `arm.toml` describes.
///
/// # Errors
/// [`ExportError::Arm`] if the arm has no such model: too many modes, or modes that are not distinct.
pub fn export_model_of_arm(file: &Path, arm: &Arm) -> Result<ExportModel, ExportError> {
    let file = file.display().to_string();
    let reason = "the beam has no modal form: its modes are not distinct or too many";
    let Some(modal) = ModalArm::of_arm(arm) else { return Err(ExportError::Arm { file, reason }) };
    let tips = (1..=modal.shapes.len()).map(|i| format!("mass_{i}")).collect();
    Ok(ExportModel {
        file,
        names: UnitNames {
            torque_known: true,
            axis: Axis::Rotary,
            command: CommandQuantity::Current,
        },
        torque_per_command: arm.motor.torque_constant_nm_per_a(),
        tips,
        arm: modal,
        parameters: Vec::new(),
        responses: None,
        friction_line: None,
        speed_most_rad_s: None,
        bristles: false,
    })
}

impl ExportModel {
    /// The linear model without friction, from the command to motor and tips.
    pub(super) fn state_space(&self) -> StateSpace {
        let tips: Vec<(usize, String)> = self.tips.iter().cloned().enumerate().collect();
        self.arm.state_space(self.torque_per_command, &tips, self.names.angle())
    }

    /// Motor angle per command.
    pub(super) fn motor_function(&self) -> TransferFunction {
        self.arm.motor_function(self.torque_per_command)
    }

    /// Unit of torques in words.
    pub(super) fn torque_unit(&self) -> &'static str {
        match (self.names.torque_known, self.names.axis) {
            (true, Axis::Rotary) => "N*m",
            (true, Axis::Linear) => "N",
            (false, _) => "unit of the command",
        }
    }

    /// Lines about the origin, and the estimates with their standard errors.
    pub(super) fn about(&self) -> Vec<String> {
        let mut lines = vec![format!(
            "Made by lissom {} from {}. SI units and rad/s; torques in {}.",
            env!("CARGO_PKG_VERSION"),
            super::number_text::plain(&self.file),
            self.torque_unit()
        )];
        lines.extend(self.parameters.iter().filter_map(|p| {
            let e = p.estimate.as_ref()?;
            Some(format!("{} {:.6e} +- {:.1e} (standard error)", p.key, e.value, e.std))
        }));
        lines
    }

    /// Coulomb and viscous friction for a target without other friction.
    pub(super) fn pair(&self) -> FrictionPair {
        FrictionPair::of(&self.arm, self.friction_line, self.speed_most_rad_s)
    }

    /// What a target with only Coulomb and viscous friction cannot carry, and what its two numbers are.
    pub(super) fn lost_by_pair(&self) -> Vec<String> {
        let mut lost = self.lost_at_any_speed();
        if let Some(fit) = self.pair().fit {
            let (torque, speed) = (self.torque_unit(), self.names.angle());
            lost.extend(self.lost_with_speed().map(|terms| {
                format!(
                    "{terms}. Damping and friction are the line of least squares through the whole law, which from 0 to {:.4e} \
                     {speed}/s differs from it by at most {:.2e} {torque} (at {:.2e} {speed}/s); the law itself has {:.4e} \
                     {torque} and {:.4e} {torque} per {speed}/s beside these terms",
                    fit.speed_most_rad_s,
                    fit.error_nm,
                    fit.error_at_rad_s,
                    self.arm.coulomb_nm,
                    self.viscous()
                )
            }));
        }
        lost
    }

    /// What a model without friction other than Coulomb and viscous friction does not contain.
    pub(super) fn lost_friction(&self) -> Vec<String> {
        let mut lost = self.lost_at_any_speed();
        lost.extend(self.lost_with_speed());
        lost
    }

    /// Lines about the gains of WPILib: what they leave out.
    pub(super) fn lost_by_wpilib(&self) -> Vec<String> {
        let line =
            |lost: &String| format!("Not in these gains: {}.", super::number_text::plain(lost));
        self.lost_by_pair().iter().map(line).collect()
    }

    /// Friction that changes with speed in another way than viscous friction, if there is any.
    fn lost_with_speed(&self) -> Option<String> {
        let (torque, angle) = (self.torque_unit(), self.names.angle());
        let near = self.arm.dry_terms.near_rest.map(|near| {
            format!(
                "change of friction near standstill: {:.4e} {torque} below about {:.4e} {angle}/s",
                near.torque_nm, near.speed_rad_s,
            )
        });
        let root = self.arm.dry_terms.root.map(|root| {
            format!(
                "friction that grows with the square root of speed: {:.4e} {torque} at 1 {angle}/s",
                root.torque_nm_per_root_rad_s,
            )
        });
        let all: Vec<String> = near.into_iter().chain(root).collect();
        (!all.is_empty()).then(|| all.join("; "))
    }

    fn lost_at_any_speed(&self) -> Vec<String> {
        let arm = &self.arm;
        let [forward, backward] = arm.viscous_nm_s_per_rad;
        let mut lost = Vec::new();
        if arm.offset_nm.abs() > 0.0 {
            lost.push(format!(
                "offset {:.4e} {} (constant load, or friction that differs by direction)",
                arm.offset_nm,
                self.torque_unit()
            ));
        }
        if (forward - backward).abs() > 0.0 {
            lost.push(format!("viscous friction by direction: {forward:.4e} and {backward:.4e}"));
        }
        let unit = self.torque_unit();
        let (friction, torque) = (&arm.dry_terms.ripples, &arm.torque_ripples);
        if !friction.is_empty() {
            let most: f64 = friction.iter().map(Ripple::amplitude_nm).sum();
            lost.push(format!(
                "{} ripple(s) of friction over the travel, up to {most:.4e} {unit}",
                friction.len()
            ));
        }
        if let Some(term) = arm.dry_terms.with_load {
            lost.push(format!(
                "friction that grows with the torque of gravity: {:.4e} times it, up to {:.4e} {unit}",
                term.coefficient,
                term.coefficient * term.load.amplitude_nm()
            ));
        }
        if !torque.is_empty() {
            let most: f64 = torque.iter().map(TorqueRipple::amplitude_nm).sum();
            lost.push(format!(
                "{} torque ripple(s) (cogging), up to {most:.4e} {unit}",
                torque.len()
            ));
        }
        if self.bristles {
            lost.push("bristles (LuGre): motion before the joint slips".to_owned());
        }
        if arm.command_lag_s.abs() > 0.0 {
            lost.push(format!("delay of the command: {:.4e} s", arm.command_lag_s));
        }
        lost
    }

    /// The comment at a joint of a user's model: the origin of the numbers, and what the joint cannot represent.
    pub(super) fn merged_note(&self) -> Vec<String> {
        let mut lines: Vec<String> = self.about().into_iter().take(1).collect();
        lines.extend(self.lost_by_pair().iter().map(|lost| format!("Not in this joint: {lost}.")));
        if self.arm.gravity.is_some() {
            lines.push("Not in this joint: gravity of the load.".to_owned());
        }
        if !self.arm.modes.is_empty() {
            lines.push("Not in this joint: the modes of the arm.".to_owned());
        }
        lines
    }

    /// Mean viscous friction of both directions.
    pub(super) fn viscous(&self) -> f64 {
        0.5 * (self.arm.viscous_nm_s_per_rad[0] + self.arm.viscous_nm_s_per_rad[1])
    }

    /// Inertia of all that the motor turns, also behind springs.
    pub(super) fn total_inertia(&self) -> f64 {
        self.arm.inertia_kg_m2 + self.arm.modes.iter().map(Oscillator::inertia_kg_m2).sum::<f64>()
    }

    /// Inertia of a joint whose body is rigid: all that turns, unless tips show that the arm bends, which is then a matter of
    /// the bodies on the joint.
    pub(super) fn joint_inertia(&self) -> f64 {
        if self.tips.is_empty() { self.total_inertia() } else { self.arm.inertia_kg_m2 }
    }

    /// Gains of WPILib for a command in volts: kS, kV, kA and kG. kS and kV are the pair of the friction law.
    pub(super) fn wpilib(&self) -> Option<[f64; 4]> {
        let volts = self.names.command == CommandQuantity::Voltage;
        let k = self.torque_per_command;
        let gravity = self.arm.gravity.map_or(0.0, |g| g.sine_nm.hypot(g.cosine_nm));
        let pair = self.pair();
        let gains = [pair.coulomb_nm, pair.viscous_nm_s_per_rad, self.total_inertia(), gravity]
            .map(|x| x / k);
        volts.then_some(gains)
    }

    /// Refuses a model without a torque constant.
    pub(super) fn needs_torque(&self, target: &'static str) -> Result<(), ExportError> {
        if self.names.torque_known {
            return Ok(());
        }
        Err(ExportError::NoTorque { file: self.file.clone(), target })
    }
}
