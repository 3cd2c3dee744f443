//! The terms of a friction law as parameters of an arm.

use crate::identify::methods::friction_law::LawFit;
use crate::identify::methods::friction_law::law_term::LawTerm;
use crate::replay::ModalArm;

impl LawFit {
    /// Gives an arm that has the motor's estimates under this law the law's own terms. Tells whether it did: not
    /// where the law has a term that an arm cannot have.
    pub(crate) fn put_terms_into(&self, arm: &mut ModalArm) -> bool {
        let possible = self.terms.iter().all(|(term, _)| term.is_of_arms());
        for (term, amplitude) in self.terms.iter().filter(|_| possible) {
            let values: Vec<f64> = amplitude.iter().map(|a| a.value).collect();
            match (term, &values[..]) {
                (LawTerm::CommandLag, [lag]) => arm.command_lag_s = *lag,
                _ => term.put_into(&mut arm.dry_terms, &values),
            }
        }
        possible
    }
}
