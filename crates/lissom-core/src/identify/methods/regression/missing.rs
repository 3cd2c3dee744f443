//! Tests whether the motor's equation lacks a term: terms are added one at a time, and the residuals are compared.

use crate::identify::methods::regression::left_torque::LeftTorque;
use crate::identify::methods::regression::motor_columns::{
    MotorColumns, PLACE_COULOMB, PLACE_INERTIA, PLACE_VISCOUS,
};
use crate::identify::methods::regression::normal::{Cluster, Solution, Term, solve};
use crate::identify::methods::regression::thresholds::{
    GRAVITY_TRAVEL_RAD, LAG_EXPLAINS, MISSING_MOVES, MISSING_ONE_SIGN, MISSING_SURE, NOISE_ALONE,
    NOTHING_MISSING,
};
use crate::identify::thresholds::{CLEARLY_PRESENT, PRESENT, RESIDUAL_FALLS_TO};
use crate::record::{Axis, Campaign, Run};

/// A term that the equation may lack.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MissingKind {
    /// A delay Δ: the command acts later, `τ(t − Δ)`, or lags by Δ.
    Delay,
    /// A torque in proportion to position: gravity, a spring, coarse cogging, or a tip sensor with a wrong scale.
    Position,
    /// Friction that falls with speed, `e^{−|v|/v̄}`: the Stribeck effect, or presliding.
    Stribeck,
    /// Damping within the beam in proportion to its stiffness: a torque by the rate of bending.
    BeamDamping,
    /// A torque constant that differs by the sign of the command, for example of an amplifier.
    CommandBySign,
    /// Coulomb friction that changes from the first sample of the campaign to the last.
    CoulombDrift,
    /// Viscous friction that changes over the campaign, for example of a joint that warms up.
    ViscousDrift,
    /// An unbalanced load: `g_s·sin θ + g_c·cos θ`.
    Gravity,
}

impl MissingKind {
    /// In the order of their columns.
    const ALL: [Self; 8] = [
        Self::Delay,
        Self::Position,
        Self::Stribeck,
        Self::BeamDamping,
        Self::CommandBySign,
        Self::CoulombDrift,
        Self::ViscousDrift,
        Self::Gravity,
    ];
    /// How many columns they need: gravity has two.
    pub(super) const COLUMNS: usize = Self::ALL.len() + 1;

    /// Place of its first column among those that are tried.
    pub(super) fn column(self) -> usize {
        let before = Self::ALL.iter().take_while(|kind| **kind != self);
        before.map(|kind| kind.terms(0).len()).sum()
    }

    /// Its terms, `column` the first that it needs.
    fn terms(self, column: usize) -> Vec<Term> {
        match self {
            Self::Stribeck | Self::CoulombDrift => vec![Term::Signed(column)],
            Self::Gravity => vec![Term::Plain(column), Term::Plain(column + 1)],
            _ => vec![Term::Plain(column)],
        }
    }

    /// The terms of each, their columns after those of `columns`.
    pub(super) fn candidates(columns: &MotorColumns) -> impl Iterator<Item = Vec<Term>> {
        let first = columns.count();
        Self::ALL.into_iter().map(move |kind| kind.terms(first + kind.column()))
    }

    /// Whether its column hardly has noise of the sensors in it, which others of the equation then make up for.
    fn is_exact(self) -> bool {
        match self {
            Self::Delay | Self::Stribeck | Self::BeamDamping | Self::ViscousDrift => false,
            Self::Position | Self::CommandBySign | Self::CoulombDrift | Self::Gravity => true,
        }
    }
}

/// A term that the data require.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MissingTerm {
    /// The term.
    pub kind: MissingKind,
    /// Its coefficient: delay \[s\]; stiffness \[N·m/rad or N/m\]; friction at rest beyond the constant \[N·m or N\];
    /// time of the beam's damping \[s\]; half the relative difference of the torque constant for positive and negative
    /// commands \[1\]; change of Coulomb friction \[N·m or N\] or viscous friction \[N·m·s/rad or N·s/m\] from the
    /// beginning of the campaign to its end, with the runs one after the other; m·g·l of gravity \[N·m\].
    pub value: f64,
    /// Changes of the estimates of inertia, viscous and Coulomb friction when the term is added.
    pub moves: [Moved; 3],
    /// Coefficient divided by its standard error \[1\].
    pub standard_errors: f64,
    /// Residual with the term divided by the residual without it \[1\].
    pub residual_ratio: f64,
    /// Length of the windows in which the term is found \[s\].
    pub window_s: f64,
}

impl MissingTerm {
    /// Whether it is more than a part of the noise that the equation leaves: one whose column is not exact takes some of
    /// that.
    pub(super) fn is_beyond(&self, left: &LeftTorque) -> bool {
        left.by_noise < NOISE_ALONE || self.kind.is_exact() || self.kind == MissingKind::Delay
    }
}

