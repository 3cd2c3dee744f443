//! Reads the parameters of a `result.json`.

use std::path::Path;

use serde::Deserialize;
use serde_json::Value;

use super::channel_names::{AxisName, MethodName};
use super::estimate_entry::EstimateEntry;
use super::estimate_keys::Refusable;
use super::finding_entry::{FindingEntry, SeverityName};
use super::finding_keys::{COULOMB, COUPLING, GRAVITY, INERTIA, MODES, OFFSET, VISCOUS};
use super::friction_entry::FrictionEntry;
use super::friction_term_entries::LawTermName;
use super::gravity_entry::GravityEntry;
use super::result_error::ResultError;
use super::result_file::{BeamEntry, DriveEntry, ResultFile};
use super::unit_keys::{Quantity, WithUnit};
use super::unit_names::UnitNames;
use crate::io_error::Error;
use crate::read_text::read_text;

/// A result as a list of parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct ParameterList {
    /// Its units.
    pub names: UnitNames,
    /// The method that gave friction, inertia and coupling.
    pub from: Option<MethodName>,
    /// Torque constant used, N·m or N per unit of command; `None` if it is unknown.
    pub torque_per_command: Option<f64>,
    /// Terms of the friction law in addition to Coulomb friction and one viscous coefficient.
    pub friction_terms: Vec<LawTermName>,
    /// Number of the beam's modes.
    pub modes: usize,
    /// The parameters, in the order of the tables.
    pub parameters: Vec<ListedParameter>,
}

/// A parameter of a result.
#[derive(Debug, Clone, PartialEq)]
pub struct ListedParameter {
    /// Its key in `result.json`, with dots and the suffix of its unit.
    pub key: String,
    /// Its name in words.
    pub name: String,
    /// Its unit in words.
    pub unit: String,
    /// The estimate; `None` if it is refused.
    pub estimate: Option<EstimateEntry>,
    /// Codes of the warnings that affect it.
    pub warnings: Vec<String>,
}

/// The part of a [`ResultFile`](super::ResultFile) that a list of parameters needs. Results of other versions can be
/// read as long as this part is the same.
#[derive(Debug, Deserialize)]
struct ParameterPart {
    axis: AxisName,
    torque_per_command: Option<f64>,
    #[serde(default)]
    from: Option<MethodName>,
    friction: FrictionEntry,
    drive: DriveEntry,
    #[serde(default)]
    gravity: Option<GravityEntry>,
    beam: BeamEntry,
    findings: Vec<FindingEntry>,
}

/// Reads the parameters of a result.
///
/// # Errors
/// [`Error::Result`] if the file cannot be read or is not a result.
pub fn read_result(path: &Path) -> Result<ParameterList, Error> {
    let file = path.display().to_string();
    let text =
        read_text(path).map_err(|source| ResultError::Read { file: file.clone(), source })?;
    Ok(ParameterList::of_text(&file, &text)?)
}

impl ParameterList {
    /// The parameters of the text of a `result.json`, which errors call `file`.
    ///
    /// # Errors
    /// [`ResultError`] if the text is not a result.
    pub fn of_text(file: &str, text: &str) -> Result<Self, ResultError> {
        let file = || file.to_owned();
        let root: Value = serde_json::from_str(text.trim_start_matches('\u{feff}'))
            .map_err(|source| ResultError::Json { file: file(), source })?;
        for key in [
            "lissom",
            "axis",
            "torque_per_command",
            "friction",
            "drive",
            "beam",
            "runs",
            "findings",
        ] {
            if root.get(key).is_none() {
                return Err(ResultError::NoResult { file: file(), key });
            }
        }
        let part: ParameterPart = serde_path_to_error::deserialize(&root).map_err(|error| {
            let key = error.path().to_string();
            ResultError::Value { file: file(), key, source: error.into_inner() }
        })?;
        part.list().ok_or_else(|| ResultError::Key {
            file: file(),
            key: "friction.coulomb_…".to_owned(),
            expected: "given with the units of an axis",
        })
    }

    /// The parameters of a result. `None` if its keys do not have the units of an axis, which results from
    /// [`ResultFile::of`] always have.
    pub fn of(result: &ResultFile) -> Option<Self> {
        let part = ParameterPart {
            axis: result.axis,
            torque_per_command: result.torque_per_command,
            from: result.from,
            friction: result.friction.clone(),
            drive: result.drive.clone(),
            gravity: result.gravity.clone(),
            beam: result.beam.clone(),
            findings: result.findings.clone(),
        };
        part.list()
    }
}

