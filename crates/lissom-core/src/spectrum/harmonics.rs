//! Phasors of harmonics by least squares over whole periods.

use nalgebra::DMatrix;
use num_complex::Complex64;

use super::harmonic_fit::{HarmonicFit, Residual};

/// One harmonic of one channel: `x(t) = … + Re{X·e^{jkω0·t}}`, t from the first sample of the fit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Phasor {
    /// Phasor X, in the unit of the channel.
    pub value: Complex64,
    /// Standard error of X, `√E|X̂ − X|²`, in the unit of the channel.
    pub std: f64,
}

/// Harmonics 1 to H of a signal, with its mean, drift and residual.
#[derive(Debug, Clone)]
pub struct Harmonics {
    /// Fundamental ω0 \[rad/s\].
    pub omega_rad_s: f64,
    /// Phasors; element `k − 1` is harmonic k.
    pub phasors: Vec<Phasor>,
    /// Mean, in the unit of the channel.
    pub mean: f64,
    /// Drift: rise of the fitted straight line over the record, in the unit of the channel.
    pub drift: f64,
    /// Root mean square of the residual, in the unit of the channel.
    pub residual_rms: f64,
    /// Root mean square of the signal about its mean, in the unit of the channel.
    pub signal_rms: f64,
}

impl Harmonics {
    /// Phasor of harmonic `k`, counted from 1; `None` if it was not estimated.
    pub fn get(&self, k: usize) -> Option<Phasor> {
        self.phasors.get(k.checked_sub(1)?).copied()
    }
    /// Share of the residual in the power of the signal, without its mean \[1\].
    pub fn unexplained(&self) -> f64 {
        (self.residual_rms / self.signal_rms.max(f64::MIN_POSITIVE)).powi(2)
    }
}

/// Factor of a zero-order hold on a phasor, `sin(ωT/2)/(ωT/2)·e^{−jωT/2}` \[1\].
///
/// A commanded current is constant between samples. This factor converts the phasor of its samples to the phasor of the
/// current in the motor. ω is in rad/s, the sample time T in s.
///
/// ```
/// let f = lissom::spectrum::hold_factor(20.0, 0.003);
/// assert!((f.arg().to_degrees() + 1.719).abs() < 1e-3); // half a sample late
/// ```
///
/// # Source
/// Fourier transform of a held sample. `[Feliu1989, Section 5.2]` uses the commanded current as the current of the
/// motor: see the section on the hold in `docs/src/reference/errata.md`.
pub fn hold_factor(omega_rad_s: f64, sample_time_s: f64) -> Complex64 {
    let half = 0.5 * omega_rad_s * sample_time_s;
    let gain = if half == 0.0 { 1.0 } else { half.sin() / half };
    Complex64::from_polar(gain, -half)
}