/// Change of an estimate when a term is added.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Moved {
    /// Change as a share of the estimate without the term \[1\].
    pub share: f64,
    /// Change in standard errors of the estimate without the term \[1\].
    pub standard_errors: f64,
}

impl Moved {
    /// Of inertia, viscous and Coulomb friction, from a solution to one with further terms.
    pub(super) fn between(without: &Solution, with: &Solution) -> [Self; 3] {
        [PLACE_INERTIA, PLACE_VISCOUS, PLACE_COULOMB].map(|i| {
            let change = with.value[i] - without.value[i];
            let std = without.covariance[(i, i)].max(0.0).sqrt();
            Self { share: change / without.value[i], standard_errors: change / std }
        })
    }
}

/// The term whose addition explains most in windows of a length, if it is called for. The further columns follow those of `columns`, in the
/// order of [`MissingKind`]; damping of a beam is tried where tips show one, gravity where the axis turns far enough.
pub(super) fn missing_term(
    clusters: &[Cluster],
    terms: &[Term],
    without: &Solution,
    (columns, campaign): (&MotorColumns, &Campaign),
    window_s: f64,
) -> Option<MissingTerm> {
    let first = columns.count();
    let rotary = campaign.channels.axis == Axis::Rotary;
    let may_hang = rotary && !columns.gravity && campaign.channels.tips.is_empty() && {
        travel(campaign) > GRAVITY_TRAVEL_RAD
    };
    let kinds = MissingKind::ALL.into_iter().map(|kind| (first + kind.column(), kind));
    let kinds = kinds.filter(|(column, kind)| match kind {
        MissingKind::BeamDamping => !columns.tips.is_empty(),
        MissingKind::CommandBySign => follows_torque(clusters, *column).abs() < MISSING_ONE_SIGN,
        MissingKind::Gravity => may_hang,
        // A spring would be a part of gravity.
        MissingKind::Position => !columns.gravity,
        _ => true,
    });
    let tried = kinds.filter_map(|(column, kind)| {
        let added = kind.terms(column);
        let with: Vec<Term> = terms.iter().chain(&added).copied().collect();
        let solution = solve(clusters, &with)?;
        let known = terms.len();
        let own = solution.covariance.view((known, known), (added.len(), added.len()));
        let amplitudes = solution.value.rows(known, added.len());
        let value = if added.len() == 1 { solution.value[known] } else { amplitudes.norm() };
        let along = amplitudes / value.abs().max(f64::MIN_POSITIVE);
        let std = along.dot(&(own * &along)).max(0.0).sqrt();
        let felt = (0..known).any(|k| {
            let own = without.covariance[(k, k)].max(0.0).sqrt();
            (solution.value[k] - without.value[k]).abs() > PRESENT * own
        });
        let residual_ratio = solution.relative_residual / without.relative_residual;
        let shows = residual_ratio < RESIDUAL_FALLS_TO;
        // No beam gains energy as it bends.
        let possible = kind != MissingKind::BeamDamping || value > 0.0;
        let told = possible && !solution.inseparable[known..].iter().any(|lost| *lost);
        let by_itself = kind.is_exact() || kind == MissingKind::Delay;
        let called_for = told
            && value.abs() > CLEARLY_PRESENT * std
            && (shows || by_itself && felt && value.abs() > MISSING_SURE * std);
        let moves = Moved::between(without, &solution);
        let matters = without.relative_residual > NOTHING_MISSING
            || residual_ratio < LAG_EXPLAINS
                && moves.iter().any(|moved| moved.share.abs() > MISSING_MOVES);
        (called_for && matters).then(|| MissingTerm {
            kind,
            value: match kind {
                // ∫wτ(t) = ∫w·(equation) − Δ∫ẇτ for τ that acts Δ later…
                // …and ∫wτ = ∫w·(equation) − ε∫w|τ| where (1 + ε·sgn τ)·τ acts.
                MissingKind::Delay | MissingKind::CommandBySign => -value,
                _ => value,
            },
            moves,
            standard_errors: value.abs() / std,
            residual_ratio,
            window_s,
        })
    });
    tried.min_by(|a, b| a.residual_ratio.total_cmp(&b.residual_ratio))
}

/// How far the motor turns, over all runs.
fn travel(campaign: &Campaign) -> f64 {
    let angles = campaign.runs.iter().flat_map(Run::motor);
    let (low, high) =
        angles.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(*x), h.max(*x)));
    high - low
}

/// Correlation of a column with the right side, both about zero.
fn follows_torque(clusters: &[Cluster], column: usize) -> f64 {
    let sum = |i: usize, j: usize| clusters.iter().map(|c| c.products[(i, j)]).sum::<f64>();
    let right = clusters.first().map_or(0, |c| c.products.ncols() - 1);
    sum(column, right) / (sum(column, column) * sum(right, right)).sqrt().max(f64::MIN_POSITIVE)
}
