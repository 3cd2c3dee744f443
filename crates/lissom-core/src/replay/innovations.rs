//! Innovations: readings minus their prediction from the readings before, where noise of the command moves the replay.
//!
//! The joint is driven by the torque itself, a replay by its measured value: the noise `n` of the command moves the replayed
//! motion away from the joint's, as a random walk of its velocity. This is the linear Kalman filter of that difference
//! `d = x − x̂`, in the mode that the replay is in:
//!
//! ```text
//! d(k+1) = A·d(k) + b·(n(k) + n(k+1))/2,   y = ŷ + c·d + v,   e = y − ŷ − c·d,   K = P·cᵀ/S,   S = c·P·cᵀ + σ²
//! ```
//!
//! A measured command is drawn as a line between samples, so noise of both ends acts; that three samples make an end is left out.
//! A is from tangents of unit changes of the state, which include stops and reversals. The innovations e are white with the
//! variance S. Their derivatives are those of ŷ after the same filter. A controller does not correlate them with the command, as it
//! does residuals of a replay \[Ljung1999\].

use super::noise::Loss;
use super::tangents::Tangents;

/// The filter over one window.
#[derive(Debug, Clone)]
pub(super) struct Innovations<const D: usize> {
    /// Estimated d, and its covariance P.
    beyond: [f64; D],
    covariance: [[f64; D]; D],
    last: LastNoise<D>,
    /// What noise over a sample adds to a slipping motor's angle and velocity, one standard deviation: b.
    push: [f64; D],
    /// The first of the unit changes among the tangents.
    units: usize,
}

/// Estimate of the noise of the last command, in standard deviations.
#[derive(Debug, Clone)]
struct LastNoise<const D: usize> {
    value: f64,
    variance: f64,
    /// Covariance with d.
    beside: [f64; D],
    /// Derivatives of the value by the unknowns.
    row: Vec<f64>,
}

/// Innovation of one reading, with the filter's gain.
#[derive(Debug, Clone, Copy)]
pub(super) struct Innovation<const D: usize> {
    /// e.
    pub(super) value: f64,
    /// S.
    pub(super) variance: f64,
    gain: [f64; D],
    seen: [f64; D],
    /// The same for the noise of the last command.
    gain_of_noise: f64,
    seen_of_noise: f64,
}

impl<const D: usize> Innovation<D> {
    pub(super) fn loss(&self) -> Loss {
        let slope = self.value / self.variance;
        Loss { cost: slope * self.value, slope, curvature: 1.0 / self.variance }
    }
}

impl<const D: usize> Innovations<D> {
    /// Filter from a known state; `acceleration` is the standard deviation of the motor's acceleration by the noise of one command.
    pub(super) fn new(acceleration: f64, sample_time_s: f64, units: usize) -> Self {
        let mut push = [0.0; D];
        push[0] = 0.5 * acceleration * sample_time_s.powi(2);
        push[1] = acceleration * sample_time_s;
        let row = vec![0.0; units];
        let last = LastNoise { value: 0.0, variance: 1.0, beside: [0.0; D], row };
        Self { beyond: [0.0; D], covariance: [[0.0; D]; D], last, push, units }
    }

    /// Time update, after the tangents moved over a sample.
    pub(super) fn advance(&mut self, tangents: &mut Tangents<D>, slips: bool) {
        let a = tangents.take_units(self.units);
        self.beyond = product(&a, &self.beyond);
        let transposed = std::array::from_fn(|i| std::array::from_fn(|j| a[j][i]));
        let found = times(&times(&a, &self.covariance), &transposed);
        self.covariance =
            std::array::from_fn(|i| std::array::from_fn(|j| 0.5 * (found[i][j] + found[j][i])));
        let beside = product(&a, &self.last.beside);
        let Self { last, push, .. } = self;
        let half = if slips { push.map(|b| 0.5 * b) } else { [0.0; D] };
        for i in 0..D {
            self.beyond[i] += half[i] * last.value;
            for j in 0..D {
                self.covariance[i][j] += beside[i] * half[j]
                    + half[i] * beside[j]
                    + half[i] * half[j] * (last.variance + 1.0);
            }
        }
        for (unknown, by) in last.row.iter_mut().enumerate().filter(|(_, by)| **by != 0.0) {
            tangents.add(unknown, *by, &half);
            *by = 0.0;
        }
        (last.value, last.variance, last.beside) = (0.0, 1.0, half);
    }

    /// Innovation of a reading `c·x` with noise of a `variance`, which is `residual` more than the replay.
    pub(super) fn of(&self, c: &[f64; D], residual: f64, variance: f64) -> Innovation<D> {
        let seen = product(&self.covariance, c);
        let dot = |a: &[f64; D], b: &[f64; D]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let all = dot(c, &seen) + variance;
        let value = residual - dot(c, &self.beyond);
        let seen_of_noise = dot(c, &self.last.beside);
        Innovation {
            value,
            variance: all,
            gain: seen.map(|s| s / all),
            seen,
            gain_of_noise: seen_of_noise / all,
            seen_of_noise,
        }
    }

