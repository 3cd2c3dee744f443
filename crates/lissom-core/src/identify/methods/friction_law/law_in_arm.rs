//! A friction law as parameters of an arm.

use crate::identify::methods::friction_law::LawFit;
use crate::identify::methods::friction_law::law_term::LawTerm;
use crate::load::TorqueRipple;
use crate::replay::ModalArm;

impl LawFit {
    /// Gives an arm with the motor's estimates under this law the law itself. `None` if one of its estimates is refused.
    pub(crate) fn put_into(&self, mut arm: ModalArm, back_emf_viscous: f64) -> Option<ModalArm> {
        arm.coulomb_nm = self.coulomb?.value;
        arm.offset_nm = self.offset.map_or(0.0, |offset| offset.value);
        arm.viscous_nm_s_per_rad = [self.viscous?.value + back_emf_viscous; 2];
        for (term, amplitude) in &self.terms {
            let values: Vec<f64> = amplitude.iter().map(|a| a.value).collect();
            match (term, &values[..]) {
                (LawTerm::ViscousByDirection, [apart]) => {
                    arm.viscous_nm_s_per_rad[0] += apart;
                    arm.viscous_nm_s_per_rad[1] -= apart;
                }
                (LawTerm::CommandLag, [lag]) => arm.command_lag_s += lag,
                (LawTerm::TorqueRipple { per_angle }, [cosine_nm, sine_nm, rate @ ..]) => {
                    let per_rad = rate.first().copied().unwrap_or(*per_angle);
                    let (cosine_nm, sine_nm) = (*cosine_nm, *sine_nm);
                    arm.torque_ripples.push(TorqueRipple { per_rad, cosine_nm, sine_nm });
                }
                _ => term.put_into(&mut arm.dry_terms, &values),
            }
        }
        Some(arm)
    }
}
