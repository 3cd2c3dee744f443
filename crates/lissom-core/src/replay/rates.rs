//! The arm's equations as matrices, with their derivatives by each parameter.

use super::lanes::{LANES, MatrixPack, Pack};
use super::modal_arm::ModalArm;
use super::parameter::{Enters, Parameter};
use crate::number::{Dual, Number};

/// `ẋ = A·x + b·τ` of the state `[θ, θ̇, ψ_1, ψ̇_1, …]`, with dA/dp and db/dp of every parameter.
#[derive(Debug, Clone)]
pub(super) struct Rates<const D: usize> {
    pub(super) a: [[f64; D]; D],
    pub(super) b: [f64; D],
    /// By [`LANES`] parameters at a time; zero of those that do not enter.
    pub(super) by_parameter: Vec<(MatrixPack<D>, Pack<D>)>,
    /// Bound on the rates \[1/s\], for steps of a series.
    pub(super) rate_per_s: f64,
}

/// The three phases of a joint: forward, backward, stuck.
#[derive(Debug, Clone)]
pub(super) struct Phases<const D: usize> {
    pub(super) slip: [Rates<D>; 2],
    pub(super) stick: Rates<D>,
}

impl<const D: usize> Rates<D> {
    /// dA/dp of parameter `k`, one row of it, times `x`.
    pub(super) fn row_by(&self, k: usize, row: usize, x: &[f64; D]) -> f64 {
        let (a, _) = &self.by_parameter[k / LANES];
        a[row].iter().zip(x).map(|(lanes, x)| lanes[k % LANES] * x).sum()
    }

    /// One entry of db/dp of parameter `k`.
    pub(super) fn push_by(&self, k: usize, row: usize) -> f64 {
        self.by_parameter[k / LANES].1[row][k % LANES]
    }
}

/// Puts the slopes of A and b into one lane.
fn put<const D: usize>(
    (a, b): &mut (MatrixPack<D>, Pack<D>),
    lane: usize,
    da: &[[Dual<f64>; D]; D],
    db: &[Dual<f64>; D],
) {
    for (lanes, z) in a.iter_mut().flatten().zip(da.iter().flatten()) {
        lanes[lane] = z.slope;
    }
    for (lanes, z) in b.iter_mut().zip(db) {
        lanes[lane] = z.slope;
    }
}

/// Numbers of an arm that enter its matrices.
struct Entries<N> {
    inertia: N,
    viscous: N,
    /// ω, k, d, a of each mode.
    modes: Vec<[N; 4]>,
    /// r⁻¹·diag(c)·r, where there are dampers at points.
    points: Option<Vec<Vec<N>>>,
}

impl<const D: usize> Phases<D> {
    /// `parameters` are those that the derivatives are wanted of.
    pub(super) fn new(arm: &ModalArm, parameters: &[Parameter]) -> Self {
        let rates = |direction: usize, stuck: bool| {
            let value = matrices::<f64, D>(&entries(arm, direction, None), stuck);
            let zero = ([[[0.0; LANES]; D]; D], [[0.0; LANES]; D]);
            let mut by_parameter = vec![zero; parameters.len().div_ceil(LANES)];
            for (k, p) in parameters.iter().enumerate() {
                if p.enters(arm) == Enters::Matrices {
                    let (a, b) =
                        matrices::<Dual<f64>, D>(&entries(arm, direction, Some(*p)), stuck);
                    put(&mut by_parameter[k / LANES], k % LANES, &a, &b);
                }
            }
            Rates { a: value.0, b: value.1, by_parameter, rate_per_s: rate(arm) }
        };
        Self { slip: [rates(0, false), rates(1, false)], stick: rates(0, true) }
    }
}

/// The arm's numbers, with a slope of one in that of `variable`.
fn entries<N: Number + Lift>(
    arm: &ModalArm,
    direction: usize,
    variable: Option<Parameter>,
) -> Entries<N> {
    let lift = |value: f64, p: Parameter, slope: f64| {
        N::lift(value, if variable == Some(p) { slope } else { 0.0 })
    };
    let sign = if direction == 0 { 1.0 } else { -1.0 };
    let viscous = arm.viscous_nm_s_per_rad[direction];
    let viscous = match variable {
        Some(Parameter::ViscousDifference) => lift(viscous, Parameter::ViscousDifference, sign),
        _ => lift(viscous, Parameter::Viscous, 1.0),
    };
    let modes = arm.modes.iter().enumerate().map(|(j, m)| {
        [
            lift(m.omega_rad_s, Parameter::Frequency(j), 1.0),
            lift(m.stiffness_nm_per_rad, Parameter::Stiffness(j), 1.0),
            lift(m.within_per_s, Parameter::DampingWithin(j), 1.0),
            lift(m.grounded_per_s, Parameter::DampingGrounded(j), 1.0),
        ]
    });
    let dampers = arm.at_points_per_s.iter().enumerate();
    let dampers: Vec<N> =
        dampers.map(|(i, c)| lift(*c, Parameter::DampingAtPoint(i), 1.0)).collect();
    let shape = |i: usize, j: usize| lift(arm.shapes[i][j], Parameter::Shape(i, j), 1.0);
    let points = (!dampers.is_empty() && dampers.len() == arm.modes.len()).then(|| {
        let n = dampers.len();
        let shapes: Vec<Vec<N>> = (0..n).map(|i| (0..n).map(|j| shape(i, j)).collect()).collect();
        let damped = shapes.iter().zip(&dampers);
        let damped = damped.map(|(row, c)| row.iter().map(|r| *r * *c).collect()).collect();
        solved(shapes, damped)
    });
    Entries {
        points,
        inertia: lift(arm.inertia_kg_m2, Parameter::Inertia, 1.0),
        viscous,
        modes: modes.collect(),
    }
}