impl ParameterPart {
    fn list(&self) -> Option<ParameterList> {
        let names = self.names()?;
        Some(ParameterList {
            names,
            from: self.from,
            torque_per_command: self.torque_per_command,
            friction_terms: self.friction_terms(),
            modes: self.beam.modes.len(),
            parameters: Listing::of(names, self),
        })
    }

    /// The units, by the keys of Coulomb friction.
    fn names(&self) -> Option<UnitNames> {
        self.friction.names(self.axis)
    }

    /// Terms of the friction law of the result.
    fn friction_terms(&self) -> Vec<LawTermName> {
        let Some(law) = &self.friction.law else { return Vec::new() };
        let t = &law.terms;
        let mut terms = Vec::new();
        terms.extend(law.viscous_forward.any().map(|_| LawTermName::ViscousByDirection));
        terms.extend(t.near_rest.as_ref().map(|_| LawTermName::NearRest));
        terms.extend(t.root.any().map(|_| LawTermName::Root));
        terms.extend(t.with_load.as_ref().map(|_| LawTermName::WithLoad));
        terms.extend(t.ripples.iter().map(|_| LawTermName::Ripple));
        terms.extend(t.torque_ripples.iter().map(|_| LawTermName::TorqueRipple));
        terms
    }
}

/// A list of parameters that is being built.
struct Listing<'a> {
    names: UnitNames,
    part: &'a ParameterPart,
    parameters: Vec<ListedParameter>,
}

impl<'a> Listing<'a> {
    fn of(names: UnitNames, part: &'a ParameterPart) -> Vec<ListedParameter> {
        let mut listing = Self { names, part, parameters: Vec::new() };
        listing.friction();
        listing.friction_law();
        listing.drive_and_beam();
        listing.parameters
    }

    /// Adds a parameter; findings with one of the keys `affected` affect it.
    fn add(
        &mut self,
        (key, name, unit): (String, &str, &str),
        estimate: Option<&EstimateEntry>,
        affected: &[&str],
    ) {
        // A refusal of something else may affect what is given.
        let is_warning = |f: &&FindingEntry| match f.severity {
            SeverityName::Warning => true,
            SeverityName::Refusal => estimate.is_some(),
            SeverityName::Info => false,
        };
        let affects = |f: &&FindingEntry| f.affects.iter().any(|k| affected.contains(&k.as_str()));
        let mut warnings: Vec<String> = Vec::new();
        for finding in self.part.findings.iter().filter(is_warning).filter(affects) {
            if !warnings.contains(&finding.code) {
                warnings.push(finding.code.clone());
            }
        }
        self.parameters.push(ListedParameter {
            key,
            name: name.to_owned(),
            unit: unit.to_owned(),
            estimate: estimate.cloned(),
            warnings,
        });
    }

    /// Adds a parameter of a table of the result, if the table has its key.
    fn keyed<Q: Quantity>(
        &mut self,
        (table, name, unit): (&str, &str, &str),
        value: &Refusable<Q>,
        affected: &[&str],
    ) {
        if let Some((key, estimate)) = value.keyed(self.names) {
            self.add((format!("{table}.{key}"), name, unit), estimate.as_ref(), affected);
        }
    }

    /// The same for a value that is never refused.
    fn estimated<Q: Quantity>(
        &mut self,
        (table, name, unit): (&str, &str, &str),
        value: &WithUnit<Q, EstimateEntry>,
        affected: &[&str],
    ) {
        if let Some((key, estimate)) = value.keyed(self.names) {
            self.add((format!("{table}.{key}"), name, unit), Some(estimate), affected);
        }
    }

    fn friction(&mut self) {
        let (f, names) = (&self.part.friction, self.names);
        let (torque, viscous) = (names.torque_unit(), names.viscous_unit());
        let c = &f.coulomb;
        if names.torque_known
            && let Some((key, estimate)) = c.coulomb.of_command(names)
        {
            let id = (format!("friction.{key}"), "Coulomb friction", names.command_unit());
            self.add(id, estimate.as_ref(), &[COULOMB]);
        }
        self.keyed(("friction", "Coulomb friction", torque), &c.coulomb, &[COULOMB]);
        // One direction only: friction and a constant load are one number.
        let alone = c.coulomb.get(names).is_none_or(Option::is_none);
        let [forward, backward] = if alone {
            ["friction with the load forward", "friction with the load backward"]
        } else {
            ["Coulomb friction forward", "Coulomb friction backward"]
        };
        self.keyed(("friction", forward, torque), &c.forward, &[COULOMB, OFFSET]);
        self.keyed(("friction", backward, torque), &c.backward, &[COULOMB, OFFSET]);
        self.keyed(("friction", "Coulomb friction offset", torque), &c.offset, &[OFFSET]);
        self.keyed(("friction", "viscous friction", &viscous), &f.viscous, &[VISCOUS]);
    }

