//! A flexible mode that no tip measures, from the motor's equation.

use nalgebra::{DVector, Matrix3, Vector3};

use crate::identify::estimate::Estimate;
use crate::identify::methods::friction_law::Moved;
use crate::identify::methods::regression::left_torque::LeftTorque;
use crate::identify::methods::regression::mode_window::ModeShape;
use crate::identify::methods::regression::motor_columns::{
    DRY, ModeColumns, MotorColumns, PLACE_INERTIA, PLACE_VISCOUS,
};
use crate::identify::methods::regression::normal::{Cluster, Solution, Term, solve};
use crate::identify::methods::regression::scan::{Candidate, Scan};
use crate::identify::methods::regression::sums_by_length::SumsByLength;
use crate::identify::methods::regression::thresholds::{
    FEW_PHASES, HIDDEN_MODE_DAMPED, HIDDEN_MODE_SHARE, HIDDEN_MODE_SURE,
};
use crate::identify::thresholds::MODE_DAMPING_LEAST;

/// Share of inertia before the spring if the logs do not identify it: mean and standard deviation of a uniform distribution.
const USUAL_SHARE: Estimate = Estimate { value: 0.5, std: 0.29 };
/// Damping ratio if the logs do not identify it.
const USUAL_DAMPING_RATIO: Estimate = Estimate { value: 0.02, std: 0.02 };

/// A part of the inertia behind a spring, as the motor's motion alone shows it.
///
/// With the inertias J₁ of the motor and J₂ behind a spring k with damper d, J = J₁ + J₂, ω² = k/J₂ and c = d/k, the
/// equation of the motor becomes
///
/// `τ + c·τ̇ + τ̈/ω² = (J + c·V)·θ̈ + V·θ̇ + (c·J + V/ω²)·θ⃛ + (J₁/ω²)·θ⁗` plus dry friction,
///
/// which is constant in a slip phase. All terms are linear in the unknowns. The derivatives are taken of the windows of
/// the regression.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HiddenMode {
    /// Frequency ω with the motor clamped \[rad/s\].
    pub omega_rad_s: Estimate,
    /// Damping ratio c·ω/2 \[1\].
    pub damping_ratio: Estimate,
    /// Share of the motor's inertia in the total, J₁/J \[1\].
    pub inertia_share: Estimate,
    /// Changes of inertia, viscous and Coulomb friction by this mode.
    pub moves: [Moved; 3],
    /// Residual with the mode divided by the residual without it, in windows of the length `window_s` \[1\].
    pub residual_ratio: f64,
    /// Length of the windows in which its frequency is best known \[s\].
    pub window_s: f64,
}

impl HiddenMode {
    pub(crate) fn shape(&self) -> ModeShape {
        ModeShape {
            omega_rad_s: self.omega_rad_s.value,
            damping_s: 2.0 * self.damping_ratio.value / self.omega_rad_s.value,
            inertia_share: self.inertia_share.value,
        }
    }
}

/// A mode in windows of one length.
#[derive(Debug, Clone)]
pub(super) struct ShownMode {
    pub(super) window_s: f64,
    pub(super) shape: ModeShape,
    /// Of frequency, damping and share.
    covariance: Matrix3<f64>,
    pub(super) residual_ratio: f64,
}

/// Computes ω, c and J₁/J from the terms; `None` if no mode has such terms.
fn shape_of(value: &DVector<f64>, places: ModeColumns) -> Option<ModeShape> {
    let omega_squared = -1.0 / value[places.torque_twice];
    let (with_damping, viscous) = (value[PLACE_INERTIA], value[PLACE_VISCOUS]);
    let damped = value[places.third] - viscous / omega_squared;
    // c·(J − c·V) = damped, in which c·V is small.
    let damping_s = damped / (with_damping - damped / with_damping * viscous);
    let inertia = with_damping - damping_s * viscous;
    (omega_squared > 0.0 && inertia > 0.0).then(|| ModeShape {
        omega_rad_s: omega_squared.sqrt(),
        damping_s,
        inertia_share: value[places.fourth] * omega_squared / inertia,
    })
}

fn vector(shape: ModeShape) -> Vector3<f64> {
    Vector3::new(shape.omega_rad_s, shape.damping_s, shape.inertia_share)
}

impl ShownMode {
    /// Solves the sums `with` the columns of a mode, beside the solution `without` these columns. `None` if no mode has such terms.
    pub(super) fn of(
        with: &[Cluster],
        columns: &MotorColumns,
        without: &Solution,
        window_s: f64,
    ) -> Option<Self> {
        let places = columns.mode_places()?;
        let solution = solve(with, &columns.terms(Term::Signed(DRY)))?;
        let residual_ratio = solution.relative_residual / without.relative_residual;
        if solution.inseparable.iter().any(|lost| *lost) {
            return None;
        }
        let shape = shape_of(&solution.value, places)?;
        let covariance = covariance(&solution, places, shape);
        Some(Self { window_s, shape, covariance, residual_ratio })
    }

    fn frequency_std(&self) -> f64 {
        self.covariance[(0, 0)].max(0.0).sqrt()
    }

    /// Standard error of the frequency, relative.
    pub(super) fn uncertainty(&self) -> f64 {
        self.frequency_std() / self.shape.omega_rad_s
    }

    /// Adds half of the difference to the mode at a `neighbour` window length to the covariance; `None` if its frequency is then
    /// not certain.
    pub(super) fn beside(&self, neighbour: &Self) -> Option<Self> {
        let half = 0.5 * (vector(self.shape) - vector(neighbour.shape));
        let covariance = self.covariance + half * half.transpose();
        let found = Self { covariance, ..self.clone() };
        (found.uncertainty() < 1.0 / HIDDEN_MODE_SURE).then_some(found)
    }

