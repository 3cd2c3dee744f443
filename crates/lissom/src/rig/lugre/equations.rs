//! The arm on bristles as a system of first order, in the form that `diffsol` takes.

use diffsol::{
    ConstantOp, DenseMatrix, NalgebraContext, NalgebraMat, NalgebraVec, NonLinearOp,
    NonLinearOpJacobian, OdeEquations, OdeEquationsRef, Op, UnitCallable, Vector, VectorCommon,
};

use crate::arm::Arm;
use crate::drive::LuGre;

pub(super) type M = NalgebraMat<f64>;
pub(super) type V = NalgebraVec<f64>;

/// `ẋ = f(x)` of the arm's state and z.
#[derive(Debug, Clone)]
pub(super) struct Equations {
    arm: Arm,
    pub(super) law: LuGre,
    pub(super) torque_nm: f64,
    /// ∂ẋ/∂x without friction, by columns.
    linear: Vec<f64>,
    /// Where it starts.
    start: Vec<f64>,
    context: NalgebraContext,
}

impl Equations {
    pub(super) fn new(arm: Arm, law: LuGre, start: Vec<f64>) -> Self {
        let len = arm.state_len();
        let mut linear = vec![0.0; len * len];
        let mut unit = vec![0.0; len];
        for (k, column) in linear.chunks_exact_mut(len).enumerate() {
            unit[k] = 1.0;
            arm.derivative_slipping(&unit, column);
            unit[k] = 0.0;
        }
        let context = NalgebraContext::default();
        Self { arm, law, torque_nm: 0.0, linear, start, context }
    }

    pub(super) fn derivative(&self, x: &[f64], out: &mut [f64]) {
        let len = x.len() - 1;
        let (v, z) = (x[1], x[len]);
        self.arm.derivative_slipping(&x[..len], &mut out[..len]);
        out[1] += (self.torque_nm - self.law.torque_nm(v, z)) / self.arm.motor.inertia_kg_m2;
        out[len] = self.law.bristle_rate(v, z);
    }

    /// ∂θ̈_m/∂v, ∂θ̈_m/∂z of friction alone, ∂ż/∂v and ∂ż/∂z.
    fn slopes(&self, x: &[f64]) -> [f64; 4] {
        let (s0, s1) = (self.law.stiffness_nm_per_rad(), self.law.damping_nm_s_per_rad());
        let inertia = self.arm.motor.inertia_kg_m2;
        let (by_v, by_z) = self.law.bristle_slopes(x[1], x[x.len() - 1]);
        [-s1 * by_v / inertia, -(s0 + s1 * by_z) / inertia, by_v, by_z]
    }
}

impl Op for Equations {
    type T = f64;
    type V = V;
    type M = M;
    type C = NalgebraContext;
    fn context(&self) -> &NalgebraContext {
        &self.context
    }
    fn nstates(&self) -> usize {
        self.start.len()
    }
    fn nout(&self) -> usize {
        self.start.len()
    }
    // The torque is set in place.
    fn nparams(&self) -> usize {
        0
    }
}

impl NonLinearOp for Equations {
    fn call_inplace(&self, x: &V, _t: f64, out: &mut V) {
        self.derivative(x.inner().as_slice(), out.inner_mut().as_mut_slice());
    }
}

impl NonLinearOpJacobian for Equations {
    fn jac_mul_inplace(&self, x: &V, _t: f64, w: &V, out: &mut V) {
        let (w, out) = (w.inner().as_slice(), out.inner_mut().as_mut_slice());
        let len = w.len() - 1;
        let [turn_v, turn_z, bend_v, bend_z] = self.slopes(x.inner().as_slice());
        self.arm.derivative_slipping(&w[..len], &mut out[..len]);
        out[1] += turn_v * w[1] + turn_z * w[len];
        out[len] = bend_v * w[1] + bend_z * w[len];
    }

    fn jacobian_inplace(&self, x: &V, _t: f64, out: &mut M) {
        let len = self.start.len() - 1;
        for (c, column) in self.linear.chunks_exact(len).enumerate() {
            for (r, entry) in column.iter().enumerate() {
                out.set_index(r, c, *entry);
            }
        }
        let [turn_v, turn_z, bend_v, bend_z] = self.slopes(x.inner().as_slice());
        out.set_index(1, 1, self.linear[len + 1] + turn_v);
        out.set_index(1, len, turn_z);
        out.set_index(len, 1, bend_v);
        out.set_index(len, len, bend_z);
    }
}

impl ConstantOp for &Equations {
    fn call_inplace(&self, _t: f64, out: &mut V) {
        out.inner_mut().copy_from_slice(&self.start);
    }
}

impl<'a> OdeEquationsRef<'a> for Equations {
    type Rhs = &'a Self;
    type Init = &'a Self;
    type Mass = UnitCallable<M>;
    type Root = UnitCallable<M>;
    type Out = UnitCallable<M>;
    type Reset = UnitCallable<M>;
}

impl OdeEquations for Equations {
    fn rhs(&self) -> &Self {
        self
    }
    fn init(&self) -> &Self {
        self
    }
    fn mass(&self) -> Option<UnitCallable<M>> {
        None
    }
    fn set_params(&mut self, _none: &V) {}
    fn get_params(&self, _none: &mut V) {}
}
