//! The arm's equations as matrices, with their derivatives by each parameter.

use super::arm::ModalArm;
use super::parameter::{Enters, Parameter};
use crate::number::{Dual, Number};

/// `ẋ = A·x + b·τ` of the state `[θ, θ̇, ψ_1, ψ̇_1, …]`, with dA/dp and db/dp of every parameter that
/// enters them.
#[derive(Debug, Clone)]
pub(super) struct Rates<const D: usize> {
    pub(super) a: [[f64; D]; D],
    pub(super) b: [f64; D],
    pub(super) by_parameter: Vec<([[f64; D]; D], [f64; D])>,
    /// Bound on the rates \[1/s\], for steps of a series.
    pub(super) rate_per_s: f64,
}

/// The three phases of a joint: forward, backward, stuck.
#[derive(Debug, Clone)]
pub(super) struct Phases<const D: usize> {
    pub(super) slip: [Rates<D>; 2],
    pub(super) stick: Rates<D>,
}

/// Numbers of an arm that enter its matrices.
struct Entries<N> {
    inertia: N,
    viscous: N,
    /// ω, k, d, a of each mode.
    modes: Vec<[N; 4]>,
}

impl<const D: usize> Phases<D> {
    /// `parameters` are those that the derivatives are wanted of; only those that enter matrices
    /// count, in their order.
    pub(super) fn new(arm: &ModalArm, parameters: &[Parameter]) -> Self {
        let inside: Vec<Parameter> =
            parameters.iter().copied().filter(|p| p.enters() == Enters::Matrices).collect();
        let rates = |direction: usize, stuck: bool| {
            let value = matrices::<f64, D>(&entries(arm, direction, None), stuck);
            let by_parameter = inside
                .iter()
                .map(|p| {
                    let (a, b) =
                        matrices::<Dual<f64>, D>(&entries(arm, direction, Some(*p)), stuck);
                    (a.map(|row| row.map(|z| z.slope)), b.map(|z| z.slope))
                })
                .collect();
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
    Entries {
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
        a[speed][speed] = -(within + grounded);
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
    let dampers = |m: &super::arm::Oscillator| {
        let on_motor = m.stiffness_nm_per_rad * m.within_per_s
            / (m.omega_rad_s * m.omega_rad_s * arm.inertia_kg_m2);
        m.within_per_s.abs() + m.grounded_per_s.abs() + on_motor.abs()
    };
    let viscous = arm.viscous_nm_s_per_rad.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    (squares + pinned).sqrt()
        + viscous / arm.inertia_kg_m2
        + arm.modes.iter().map(dampers).sum::<f64>()
}
