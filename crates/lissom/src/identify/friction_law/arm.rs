//! A law of friction as an arm has it.

use super::{LawFit, LawTerm};
use crate::drive::Falloff;
use crate::identify::Estimate;
use crate::replay::{ModalArm, NearRest, Ripple};

impl LawFit {
    /// Gives an arm the motor's figures under this law; `back_emf_viscous` is what the command's back-EMF
    /// damps beside viscous friction. Tells whether it did: not where a figure is missing, or the law has
    /// a term that the replay does not know.
    pub(crate) fn put_into(&self, arm: &mut ModalArm, back_emf_viscous: f64) -> bool {
        let unknown = self.terms.iter().any(|(term, _)| match term {
            LawTerm::Root | LawTerm::AfterTravel { .. } | LawTerm::Bristles { .. } => true,
            LawTerm::NearRest { falloff, .. } => *falloff != Falloff::Exponential,
            _ => false,
        });
        let (Some(inertia), Some(viscous), Some(coulomb)) =
            (self.inertia, self.viscous, self.coulomb)
        else {
            return false;
        };
        if unknown {
            return false;
        }
        arm.inertia_kg_m2 = inertia.value;
        arm.viscous_nm_s_per_rad = [viscous.value + back_emf_viscous; 2];
        arm.coulomb_nm = coulomb.value;
        arm.offset_nm = self.offset.map_or(0.0, |o| o.value);
        if let Some(total) = self.total_coupling {
            let factor = total.value / arm.coupling_nm_per_rad();
            arm.modes.iter_mut().for_each(|m| m.stiffness_nm_per_rad *= factor);
        }
        self.terms.iter().for_each(|(term, amplitude)| add(arm, *term, amplitude));
        true
    }
}

fn add(arm: &mut ModalArm, term: LawTerm, amplitude: &[Estimate]) {
    match (term, amplitude) {
        (LawTerm::ViscousByDirection, [d]) => {
            arm.viscous_nm_s_per_rad[0] += d.value;
            arm.viscous_nm_s_per_rad[1] -= d.value;
        }
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