    /// Replaces a damping or a share of inertia that is not identified, or not possible, by usual values.
    fn possible(mut self) -> Self {
        let ModeShape { omega_rad_s, damping_s, inertia_share } = self.shape;
        let std = self.covariance.diagonal().map(|v| v.max(0.0).sqrt());
        let to_ratio = 0.5 * omega_rad_s;
        let damping_ratio = damping_s * to_ratio;
        let [share_told, damping_told] = [
            (HIDDEN_MODE_SHARE..1.0 - HIDDEN_MODE_SHARE).contains(&inertia_share)
                && std[2] < USUAL_SHARE.std,
            (MODE_DAMPING_LEAST..HIDDEN_MODE_DAMPED).contains(&damping_ratio)
                && std[1] * to_ratio < HIDDEN_MODE_DAMPED,
        ];
        if !share_told {
            self.shape.inertia_share = USUAL_SHARE.value;
            self.take_usual(2, USUAL_SHARE.std);
        }
        if !damping_told {
            self.shape.damping_s = USUAL_DAMPING_RATIO.value / to_ratio;
            self.take_usual(1, USUAL_DAMPING_RATIO.std / to_ratio);
        }
        self
    }

    /// Sets a standard deviation without correlation to the others.
    fn take_usual(&mut self, place: usize, std: f64) {
        self.covariance.row_mut(place).fill(0.0);
        self.covariance.column_mut(place).fill(0.0);
        self.covariance[(place, place)] = std * std;
    }

    /// Returns three modes, each one standard error away along a principal axis of the covariance.
    pub(super) fn shapes_beside(&self) -> Vec<ModeShape> {
        let eigen = self.covariance.symmetric_eigen();
        let directions = eigen.eigenvectors.column_iter().zip(eigen.eigenvalues.iter());
        let moved = directions.map(|(direction, variance)| {
            let at = vector(self.shape) + direction * variance.max(0.0).sqrt();
            ModeShape { omega_rad_s: at[0], damping_s: at[1], inertia_share: at[2] }
        });
        moved.collect()
    }

    /// The public description, with the changes of the estimates.
    pub(super) fn report(&self, moves: [Moved; 3]) -> HiddenMode {
        let ModeShape { omega_rad_s, damping_s, inertia_share } = self.shape;
        let of = |value: f64, slopes: Vector3<f64>| {
            let variance = slopes.dot(&(self.covariance * slopes));
            Estimate { value, std: variance.max(0.0).sqrt() }
        };
        let ratio = Vector3::new(0.5 * damping_s, 0.5 * omega_rad_s, 0.0);
        HiddenMode {
            omega_rad_s: of(omega_rad_s, Vector3::x()),
            damping_ratio: of(0.5 * damping_s * omega_rad_s, ratio),
            inertia_share: of(inertia_share, Vector3::z()),
            moves,
            residual_ratio: self.residual_ratio,
            window_s: self.window_s,
        }
    }
}

/// Covariance of a shape, to the first order.
fn covariance(solution: &Solution, places: ModeColumns, shape: ModeShape) -> Matrix3<f64> {
    let moved = [PLACE_INERTIA, PLACE_VISCOUS, places.fourth, places.torque_twice, places.third];
    let slope = |place: usize| -> Vector3<f64> {
        let step = 0.5 * solution.covariance[(place, place)].max(0.0).sqrt();
        let mut value = solution.value.clone();
        value[place] += step;
        match shape_of(&value, places).filter(|_| step > 0.0) {
            Some(other) => (vector(other) - vector(shape)) / step,
            None => Vector3::zeros(),
        }
    };
    let slopes = moved.map(slope);
    let mut sum = Matrix3::zeros();
    for (a, of_a) in moved.iter().zip(&slopes) {
        for (b, of_b) in moved.iter().zip(&slopes) {
            sum += of_a * of_b.transpose() * solution.covariance[(*a, *b)];
        }
    }
    sum
}

/// Searches for a mode that no tip measures, in the window lengths that were scanned without one, where their residual is not
/// noise. Returns the mode at the length where its frequency has the smallest relative standard error.
pub(super) fn shown_mode(without: &SumsByLength<'_>, scanned: &Scan) -> Option<ShownMode> {
    let rigid = without.equation;
    // With tips the modes are theirs; a few strokes are too much alike.
    let length = scanned.candidates[scanned.chosen].window_s;
    if !rigid.columns.tips.is_empty() || rigid.phases(length) < FEW_PHASES {
        return None;
    }
    let sought = rigid.with_mode_columns();
    let terms = rigid.columns.terms(Term::Signed(DRY));
    let shown = |candidate: &Candidate| {
        let length = candidate.window_s;
        let solution = without.solved(length, &terms)?;
        if LeftTorque::of(&without.clusters(length), &terms, &solution).is_noise() {
            return None;
        }
        ShownMode::of(&sought.clusters(length), &sought.columns, &solution, length)
    };
    let by_length: Vec<Option<ShownMode>> = scanned.candidates.iter().map(shown).collect();
    let beside = |(k, mode): (usize, &Option<ShownMode>)| {
        let mode = mode.as_ref()?;
        let neighbours = [k.checked_sub(1), Some(k + 1)].into_iter().flatten();
        let neighbours = neighbours.filter_map(|k| by_length.get(k)?.as_ref());
        let beside = neighbours.filter_map(|neighbour| mode.beside(neighbour));
        beside.min_by(|a, b| a.uncertainty().total_cmp(&b.uncertainty()))
    };
    let modes = by_length.iter().enumerate().filter_map(beside);
    let best = modes.min_by(|a, b| a.uncertainty().total_cmp(&b.uncertainty()))?;
    Some(best.possible())
}