    /// The law of friction, if it has terms beyond the line.
    fn friction_law(&mut self) {
        let (Some(law), names) = (&self.part.friction.law, self.names) else { return };
        let (torque, angle, viscous) = (names.torque_unit(), names.angle(), names.viscous_unit());
        let table = "friction.law";
        self.keyed(
            (table, "Coulomb friction of the law", torque),
            &law.coulomb.coulomb,
            &[COULOMB],
        );
        self.keyed((table, "viscous friction of the law", &viscous), &law.viscous, &[VISCOUS]);
        let name = "viscous friction forward";
        self.estimated((table, name, &viscous), &law.viscous_forward, &[VISCOUS]);
        let name = "viscous friction backward";
        self.estimated((table, name, &viscous), &law.viscous_backward, &[VISCOUS]);
        let terms = &law.terms;
        if let Some(near) = &terms.near_rest {
            let table = "friction.law.near_rest";
            // None where friction does not rise towards rest: that refuses nothing.
            if near.static_friction.get(names).is_some_and(Option::is_some) {
                self.keyed((table, "static friction", torque), &near.static_friction, &[COULOMB]);
            }
            self.keyed((table, "friction near rest", torque), &near.amplitude, &[COULOMB]);
            let unit = format!("{angle}/s");
            self.estimated((table, "friction near rest speed", &unit), &near.speed, &[COULOMB]);
        }
        let unit = format!("{torque}/√({angle}/s)");
        self.estimated(
            (table, "friction per root of speed", &unit),
            &terms.root,
            &[COULOMB, VISCOUS],
        );
        if let Some(with_load) = &terms.with_load {
            let id = ("friction.law.with_load".to_owned(), "friction per load", "1");
            self.add(id, Some(with_load), &[COULOMB]);
        }
        for (list, what, ripples) in [
            ("ripples", "ripple", &terms.ripples),
            ("torque_ripples", "torque ripple", &terms.torque_ripples),
        ] {
            for (k, ripple) in ripples.iter().enumerate() {
                let table = format!("friction.law.{list}[{k}]");
                let name = format!("{what} {}", k + 1);
                self.keyed((&table, &name, torque), &ripple.amplitude, &[COULOMB]);
                let name = format!("{name} period");
                self.estimated((&table, &name, angle), &ripple.period, &[COULOMB]);
            }
        }
    }

    fn drive_and_beam(&mut self) {
        let (part, names) = (self.part, self.names);
        let (torque, inertia) = (names.torque_unit(), names.inertia_unit());
        let name = names.inertia_name();
        self.keyed(("drive", name, &inertia), &part.drive.inertia, &[INERTIA]);
        if let Some(gravity) = &part.gravity {
            let name = "gravity m·g·l";
            self.estimated(("gravity", name, torque), &gravity.amplitude, &[GRAVITY]);
            let id = (PHASE_KEY.to_owned(), "gravity m·g·l phase", "rad");
            self.add(id, Some(&gravity.phase_rad), &[GRAVITY]);
            let unit = format!("N·m/{}", names.command_unit());
            let name = "torque constant from m·g·l";
            // Without a known m·g·l it was not asked for.
            if gravity.torque_constant.get(names).is_some_and(Option::is_some) {
                self.keyed(("gravity", name, &unit), &gravity.torque_constant, &[GRAVITY]);
            }
        }
        let coupling = names.coupling_unit();
        let name = "coupling to the beam";
        // A rigid axis has none that could be refused.
        let tips = part.beam.coupling_by_tip.get(names).is_some_and(|tips| !tips.is_empty());
        if tips || part.beam.coupling.get(names).is_some_and(Option::is_some) {
            self.keyed(("beam", name, &coupling), &part.beam.coupling, &[COUPLING]);
        }
        for (k, mode) in part.beam.modes.iter().enumerate() {
            let key = |name: &str| format!("beam.modes[{k}].{name}");
            let name = format!("mode {} frequency", k + 1);
            let id = (key("natural_frequency_rad_s"), name.as_str(), "rad/s");
            self.add(id, Some(&mode.natural_frequency_rad_s), &[MODES]);
            let name = format!("mode {} damping ratio", k + 1);
            let id = (key("damping_ratio"), name.as_str(), "1");
            self.add(id, mode.damping_ratio.as_ref(), &[MODES]);
        }
    }
}

/// Key of the phase of the load. It is the only parameter that is an angle, known up to whole turns.
pub const PHASE_KEY: &str = "gravity.phase_rad";
