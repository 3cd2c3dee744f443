//! A law of friction as an arm has it.

use crate::drive::Falloff;
use crate::identify::estimate::Estimate;
use crate::identify::methods::friction_law::LawFit;
use crate::identify::methods::friction_law::choice::LawTerm;
use crate::replay::{ModalArm, NearRest, Ripple};

impl LawFit {
    /// Gives an arm that has the motor's estimates under this law the law's own terms. Tells whether it did: not
    /// where the law has a term that an arm cannot have.
    pub(crate) fn put_terms_into(&self, arm: &mut ModalArm) -> bool {
        let unknown = self.terms.iter().any(|(term, _)| match term {
            LawTerm::Root | LawTerm::AfterTravel { .. } => true,
            LawTerm::NearRest { falloff, .. } => *falloff != Falloff::Exponential,
            _ => false,
        });
        if !unknown {
            self.terms.iter().for_each(|(term, amplitude)| add(arm, *term, amplitude));
        }
        !unknown
    }
}

fn add(arm: &mut ModalArm, term: LawTerm, amplitude: &[Estimate]) {
    match (term, amplitude) {
        (LawTerm::NearRest { speed, falloff }, [a]) => {
            let near = NearRest { torque_nm: a.value, speed_rad_s: speed, falloff };
            arm.dry_terms.near_rest = Some(near);
        }
        (LawTerm::Ripple { per_angle }, [cosine, sine, ..]) => {
            let (cosine_nm, sine_nm) = (cosine.value, sine.value);
            arm.dry_terms.ripples.push(Ripple { per_rad: per_angle, cosine_nm, sine_nm });
        }
        (LawTerm::CommandLag, [lag]) => arm.command_lag_s = lag.value,
        _ => {}
    }
}
