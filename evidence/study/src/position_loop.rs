//! Chooses a position loop for an arm.

use lissom::Matrix;
use lissom::arm::Arm;
use lissom::rig::{Pd, RigError};
use num_complex::Complex64;

use crate::draw::Draw;

/// Largest frequency √(k_p·K/J) of the loop in radians per sample.
const FASTEST: f64 = 0.35;
/// Largest torque that a jump of the motor's reading causes, relative to the peak torque.
const CHATTER: f64 = 0.4;
/// Largest angle that the loop needs to overcome friction, CF/(K·k_p), relative to the largest amplitude.
/// In slow motion the joint then sticks for a share s of the cycle, with
/// `2·CF/(K·k_p) = A·(1 − cos πs)`: 6 % at the lower value, 18 % at the upper.
const DEAD: (f64, f64) = (0.01, 0.08);
/// Time constants of the filter in 1/ω_c; none if the encoder is fine enough.
const FILTERS: [f64; 3] = [0.0, 0.2, 0.5];
/// Gain margin: the loop is stable with gains this many times larger (6 dB).
const GAIN_MARGIN: f64 = 2.0;
/// Loops are slowed by this factor until they fit…
const SLOWER: f64 = 0.8;
/// …but stay at least this many times above the beam's first frequency.
const SLOWEST: f64 = 1.2;

/// Gains of a PD loop and the filter of its derivative.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Gains {
    /// \[A/rad\].
    pub(crate) proportional: f64,
    /// \[A·s/rad\].
    pub(crate) derivative: f64,
    /// Time constant of the filter \[s\]; 0: none.
    pub(crate) filter_s: f64,
}

impl Gains {
    /// The gains of a loop with frequency ω_c and damping ζ_c on the inertia of the motor.
    fn of(arm: &Arm, omega_c: f64, zeta_c: f64, filter_s: f64) -> Self {
        let stiffness =
            arm.motor.inertia_kg_m2() * omega_c * omega_c / arm.motor.torque_constant_nm_per_a();
        Self { proportional: stiffness, derivative: 2.0 * zeta_c * stiffness / omega_c, filter_s }
    }

    pub(crate) fn pd(&self) -> Result<Pd, RigError> {
        let pd = Pd::new(self.proportional, self.derivative)?;
        if self.filter_s > 0.0 { pd.with_filter(self.filter_s) } else { Ok(pd) }
    }

    /// Current per angle at `omega`, without the effect of sampling \[A/rad\].
    pub(crate) fn response(&self, omega: f64) -> Complex64 {
        let s = Complex64::new(0.0, omega);
        self.proportional + self.derivative * s / (1.0 + self.filter_s * s)
    }

    /// Current that a jump of the motor's reading causes \[A\].
    fn jump_a(&self, jump_rad: f64, sample_time_s: f64) -> f64 {
        jump_rad * (self.proportional + self.derivative / (sample_time_s + self.filter_s))
    }
}

/// The requirements on a loop.
pub(crate) struct Task {
    /// The beam's first frequency \[rad/s\].
    pub(crate) first_rad_s: f64,
    /// Planned peak torque \[N·m\].
    pub(crate) peak_nm: f64,
    /// Coulomb friction \[N·m\].
    pub(crate) coulomb_nm: f64,
    /// Largest amplitude \[rad\].
    pub(crate) most_rad: f64,
    /// Change of the motor's reading between two samples that its sensor alone causes \[rad\].
    pub(crate) jump_rad: f64,
    /// T \[s\].
    pub(crate) sample_time_s: f64,
}

/// A loop several times faster than the beam's first mode. It is stiff enough for the friction, stable
/// with a margin, and insensitive to the encoder's steps. `None` if there is none.
pub(crate) fn random_loop(draw: &mut Draw, arm: &Arm, task: &Task) -> Option<Gains> {
    let zeta_c = draw.uniform(0.6, 1.0);
    let filtered = draw.chance(0.5);
    let stiff = task.coulomb_nm / (draw.decade(DEAD.0, DEAD.1) * task.most_rad);
    let slowest = (stiff / arm.motor.inertia_kg_m2()).sqrt().max(SLOWEST * task.first_rad_s);
    let meant = (task.first_rad_s * draw.decade(4.0, 10.0)).max(slowest);
    let mut omega_c = meant.min(FASTEST / task.sample_time_s);
    while omega_c >= slowest {
        // Some loops always have a filter, others only if the encoder requires one.
        for filter_s in FILTERS.map(|f| f / omega_c) {
            let gains = Gains::of(arm, omega_c, zeta_c, filter_s);
            let jump_a = gains.jump_a(task.jump_rad, task.sample_time_s);
            let quiet = arm.motor.torque_constant_nm_per_a() * jump_a < CHATTER * task.peak_nm;
            let suits = quiet && (filter_s > 0.0 || !filtered);
            if suits && is_stable(arm, &gains, task.sample_time_s) {
                return Some(gains);
            }
        }
        omega_c *= SLOWER;
    }
    None
}

