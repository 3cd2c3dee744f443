//! Frequency responses from records of any shape, by averaged cross-spectra.

use num_complex::Complex64;
use rustfft::FftPlanner;

use crate::spectrum::thresholds::{BAND_DRIVEN, BAND_NEXT, BINS_LEAST};

/// Bands per decade of frequency.
const BANDS_PER_DECADE: f64 = 60.0;
/// Share of a record over which each end is tapered.
const TAPER: f64 = 0.05;

/// Frequency response and coherence in a band of frequencies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Band {
    /// Centre frequency, weighted by the power of the input \[rad/s\].
    pub omega_rad_s: f64,
    /// Response: output over input.
    pub response: Complex64,
    /// Standard error of the response, `|H|·√((1 − γ²)/(γ²·(m − 1)))` for m independent lines.
    pub std: f64,
    /// Coherence γ², from 0 to 1.
    pub coherence: f64,
    /// Mean power of the input per line; from [`broadband`], relative to the band with the largest power.
    pub input_power: f64,
    /// Mean power of the output per line.
    pub output_power: f64,
}

/// One line of the spectra of an input and an output.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bin {
    /// Frequency \[rad/s\].
    pub omega_rad_s: f64,
    /// Spectrum of the input.
    pub input: Complex64,
    /// Spectrum of the output.
    pub output: Complex64,
}

/// The spectral lines of one record.
#[derive(Debug, Clone, PartialEq)]
pub struct Lines {
    /// Distance between lines \[rad/s\].
    pub step_rad_s: f64,
    /// Lines from the second one up to 0.8 of the Nyquist frequency; above that, samples contain little information
    /// about the signal.
    pub bins: Vec<Bin>,
}

impl Lines {
    /// Computes the lines of an input and an output; the longer one is cut to the length of the other.
    pub fn new(input: &[f64], output: &[f64], sample_time_s: f64) -> Self {
        let n = input.len().min(output.len());
        let fft = FftPlanner::new().plan_fft_forward(n);
        let transform = |x: &[f64]| {
            let mut z = tapered(&x[..n]);
            fft.process(&mut z);
            z
        };
        let (u, y) = (transform(input), transform(output));
        let step_rad_s = std::f64::consts::TAU / (n as f64 * sample_time_s);
        let bin = |k: usize| Bin { omega_rad_s: k as f64 * step_rad_s, input: u[k], output: y[k] };
        Self { step_rad_s, bins: (2..n * 2 / 5).map(bin).collect() }
    }
}

/// Estimates the frequency response from `input` to `output`, H1 = `S_yu/S_uu`, in bands of logarithmic width. Each
/// record is (input, output, sample time \[s\]). Bands outside the range in which the input was excited are left out,
/// because they contain only transients (for example beyond the end of a sweep).
///
/// # Source
/// Cross-spectral averaging over neighbouring lines and over records, `[Pintelon2012, ch. 2]`.
pub fn broadband(records: &[(&[f64], &[f64], f64)]) -> Vec<Band> {
    let lines: Vec<Lines> = records.iter().map(|(u, y, t)| Lines::new(u, y, *t)).collect();
    let mut bands: Vec<Band> = groups(&lines).iter().filter_map(|bins| average(bins)).collect();
    let strongest = bands.iter().map(|b| b.input_power).fold(f64::MIN_POSITIVE, f64::max);
    for band in &mut bands {
        band.input_power /= strongest;
    }
    driven(&bands)
}

/// Groups the lines of all records to bands of logarithmic width, with at least a few lines each.
pub fn groups(records: &[Lines]) -> Vec<Vec<Bin>> {
    let mut bins: Vec<Bin> = records.iter().flat_map(|r| r.bins.iter().copied()).collect();
    bins.sort_by(|a, b| a.omega_rad_s.total_cmp(&b.omega_rad_s));
    let widest = records.iter().map(|r| r.step_rad_s).fold(0.0, f64::max);
    let ratio = 10_f64.powf(1.0 / BANDS_PER_DECADE);
    let mut groups = Vec::new();
    let mut from = 0;
    while from < bins.len() {
        let start = bins[from].omega_rad_s;
        let to_omega = (start * ratio).max(start + widest * (BINS_LEAST as f64 - 0.5));
        let to = from + bins[from..].partition_point(|b| b.omega_rad_s < to_omega);
        if to - from >= BINS_LEAST {
            groups.push(bins[from..to].to_vec());
        }
        from = to.max(from + 1);
    }
    groups
}