/// Fits mean, drift and harmonics 1 to `count` of `omega_rad_s` to uniform samples:
/// `x(t) = a + b·t + Σ_k Re{X_k·e^{jkω0·t}}`, t from the first sample.
///
/// ```
/// use lissom::spectrum::least_squares;
/// let x: Vec<f64> = (0..1000).map(|k| 2.0 * (3.0 * 0.01 * f64::from(k) + 0.4).cos()).collect();
/// let first = least_squares(&x, 3.0, 0.01, 3).unwrap().get(1).unwrap().value;
/// assert!((first.norm() - 2.0).abs() < 1e-12 && (first.arg() - 0.4).abs() < 1e-12);
/// ```
///
/// Standard errors come from the residual. They are the larger of two: the value `2σ²/N` for white noise with the power
/// of the residual, and a sandwich estimate over blocks of one period, which accounts for a residual that is coloured
/// near the harmonic. `None` if there are too few samples for the unknowns.
///
/// # Source
/// Linear least squares; `[Feliu1989, Section 5.2]` does not say which spectral analysis it uses.
pub fn least_squares(
    samples: &[f64],
    omega_rad_s: f64,
    sample_time_s: f64,
    count: usize,
) -> Option<Harmonics> {
    let (n, columns) = (samples.len(), 2 + 2 * count);
    let fit = HarmonicFit::new(n, omega_rad_s * sample_time_s, count)?;
    let (solution, inverse) = (fit.solution(samples), fit.inverse());
    let mean_signal = samples.iter().sum::<f64>() / n as f64;
    let signal: f64 = samples.iter().map(|x| (x - mean_signal).powi(2)).sum();
    let period = ((std::f64::consts::TAU / omega_rad_s / sample_time_s).round() as usize).max(1);
    let Residual { power, middle, stretches } = fit.residual(samples, &solution, Some(period));
    let white = power / (n - columns) as f64;
    let enough = stretches as f64 / (stretches - 1).max(1) as f64;
    let sandwich: DMatrix<f64> = inverse * middle * inverse * enough;
    let phasors = (0..count)
        .map(|h| {
            let (c, s) = (2 + 2 * h, 3 + 2 * h);
            // Re{X e^{jφ}} = Re X·cos φ − Im X·sin φ.
            let value = Complex64::new(solution[c], -solution[s]);
            let by_white = white * (inverse[(c, c)] + inverse[(s, s)]);
            let by_blocks = sandwich[(c, c)] + sandwich[(s, s)];
            Phasor { value, std: by_white.max(by_blocks).sqrt() }
        })
        .collect();
    Some(Harmonics {
        omega_rad_s,
        phasors,
        mean: solution[0],
        drift: 2.0 * solution[1],
        residual_rms: (power / n as f64).sqrt(),
        signal_rms: (signal / n as f64).sqrt(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_phasors_of_a_signal_of_harmonics_mean_and_drift() {
        let (omega, t) = (3.3, 0.004);
        let x: Vec<f64> = (0..5000)
            .map(|k| {
                let s = k as f64 * t;
                0.7 + 0.02 * s + 1.5 * (omega * s + 0.4).cos() + 0.1 * (3.0 * omega * s - 2.0).cos()
            })
            .collect();
        let fit = least_squares(&x, omega, t, 3).unwrap();
        let expect = |k: usize, z: Complex64| {
            assert!((fit.get(k).unwrap().value - z).norm() < 1e-12, "harmonic {k}");
        };
        expect(1, Complex64::from_polar(1.5, 0.4));
        expect(2, Complex64::ZERO);
        expect(3, Complex64::from_polar(0.1, -2.0));
        assert!((fit.drift - 0.02 * 4999.0 * t).abs() < 1e-10);
        assert_eq!(fit.get(0), None);
        assert_eq!(fit.get(4), None);
    }

    #[test]
    fn standard_deviation_holds_for_white_noise() {
        // A linear congruential generator: the test must not depend on a random seed.
        let mut state = 1_u64;
        let mut uniform = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        };
        let (omega, t, truth) = (2.0, 0.01, Complex64::from_polar(1.0, 1.0));
        let trials = 300;
        let (mut error, mut claimed) = (0.0, 0.0);
        for _ in 0..trials {
            let x: Vec<f64> =
                (0..2000).map(|k| (omega * k as f64 * t + 1.0).cos() + 0.3 * uniform()).collect();
            let p = least_squares(&x, omega, t, 1).unwrap().get(1).unwrap();
            error += (p.value - truth).norm_sqr();
            claimed += p.std * p.std;
        }
        // Never below the truth by more than chance, nor more than twice it: the larger of two
        // estimates is taken.
        let ratio: f64 = claimed / error;
        assert!((0.85..2.0).contains(&ratio), "{ratio}");
    }

    #[test]
    fn held_cosine_is_delayed_by_half_a_sample() {
        let f = hold_factor(20.0, 0.003);
        assert!((f.arg().to_degrees() + 1.7).abs() < 0.02, "errata 2: 1.7° at 20 rad/s and 3 ms");
    }
}
