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
/// A row is `[∫ẅθ, −∫ẇθ, ∫w, ∫w(θ_m − θ_i).., ∫w·sin θ, ∫w·cos θ, ∫w⁗θ, ∫ẅτ, ∫ẇτ, −∫w⃛θ, ∫wτ]`, sine and cosine where a
/// load has gravity, the four before the last with a mode that no tip shows.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct MotorColumns {
    /// [`coupled_tips`].
    pub(crate) tips: Vec<usize>,
    /// Whether gravity acts.
    pub(crate) gravity: bool,
    /// Whether there are columns of a mode that no tip shows.
    pub(crate) mode: bool,
}

/// Columns of a mode that no tip shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct ModeColumns {
    /// `∫w⁗θ`.
    pub(crate) fourth: usize,
    /// `∫ẅτ`.
    pub(crate) torque_twice: usize,
    /// `∫ẇτ`.
    pub(crate) torque_once: usize,
    /// `−∫w⃛θ`.
    pub(crate) third: usize,
}

impl ModeColumns {
    const COUNT: usize = 4;

    fn from(first: usize) -> Self {
        let [fourth, torque_twice, torque_once, third] = [0, 1, 2, 3].map(|k| first + k);
        Self { fourth, torque_twice, torque_once, third }
    }
}

impl MotorColumns {
    pub(crate) fn of(campaign: &Campaign) -> Self {
        Self { tips: coupled_tips(campaign), gravity: campaign.gravity, mode: false }
    }

    /// Column of coupled tip number `place`.
    pub(crate) fn tip(place: usize) -> usize {
        FIRST_TIP + place
    }

    /// Columns before the right side.
    pub(crate) fn count(&self) -> usize {
        self.of_mode().map_or(self.before_mode(), |mode| mode.fourth + ModeColumns::COUNT)
    }

    fn before_mode(&self) -> usize {
        FIRST_TIP + self.tips.len() + if self.gravity { 2 } else { 0 }
    }

    /// The columns of a mode that no tip shows.
    pub(crate) fn of_mode(&self) -> Option<ModeColumns> {
        self.mode.then(|| ModeColumns::from(self.before_mode()))
    }

    /// J, V, CF, offset, κ_i, g_s and g_c, and those of a mode: `dry` is the term of CF.
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

    /// Places of the terms of a mode that no tip shows among these.
    pub(crate) fn mode_places(&self) -> Option<ModeColumns> {
        let first = self.couplings().end + if self.gravity { 2 } else { 0 };
        self.mode.then(|| ModeColumns::from(first))
    }
}
