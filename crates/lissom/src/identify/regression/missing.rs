//! Whether the motor's equation lacks a term: one is added at a time, and the residual decides.

use super::normal::{Cluster, Solution, Term, solve};

/// A term is missing where it stands this many deviations from zero…
const DEVIATIONS: f64 = 4.0;
/// …and leaves at most this share of the residual: a term that chance makes significant leaves
/// nearly all of it.
const RESIDUAL: f64 = 0.9;

/// What the equation may lack.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MissingKind {
    /// The command acts later: `τ(t − Δ)`, or lags behind by Δ.
    Delay,
    /// A torque that grows with position: gravity, a spring, coarse cogging, a wrongly scaled tip.
    Position,
    /// Friction that falls with speed: `e^{−|v|/v̄}` of the Stribeck kind, or presliding.
    Stribeck,
    /// Damping within the beam, in proportion to its stiffness: a torque by the rate of what is bent.
    BeamDamping,
}

/// A term that the data call for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MissingTerm {
    /// Which.
    pub kind: MissingKind,
    /// Its coefficient: delay \[s\], stiffness \[N·m/rad\], friction at rest beyond the constant
    /// \[N·m\] (linear axes: N/m, N), time of the beam's damping \[s\].
    pub value: f64,
    /// How many deviations from zero.
    pub deviations: f64,
    /// Residual beside that of the equation without it, as a ratio.
    pub residual_ratio: f64,
}

/// The term whose addition explains most, if it is called for. `first` is the column of the first
/// of the extra columns, in the order of [`MissingKind`]; damping of a beam is tried where `tips` show one.
pub(super) fn missing_term(
    clusters: &[Cluster],
    terms: &[Term],
    without: &Solution,
    first: usize,
    tips: usize,
) -> Option<MissingTerm> {
    let kinds = [
        MissingKind::Delay,
        MissingKind::Position,
        MissingKind::Stribeck,
        MissingKind::BeamDamping,
    ];
    let kinds = &kinds[..if tips > 0 { 4 } else { 3 }];
    let tried = kinds.iter().copied().enumerate().filter_map(|(i, kind)| {
        let mut with = terms.to_vec();
        with.push(match kind {
            MissingKind::Stribeck => Term::Signed(first + i),
            _ => Term::Plain(first + i),
        });
        let solution = solve(clusters, &with)?;
        let last = with.len() - 1;
        let std = solution.covariance[(last, last)].max(0.0).sqrt();
        let value = solution.value[last];
        let called_for = !solution.inseparable[last]
            && value.abs() > DEVIATIONS * std
            && solution.relative_residual < RESIDUAL * without.relative_residual;
        called_for.then(|| MissingTerm {
            kind,
            // ∫wτ(t) = ∫w·(equation) − Δ∫ẇτ for τ that acts Δ later.
            value: if kind == MissingKind::Delay { -value } else { value },
            deviations: value.abs() / std,
            residual_ratio: solution.relative_residual / without.relative_residual,
        })
    });
    tried.min_by(|a, b| a.residual_ratio.total_cmp(&b.residual_ratio))
}