/// Mean power per line that white noise of the standard deviations `stds` adds to the outputs of records with the given
/// numbers of samples and sample times. A record of n samples has n·σ² in each line, and a number of lines in
/// proportion to its duration.
pub fn noise_power(samples: &[usize], sample_time_s: &[f64], stds: &[f64]) -> f64 {
    let (mut power, mut bins) = (0.0, 0.0);
    for ((n, t), std) in samples.iter().zip(sample_time_s).zip(stds) {
        let n = *n as f64;
        power += n * t * n * std * std;
        bins += n * t;
    }
    power / bins
}

/// The bands from the first to the last in which the input is not far weaker than next to it.
fn driven(bands: &[Band]) -> Vec<Band> {
    let beside = |b: &Band, low: f64, high: f64| {
        let next = bands.iter().filter(|o| (low..=high).contains(&(o.omega_rad_s / b.omega_rad_s)));
        b.input_power >= BAND_DRIVEN * next.map(|o| o.input_power).fold(0.0, f64::max)
    };
    let first = bands.iter().position(|b| beside(b, 1.0, BAND_NEXT)).unwrap_or(0);
    let last = bands.iter().rposition(|b| beside(b, 1.0 / BAND_NEXT, 1.0)).unwrap_or(0);
    bands.get(first..=last).map_or_else(Vec::new, <[Band]>::to_vec)
}

/// H1 estimate from the lines of one band; `None` if input or output is zero.
pub fn average(bins: &[Bin]) -> Option<Band> {
    let (mut uu, mut yy, mut omega) = (0.0, 0.0, 0.0);
    let mut yu = Complex64::ZERO;
    for bin in bins {
        let power = bin.input.norm_sqr();
        uu += power;
        yy += bin.output.norm_sqr();
        yu += bin.output * bin.input.conj();
        omega += bin.omega_rad_s * power;
    }
    if uu <= 0.0 || yy <= 0.0 {
        return None;
    }
    let response = yu / uu;
    let coherence = (yu.norm_sqr() / (uu * yy)).min(1.0);
    let m = bins.len() as f64;
    // m bins explain one complex response: m − 1 are left to estimate the scatter from.
    let variance = (yy - yu.norm_sqr() / uu).max(0.0) / ((m - 1.0) * uu);
    Some(Band {
        omega_rad_s: omega / uu,
        response,
        std: variance.sqrt(),
        coherence,
        input_power: uu / m,
        output_power: yy / m,
    })
}

/// Mean and line through the ends taken out, ends tapered by half a cosine.
fn tapered(x: &[f64]) -> Vec<Complex64> {
    let n = x.len();
    let (first, last) = (x[0], x[n - 1]);
    let line = |k: usize| first + (last - first) * k as f64 / (n - 1) as f64;
    let mean = x.iter().enumerate().map(|(k, v)| v - line(k)).sum::<f64>() / n as f64;
    let edge = (TAPER * n as f64).max(1.0);
    x.iter()
        .enumerate()
        .map(|(k, v)| {
            let near = (k as f64).min((n - 1 - k) as f64) / edge;
            let w = if near < 1.0 { 0.5 - 0.5 * (std::f64::consts::PI * near).cos() } else { 1.0 };
            Complex64::from(w * (v - line(k) - mean))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn response_of_a_first_order_lag_from_a_sweep() {
        let (t, n, pole) = (0.002_f64, 30_000, 8.0);
        let rate = 0.5 * 60.0 / (n as f64 * t);
        let u: Vec<f64> = (0..n).map(|k| (rate * (k as f64 * t).powi(2)).sin()).collect();
        let a = (-pole * t).exp();
        let mut y = vec![0.0; n];
        for k in 1..n {
            y[k] = a * y[k - 1] + (1.0 - a) * u[k - 1];
        }
        let bands = broadband(&[(&u, &y, t)]);
        let near = bands
            .iter()
            .min_by(|p, q| (p.omega_rad_s - 20.0).abs().total_cmp(&(q.omega_rad_s - 20.0).abs()));
        let band = near.unwrap();
        let z = Complex64::from_polar(1.0, band.omega_rad_s * t);
        let expected = (1.0 - a) / (z - a);
        assert!((band.response / expected - 1.0).norm() < 0.01, "{band:?} {expected}");
        assert!(band.coherence > 0.99);
    }
}