/// Whether the sampled loop without friction is stable, also with gains [`GAIN_MARGIN`] times larger.
pub(crate) fn is_stable(arm: &Arm, gains: &Gains, sample_time_s: f64) -> bool {
    let (step, input) = held(arm, sample_time_s);
    [1.0, GAIN_MARGIN].iter().all(|margin| {
        let gains = Gains {
            proportional: margin * gains.proportional,
            derivative: margin * gains.derivative,
            ..*gains
        };
        let closed = closed_loop(&step, &input, &gains, sample_time_s);
        closed.complex_eigenvalues().iter().all(|z| z.norm() < 1.0)
    })
}

/// State after one sample with constant current: `x⁺ = Φ·x + Γ·i`.
fn held(arm: &Arm, sample_time_s: f64) -> (Matrix, Matrix) {
    let space = arm.state_space();
    let len = space.a.nrows();
    let mut both = Matrix::zeros(len + 1, len + 1);
    both.view_mut((0, 0), (len, len)).copy_from(&(&space.a * sample_time_s));
    both.view_mut((0, len), (len, 1)).copy_from(&(space.b.columns(0, 1) * sample_time_s));
    let over = both.exp();
    (over.view((0, 0), (len, len)).into_owned(), over.view((0, len), (len, 1)).into_owned())
}

/// The loop at reference zero on `[x, e_{k−1}, d_{k−1}]`: `i = k_p·e + d`,
/// `d = (τ·d_{k−1} + k_d·(e − e_{k−1}))/(τ + T)`, `e = −θ_m`.
fn closed_loop(step: &Matrix, input: &Matrix, gains: &Gains, sample_time_s: f64) -> Matrix {
    let len = step.nrows();
    let keep = gains.filter_s / (gains.filter_s + sample_time_s);
    let rate = gains.derivative / (gains.filter_s + sample_time_s);
    // Derivative part and current as rows over the state.
    let mut derivative = Matrix::zeros(1, len + 2);
    derivative[(0, 0)] = -rate;
    derivative[(0, len)] = -rate;
    derivative[(0, len + 1)] = keep;
    let mut current = derivative.clone();
    current[(0, 0)] -= gains.proportional;
    let mut closed = Matrix::zeros(len + 2, len + 2);
    closed.view_mut((0, 0), (len, len)).copy_from(step);
    let fed = input * current;
    let mut rows = closed.view_mut((0, 0), (len, len + 2));
    rows += fed;
    closed[(len, 0)] = -1.0;
    closed.view_mut((len + 1, 0), (1, len + 2)).copy_from(&derivative);
    closed
}

#[cfg(test)]
mod tests {
    use lissom::beam::{LumpedBeam, Span};
    use lissom::drive::{Coulomb, Motor};
    use lissom::rig::{Experiment, Instruments, Rig, Settle};

    use super::*;

    fn arm() -> Arm {
        let span = Span {
            length_m: 0.3,
            flexural_rigidity_n_m2: 0.01,
            mass_kg: 0.05,
            damping_n_s_per_m: 0.01,
        };
        let motor = Motor::new(1e-3, 1e-3, 0.2).unwrap();
        Arm::new(LumpedBeam::new(&[span]).unwrap(), motor, Coulomb::symmetric(0.0).unwrap())
            .unwrap()
    }

    /// The stability limit from eigenvalues is that of the simulated loop.
    #[test]
    fn the_rig_agrees_on_what_is_stable() {
        let (arm, sample) = (arm(), 0.003);
        let mut seen = [false; 2];
        for omega_c in [50.0, 100.0, 200.0, 300.0, 500.0, 800.0] {
            for filter_s in [0.0, 0.002] {
                let gains = Gains::of(&arm, omega_c, 0.7, filter_s);
                let (step, input) = held(&arm, sample);
                let radius = closed_loop(&step, &input, &gains, sample)
                    .complex_eigenvalues()
                    .iter()
                    .fold(0.0_f64, |m, z| m.max(z.norm()));
                if (radius - 1.0).abs() < 0.02 && radius > 1.0 {
                    continue;
                }
                let instruments = Instruments::ideal(sample).unwrap();
                let rig = Rig::new(arm.clone(), instruments, gains.pd().unwrap().into());
                let sine = Experiment::sine(3.0, 0.5, 20.0).unwrap().settling(Settle::AtOnce);
                let stable = rig.run("", &sine, 0).is_ok();
                assert_eq!(stable, radius < 1.0, "{omega_c} {filter_s} {radius}");
                seen[usize::from(stable)] = true;
            }
        }
        assert_eq!(seen, [true; 2]);
    }
}