/// Numbers that may carry a slope.
trait Lift {
    fn lift(value: f64, slope: f64) -> Self;
}
impl Lift for f64 {
    fn lift(value: f64, _slope: f64) -> Self {
        value
    }
}
impl Lift for Dual<f64> {
    fn lift(value: f64, slope: f64) -> Self {
        Self { value, slope }
    }
}

/// `left⁻¹·right`, by Gauss's elimination with pivots by rows.
fn solved<N: Number>(mut left: Vec<Vec<N>>, mut right: Vec<Vec<N>>) -> Vec<Vec<N>> {
    let n = left.len();
    for k in 0..n {
        let size = |i: usize| left[i][k].sign_part().abs();
        let pivot = (k..n).max_by(|a, b| size(*a).total_cmp(&size(*b))).unwrap_or(k);
        left.swap(k, pivot);
        right.swap(k, pivot);
        for i in (0..n).filter(|i| *i != k) {
            let factor = left[i][k] / left[k][k];
            for j in 0..n {
                let (l, r) = (left[k][j], right[k][j]);
                left[i][j] = left[i][j] - factor * l;
                right[i][j] = right[i][j] - factor * r;
            }
        }
    }
    for (row, diagonal) in right.iter_mut().zip(&left).enumerate().map(|(k, (r, l))| (r, l[k])) {
        for v in row {
            *v = *v / diagonal;
        }
    }
    right
}

/// A and b; a stuck motor's two rows are zero.
fn matrices<N: Number, const D: usize>(e: &Entries<N>, stuck: bool) -> ([[N; D]; D], [N; D]) {
    let zero = N::real(0.0);
    let (mut a, mut b) = ([[zero; D]; D], [zero; D]);
    for (j, &[omega, stiffness, within, grounded]) in e.modes.iter().enumerate() {
        let (angle, speed) = (2 + 2 * j, 3 + 2 * j);
        let square = omega * omega;
        a[angle][speed] = N::real(1.0);
        a[speed][0] = square;
        a[speed][1] = within;
        a[speed][angle] = -square;
        a[speed][speed] = a[speed][speed] - (within + grounded);
        for (l, damper) in e.points.iter().flat_map(|p| p[j].iter().enumerate()) {
            a[speed][3 + 2 * l] = a[speed][3 + 2 * l] - *damper;
        }
        if !stuck {
            let spring = stiffness / e.inertia;
            let damper = spring * within / square;
            a[1][0] = a[1][0] - spring;
            a[1][1] = a[1][1] - damper;
            a[1][angle] = spring;
            a[1][speed] = damper;
        }
    }
    if !stuck {
        a[0][1] = N::real(1.0);
        a[1][1] = a[1][1] - e.viscous / e.inertia;
        b[1] = N::real(1.0) / e.inertia;
    }
    (a, b)
}

/// No mode is faster than the root of all squares together, and no damper adds more than its rate.
fn rate(arm: &ModalArm) -> f64 {
    let squares: f64 = arm.modes.iter().map(|m| m.omega_rad_s * m.omega_rad_s).sum();
    let pinned = arm.coupling_nm_per_rad().abs() / arm.inertia_kg_m2;
    let dampers = |m: &super::modal_arm::Oscillator| {
        let on_motor = m.stiffness_nm_per_rad * m.within_per_s
            / (m.omega_rad_s * m.omega_rad_s * arm.inertia_kg_m2);
        m.within_per_s.abs() + m.grounded_per_s.abs() + on_motor.abs()
    };
    let points: f64 = arm.at_points_per_s.iter().map(|c| c.abs()).sum();
    let viscous = arm.viscous_nm_s_per_rad.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    (squares + pinned).sqrt()
        + viscous / arm.inertia_kg_m2
        + arm.modes.iter().map(dampers).sum::<f64>()
        + points
}
