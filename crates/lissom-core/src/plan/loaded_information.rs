//! Information of a run about a rigid joint with gravity, which is identified by regression in slip phases.

use std::f64::consts::PI;

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use super::PlannedMotion;
use crate::plan::thresholds::WINDOW_OF_SLIP;
use crate::record::Run;
use crate::replay::{ModalArm, Parameter, SensorNoise};

/// Number of windows that begin within the length of one window.
const OVERLAP: f64 = 4.0;
/// Fewest samples of a window.
const SAMPLES_LEAST: usize = 6;
/// `w⁵·∫ψ″²` of the window `ψ(t) = 30/w·x²(1 − x)²`, x = t/w.
const ROUGHNESS: f64 = 720.0;

/// A rigid joint with gravity, as roughly known before the runs.
#[derive(Debug, Clone, Copy)]
pub(super) struct LoadedJoint<'a> {
    pub(super) arm: &'a ModalArm,
    /// Unknowns in addition to g_s and g_c, which come last.
    pub(super) parameters: &'a [Parameter],
    /// K \[N·m per unit of the command\].
    pub(super) torque_per_command: f64,
    /// That of the motor's sensor.
    pub(super) noise: SensorNoise,
}

impl LoadedJoint<'_> {
    /// Information after one, two, … stretches of `samples`.
    ///
    /// The equation of the torque is averaged over windows of length w within a slip phase:
    ///
    /// ```text
    /// K·i = J·θ̈ + V·θ̇ + s·C + F_o + g_s·sin θ + g_c·cos θ,    I = Σ f·fᵀ/σ_τ²,    σ_τ² = 720·J²·σ²·T/w⁵
    /// ```
    ///
    /// f are the derivatives of the torque by the unknowns, s the direction of motion, F_o the offset of friction, σ the
    /// standard deviation of the motor's sensor and T the sample time; σ_τ is the error of the mean of J·θ̈ due to σ. Each
    /// window counts once, however many overlap. Angle, speed and acceleration are those of a parabola through it.
    pub(super) fn growing(
        &self,
        motion: &PlannedMotion,
        run: &Run,
        samples: f64,
    ) -> Vec<DMatrix<f64>> {
        let sample_s = run.sample_time_s();
        let window_s = WINDOW_OF_SLIP * PI / motion.highest_rad_s();
        let length = ((window_s / sample_s).round() as usize).max(SAMPLES_LEAST);
        let step = (length as f64 / OVERLAP).ceil().max(1.0) as usize;
        let window_s = length as f64 * sample_s;
        let torque_nm = self.arm.inertia_kg_m2
            * self.noise.deviation()
            * (ROUGHNESS * sample_s / window_s.powi(5)).sqrt();
        let weight = step as f64 / length as f64 / torque_nm.powi(2);
        let size = self.parameters.len() + 2;
        let mut sum = DMatrix::zeros(size, size);
        let (mut found, mut stretch) = (Vec::new(), 1.0);
        for from in (0..(run.len() + 1).saturating_sub(length)).step_by(step) {
            if (from + length) as f64 > stretch * samples + 1.0 {
                found.push(sum.clone());
                stretch += 1.0;
            }
            if let Some(row) = self.row(run, from..from + length) {
                sum.ger(weight, &row, &row, 1.0);
            }
        }
        found.push(sum);
        found
    }

    /// Derivatives of the torque in the middle of a window; `None` if the direction of slip is not certain.
    fn row(&self, run: &Run, window: std::ops::Range<usize>) -> Option<DVector<f64>> {
        let sample_s = run.sample_time_s();
        let half_s = 0.5 * (window.len() - 1) as f64 * sample_s;
        let [angle, speed, acceleration] = parabola(&run.motor()[window.clone()], sample_s)?;
        if speed.abs() <= acceleration.abs() * half_s {
            return None;
        }
        let command = &run.command()[window];
        let rise = command.last()? - command.first()?;
        let by = |parameter: &Parameter| match parameter {
            Parameter::Inertia => acceleration,
            Parameter::Viscous => speed,
            Parameter::Coulomb => speed.signum(),
            Parameter::Offset => 1.0,
            Parameter::CommandLag => self.torque_per_command * rise / (2.0 * half_s),
            _ => 0.0,
        };
        let gravity = [angle.sin(), angle.cos()];
        let row = self.parameters.iter().map(by).chain(gravity);
        Some(DVector::from_iterator(self.parameters.len() + 2, row))
    }
}

/// Value, slope and second derivative of the least-squares parabola in the middle of the samples.
fn parabola(values: &[f64], sample_s: f64) -> Option<[f64; 3]> {
    let half = 0.5 * (values.len() as f64 - 1.0);
    let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for (k, value) in values.iter().enumerate() {
        let t = (k as f64 - half) / half;
        let row = Vector3::new(1.0, t, 0.5 * t * t);
        normal += row * row.transpose();
        right += row * *value;
    }
    let found = normal.cholesky()?.solve(&right);
    let scale = 1.0 / (half * sample_s);
    Some([found[0], found[1] * scale, found[2] * scale * scale])
}
