//! The parameters of a result as a list.

use lissom_core::identify::{Method, Severity};

use super::estimate_entry::EstimateEntry;
use super::finding_entry::FindingEntry;
use super::finding_keys::{COULOMB, COUPLING, GRAVITY, INERTIA, MODES, OFFSET, VISCOUS};
use super::friction_term_entries::LawTermName;
use super::result_file::ResultFile;
use super::unit_names::UnitNames;

/// A result as a list of parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct ParameterList {
    /// Its units.
    pub names: UnitNames,
    /// The method that gave friction, inertia and coupling.
    pub from: Option<Method>,
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
    /// Its key in `result.json`, with dots.
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

impl ParameterList {
    /// The parameters of a result.
    pub fn of(result: &ResultFile) -> Self {
        let names = result.names();
        Self {
            names,
            from: result.from,
            torque_per_command: result.torque_per_command,
            friction_terms: friction_terms(result),
            modes: result.beam.modes.len(),
            parameters: Listing::of(names, result),
        }
    }
}

/// Terms of the friction law of a result.
fn friction_terms(result: &ResultFile) -> Vec<LawTermName> {
    let Some(law) = &result.friction.law else { return Vec::new() };
    let t = &law.terms;
    let mut terms = Vec::new();
    terms.extend(law.viscous_forward.as_ref().map(|_| LawTermName::ViscousByDirection));
    terms.extend(t.near_rest.as_ref().map(|_| LawTermName::NearRest));
    terms.extend(t.root.as_ref().map(|_| LawTermName::Root));
    terms.extend(t.with_load.as_ref().map(|_| LawTermName::WithLoad));
    terms.extend(t.ripples.iter().map(|_| LawTermName::Ripple));
    terms.extend(t.torque_ripples.iter().map(|_| LawTermName::TorqueRipple));
    terms
}

/// A list of parameters that is being built.
struct Listing<'a> {
    names: UnitNames,
    part: &'a ResultFile,
    parameters: Vec<ListedParameter>,
}

impl<'a> Listing<'a> {
    fn of(names: UnitNames, part: &'a ResultFile) -> Vec<ListedParameter> {
        let mut listing = Self { names, part, parameters: Vec::new() };
        listing.friction();
        listing.friction_law();
        listing.drive_and_beam();
        listing.parameters
    }

    /// Adds a parameter; findings with one of the keys `affected` affect it.
    fn add(
        &mut self,
        (key, name, unit): (&str, &str, &str),
        estimate: Option<&EstimateEntry>,
        affected: &[&str],
    ) {
        // A refusal of something else may affect what is given.
        let is_warning = |f: &&FindingEntry| match f.severity {
            Severity::Warning => true,
            Severity::Refusal => estimate.is_some(),
            Severity::Info => false,
        };
        let affects = |f: &&FindingEntry| f.affects.iter().any(|k| affected.contains(&k.as_str()));
        let mut warnings: Vec<String> = Vec::new();
        for finding in self.part.findings.iter().filter(is_warning).filter(affects) {
            if !warnings.contains(&finding.code) {
                warnings.push(finding.code.clone());
            }
        }
        self.parameters.push(ListedParameter {
            key: key.to_owned(),
            name: name.to_owned(),
            unit: unit.to_owned(),
            estimate: estimate.cloned(),
            warnings,
        });
    }

    fn friction(&mut self) {
        let (f, names) = (&self.part.friction, self.names);
        let (torque, viscous) = (names.torque_unit(), names.viscous_unit());
        let c = &f.coulomb;
        self.add((COULOMB, "Coulomb friction", torque), c.coulomb.as_ref(), &[COULOMB]);
        // One direction only: friction and a constant load are one number.
        let alone = c.coulomb.is_none();
        let [forward, backward] = if alone {
            ["friction with the load forward", "friction with the load backward"]
        } else {
            ["Coulomb friction forward", "Coulomb friction backward"]
        };
        let both = &[COULOMB, OFFSET];
        self.add(("friction.forward", forward, torque), c.forward.as_ref(), both);
        self.add(("friction.backward", backward, torque), c.backward.as_ref(), both);
        self.add((OFFSET, "Coulomb friction offset", torque), c.offset.as_ref(), &[OFFSET]);
        self.add((VISCOUS, "viscous friction", &viscous), f.viscous.as_ref(), &[VISCOUS]);
    }

