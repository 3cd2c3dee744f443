//! Columns of the motor's equation, and the terms that are solved for.

use crate::identify::methods::regression::normal::Term;
use crate::record::{Campaign, TipQuantity};

/// `∫ẅθ`, `−∫ẇθ` and `∫w`; the columns of [`MotorColumns`] follow.
pub(crate) const INERTIA: usize = 0;
pub(crate) const VISCOUS: usize = 1;
pub(crate) const DRY: usize = 2;
const FIRST_TIP: usize = 3;

/// Places of the terms J, V, C and offset; those of the couplings, of gravity and of half the difference of viscous
/// friction follow.
pub(crate) const PLACE_INERTIA: usize = 0;
pub(crate) const PLACE_VISCOUS: usize = 1;
pub(crate) const PLACE_COULOMB: usize = 2;
pub(crate) const PLACE_OFFSET: usize = 3;
const FIRST_COUPLING: usize = 4;

/// Tips whose angle from the motor's line is known.
pub(crate) fn coupled_tips(campaign: &Campaign) -> Vec<usize> {
    let tips = &campaign.channels.tips;
    (0..tips.len())
        .filter(|&i| tips[i].calibrated && tips[i].quantity != TipQuantity::Acceleration)
        .collect()
}

/// What a campaign's motor equation has beside inertia, viscous and dry friction.
///
/// A row is `[∫ẅθ, −∫ẇθ, ∫w, ∫w(θ_m − θ_i).., ∫w·sin θ, ∫w·cos θ, ∫wτ]`, sine and cosine where a load has gravity.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct MotorColumns {
    /// [`coupled_tips`].
    pub(crate) tips: Vec<usize>,
    /// Whether gravity acts.
    pub(crate) gravity: bool,
}

impl MotorColumns {
    pub(crate) fn of(campaign: &Campaign) -> Self {
        Self { tips: coupled_tips(campaign), gravity: campaign.gravity }
    }

    /// Column of coupled tip number `place`.
    pub(crate) fn tip(place: usize) -> usize {
        FIRST_TIP + place
    }

    /// Columns before the right side.
    pub(crate) fn count(&self) -> usize {
        FIRST_TIP + self.tips.len() + if self.gravity { 2 } else { 0 }
    }

    /// J, V, C, offset, κ_i and g_s, g_c: `dry` is the term of C.
    pub(crate) fn terms(&self, dry: Term) -> Vec<Term> {
        let mut terms = vec![Term::Plain(INERTIA), Term::Plain(VISCOUS), dry, Term::Plain(DRY)];
        terms.extend((FIRST_TIP..self.count()).map(Term::Plain));
        terms
    }

    /// Places of the couplings among these terms.
    pub(crate) fn couplings(&self) -> std::ops::Range<usize> {
        FIRST_COUPLING..FIRST_COUPLING + self.tips.len()
    }

    /// Places of g_s and g_c among these terms.
    pub(crate) fn gravity_places(&self) -> Option<[usize; 2]> {
        let first = self.couplings().end;
        self.gravity.then_some([first, first + 1])
    }
}