    /// Measurement update by a reading, whose prediction has the derivatives `row`.
    pub(super) fn learn(
        &mut self,
        innovation: &Innovation<D>,
        tangents: &mut Tangents<D>,
        row: Option<&[f64]>,
    ) {
        let Innovation { value, gain, seen, gain_of_noise, seen_of_noise, .. } = innovation;
        self.last.value += gain_of_noise * value;
        self.last.variance -= gain_of_noise * seen_of_noise;
        let own = self.beyond.iter_mut().zip(&mut self.last.beside).zip(&mut self.covariance);
        for (((beyond, beside), covariance), gain) in own.zip(gain) {
            *beyond += gain * value;
            *beside -= gain * seen_of_noise;
            covariance.iter_mut().zip(seen).for_each(|(p, seen)| *p -= gain * seen);
        }
        if let Some(row) = row {
            tangents.corrected(gain, row);
            self.last.row.iter_mut().zip(row).for_each(|(by, r)| *by -= gain_of_noise * r);
        }
    }
}

/// `A·x`, in loops that a compiler unrolls.
fn product<const D: usize>(a: &[[f64; D]; D], x: &[f64; D]) -> [f64; D] {
    let mut found = [0.0; D];
    for (sum, row) in found.iter_mut().zip(a) {
        for (a, x) in row.iter().zip(x) {
            *sum += a * x;
        }
    }
    found
}

/// `A·B`, row by row: a whole row is added at a time.
fn times<const D: usize>(a: &[[f64; D]; D], b: &[[f64; D]; D]) -> [[f64; D]; D] {
    let mut found = [[0.0; D]; D];
    for (sum, row) in found.iter_mut().zip(a) {
        for (a, b) in row.iter().zip(b) {
            for (sum, b) in sum.iter_mut().zip(b) {
                *sum += a * b;
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::super::{DryTerms, ModalArm, Parameter, Sampling, SensorNoise, Window, costs, sums};
    use crate::record::{Axis, Campaign, Channels, Command, CommandQuantity, Hold, Run, TimeBase};
    use nalgebra::{DMatrix, DVector};

    /// A free motor: the filter's sums are those of generalised least squares with the covariance of all residuals,
    /// V = σ²·1 + G·Gᵀ, where G has the angle at each sample by the noise of each command.
    #[test]
    fn a_free_motor_is_weighed_by_the_covariance_of_its_residuals() {
        const SAMPLES: usize = 30;
        const T: f64 = 0.01;
        let (speed, sigma, acceleration) = (2.0, 1e-3, 5.0);
        let residual = |k: usize| 2e-3 * ((k * k) as f64 * 0.37).sin();
        let motor: Vec<f64> = (0..SAMPLES).map(|k| speed * T * k as f64 + residual(k)).collect();
        let still = vec![0.0; SAMPLES];
        let run = Run::new("free", TimeBase::uniform(0.0, T), still, motor, vec![]).unwrap();
        let command = Command {
            quantity: CommandQuantity::Current,
            hold: Hold::Measured,
            torque_per_command: Some(0.5),
            back_emf_viscous: 0.0,
            limit: None,
        };
        let channels = Channels { axis: Axis::Rotary, command, tips: vec![] };
        let campaign = Campaign::new(channels, vec![run]).unwrap();
        let arm = ModalArm {
            inertia_kg_m2: 0.02,
            viscous_nm_s_per_rad: [0.0; 2],
            coulomb_nm: 0.0,
            offset_nm: 0.0,
            modes: vec![],
            shapes: vec![],
            at_points_per_s: vec![],
            dry_terms: DryTerms::default(),
            gravity: None,
            torque_ripples: vec![],
            command_lag_s: 0.0,
            tip_lags_s: vec![],
        };
        let windows =
            [Window { run: 0, samples: 0..=SAMPLES - 1, start: vec![0.0, speed], zeros: vec![] }];
        let noise = [SensorNoise::gaussian(sigma)];
        let masks = [vec![None]];
        let sampling =
            Sampling { noise: &noise, blocks: &[], masks: &masks, command_noise: acceleration };
        let cost = costs(&arm, &campaign, &windows, sampling)[0];
        let found = &sums(&arm, &[Parameter::Viscous], &campaign, &windows, sampling)[0];

        let moved = |k: usize, j: usize| {
            // By the mean noise from sample i to the next, half of which is that of sample j.
            let by = |i: usize| if i < k { T * T * (0.5 + (k - 1 - i) as f64) } else { 0.0 };
            0.5 * acceleration * (by(j) + j.checked_sub(1).map_or(0.0, by))
        };
        let g = DMatrix::from_fn(SAMPLES, SAMPLES, moved);
        let v = DMatrix::identity(SAMPLES, SAMPLES) * (sigma * sigma) + &g * g.transpose();
        let factor = v.cholesky().unwrap();
        let r = DVector::from_fn(SAMPLES, |k, _| residual(k));
        let by_speed = DVector::from_fn(SAMPLES, |k, _| T * k as f64);
        let weighed = factor.solve(&r);
        let near = |a: f64, b: f64| (a - b).abs() < 1e-6 * b.abs();
        assert!(near(cost.cost, r.dot(&weighed)), "{} {}", cost.cost, r.dot(&weighed));
        let widened = factor.ln_determinant() - 2.0 * SAMPLES as f64 * sigma.ln();
        assert!(near(cost.widened, widened), "{} {widened}", cost.widened);
        // The unknowns: viscous friction, the first angle, the first speed.
        assert!(near(found.gram[(2, 3)], by_speed.dot(&weighed)));
        assert!(near(found.gram[(2, 2)], by_speed.dot(&factor.solve(&by_speed))));
        assert!(near(found.cost, cost.cost));
    }
}
