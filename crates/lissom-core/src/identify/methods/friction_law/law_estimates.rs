//! All estimates under a law of friction.

use crate::identify::drive_estimates::DriveEstimates;
use crate::identify::estimate::Estimate;
use crate::identify::friction_estimates::{Friction, LawEstimates};
use crate::identify::methods::friction_law::LawFit;
use crate::identify::methods::friction_law::law_term::LawTerm;

impl LawFit {
    /// All estimates under this law.
    pub fn estimates(&self) -> DriveEstimates {
        DriveEstimates {
            friction: friction(self),
            inertia: self.inertia,
            coupling: self.total_coupling,
            coupling_by_tip: self.coupling.clone(),
            gravity: self.gravity,
        }
    }
}

fn friction(law: &LawFit) -> Friction {
    let sum = |a: Option<Estimate>, b: Option<Estimate>, sign: f64| {
        let (a, b) = (a?, b?);
        Some(Estimate { value: a.value + sign * b.value, std: a.std.hypot(b.std) })
    };
    let difference = law.term(|t| *t == LawTerm::ViscousByDirection);
    let by_direction = |sign: f64| sum(law.viscous, difference, sign);
    let whole = LawEstimates {
        coulomb: law.coulomb,
        forward: law.forward,
        backward: law.backward,
        viscous: law.viscous,
        viscous_by_direction: by_direction(1.0).zip(by_direction(-1.0)),
        ..LawEstimates::of_law_terms(&law.terms, law.at_rest)
    };
    let [coulomb, viscous] = law.projected;
    let [forward, backward] = law.projected_by_direction;
    let offset = law.offset;
    let law = whole.has_terms().then_some(whole);
    Friction { coulomb, forward, backward, offset, viscous, law }
}