    /// The law of friction, if it has terms beyond the line.
    fn friction_law(&mut self) {
        let (Some(law), names) = (&self.part.friction.law, self.names) else { return };
        let (torque, angle, viscous) = (names.torque_unit(), names.angle(), names.viscous_unit());
        let (speed, root) = (names.speed_unit(), names.root_unit());
        let at = |key: &str| format!("friction.law.{key}");
        let coulomb = law.coulomb.coulomb.as_ref();
        self.add((&at("coulomb"), "Coulomb friction of the law", torque), coulomb, &[COULOMB]);
        let id = (&*at("viscous"), "viscous friction of the law", &*viscous);
        self.add(id, law.viscous.as_ref(), &[VISCOUS]);
        let terms = &law.terms;
        // What is not there refuses nothing.
        let mut given = |key: &str, name: &str, unit: &str, found: Option<&EstimateEntry>| {
            let affected: &[&str] = match key {
                "root" => &[COULOMB, VISCOUS],
                _ if key.starts_with("viscous") => &[VISCOUS],
                _ => &[COULOMB],
            };
            if found.is_some() {
                self.add((&at(key), name, unit), found, affected);
            }
        };
        let (forward, backward) = (law.viscous_forward.as_ref(), law.viscous_backward.as_ref());
        given("viscous_forward", "viscous friction forward", &viscous, forward);
        given("viscous_backward", "viscous friction backward", &viscous, backward);
        if let Some(near) = &terms.near_rest {
            let at_rest = near.static_friction.as_ref();
            given("near_rest.static_friction", "static friction", torque, at_rest);
            given("near_rest.amplitude", "friction near rest", torque, near.amplitude.as_ref());
            given("near_rest.speed", "friction near rest speed", &speed, Some(&near.speed));
        }
        given("root", "friction per root of speed", &root, terms.root.as_ref());
        given("with_load", "friction per load", "1", terms.with_load.as_ref());
        for (list, what, ripples) in [
            ("ripples", "ripple", &terms.ripples),
            ("torque_ripples", "torque ripple", &terms.torque_ripples),
        ] {
            for (k, ripple) in ripples.iter().enumerate() {
                let key = |of: &str| at(&format!("{list}[{k}].{of}"));
                let name = format!("{what} {}", k + 1);
                let amplitude = ripple.amplitude.as_ref();
                self.add((&key("amplitude"), &name, torque), amplitude, &[COULOMB]);
                let name = format!("{name} period");
                self.add((&key("period"), &name, angle), Some(&ripple.period), &[COULOMB]);
            }
        }
    }

    fn drive_and_beam(&mut self) {
        let (part, names) = (self.part, self.names);
        let (torque, inertia) = (names.torque_unit(), names.inertia_unit());
        let id = (INERTIA, names.inertia_name(), &*inertia);
        self.add(id, part.drive.inertia.as_ref(), &[INERTIA]);
        if let Some(gravity) = &part.gravity {
            let id = ("gravity.amplitude", "gravity m·g·l", torque);
            self.add(id, Some(&gravity.amplitude), &[GRAVITY]);
            let id = (PHASE_KEY, "gravity m·g·l phase", "rad");
            self.add(id, Some(&gravity.phase_rad), &[GRAVITY]);
            // Without a known m·g·l it was not asked for.
            if let Some(constant) = &gravity.torque_constant {
                let unit = names.torque_constant_unit();
                let id = ("gravity.torque_constant", "torque constant from m·g·l", &*unit);
                self.add(id, Some(constant), &[GRAVITY]);
            }
        }
        // A rigid axis has none that could be refused.
        if !part.beam.coupling_by_tip.is_empty() || part.beam.coupling.is_some() {
            let unit = names.coupling_unit();
            let id = (COUPLING, "coupling to the beam", &*unit);
            self.add(id, part.beam.coupling.as_ref(), &[COUPLING]);
        }
        for (k, mode) in part.beam.modes.iter().enumerate() {
            let key = |name: &str| format!("beam.modes[{k}].{name}");
            let name = format!("mode {} frequency", k + 1);
            let id = (&*key("natural_frequency_rad_s"), &*name, "rad/s");
            self.add(id, Some(&mode.natural_frequency_rad_s), &[MODES]);
            let name = format!("mode {} damping ratio", k + 1);
            self.add((&key("damping_ratio"), &name, "1"), mode.damping_ratio.as_ref(), &[MODES]);
        }
    }
}

/// Key of the phase of the load. It is the only parameter that is an angle, known up to whole turns.
pub const PHASE_KEY: &str = "gravity.phase_rad";
