//! A multisine of odd harmonics with random phases.

use std::f64::consts::TAU;

use num_complex::Complex64;
use rand_distr::{Distribution, StandardUniform};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;
use rustfft::FftPlanner;

use crate::rig::RigError;
use crate::rig::error::positive;

/// Highest line.
const LINE_MOST: u32 = 65_535;

/// Points of a period for each of the highest line: a peak between two of them is at most
/// 1/cos(π/32) − 1 = 0.5 % higher, and is then found by Newton's method.
const POINTS_PER_LINE: usize = 32;

/// Grid points this close to the highest, relatively, are looked at for the peak.
const NEAR_PEAK: f64 = 0.99;

/// A multisine, `r(t) = a·Σ_h sin(h·ω0·t + φ_h)` over odd h, with random phases φ_h.
///
/// All L lines have the same amplitude `a = A·√2/(c·√L)`, so that the peak is A; c is the crest factor, peak over RMS.
/// Friction that is odd appears on odd lines. Even lines of a response show nonlinear effects that are even.
///
/// ```
/// # use lissom::rig::Multisine;
/// let random = Multisine::new(0.5, &[1, 3, 5, 7, 9, 11, 13, 15], 0.4, 7)?;
/// let low = random.clone().with_crest(1.8)?;
/// assert!(low.crest() <= 1.8 && random.crest() > 1.8);
/// # Ok::<(), lissom::rig::RigError>(())
/// ```
///
/// # Source
/// Random phases: `[Pintelon2012]`; the crest factor is lowered by clipping
/// and restoring the amplitudes, `[VanDerOuderaa1988]`.
#[derive(Debug, Clone, PartialEq)]
pub struct Multisine {
    omega_rad_s: f64,
    amplitude: f64,
    highest: u32,
    crest: f64,
    /// `a·e^{jφ}` of line 2m + 1; zero where there is no such line.
    phasors: Vec<Complex64>,
}

impl Multisine {
    /// Builds a multisine with lines at `lines` times ω0 \[rad/s\], the peak `amplitude` \[rad or A\]
    /// and random phases from `seed`.
    ///
    /// # Errors
    /// [`RigError::NotPositive`] for ω0 or the peak; [`RigError::NoLines`] without lines; [`RigError::Line`] for lines
    /// that are even, do not increase, or are above 65 535.
    pub fn new(
        omega_rad_s: f64,
        lines: &[u32],
        amplitude: f64,
        seed: u64,
    ) -> Result<Self, RigError> {
        positive("omega_rad_s", omega_rad_s)?;
        positive("amplitude", amplitude)?;
        let highest = *lines.last().ok_or(RigError::NoLines)?;
        let wrong = |k: &usize| {
            let line = lines[*k];
            line.is_multiple_of(2) || line > LINE_MOST || (*k > 0 && line <= lines[*k - 1])
        };
        if let Some(k) = (0..lines.len()).find(wrong) {
            return Err(RigError::Line { found: lines[k], most: LINE_MOST });
        }
        let mut stream = Xoshiro256PlusPlus::seed_from_u64(seed);
        let mut phasors = vec![Complex64::ZERO; highest as usize / 2 + 1];
        for line in lines {
            let part: f64 = StandardUniform.sample(&mut stream);
            phasors[*line as usize / 2] = Complex64::from_polar(1.0, TAU * part);
        }
        let mut made = Self { omega_rad_s, amplitude, highest, crest: f64::INFINITY, phasors };
        let grid = made.grid();
        made.scale(&grid);
        Ok(made)
    }

    /// Builds a multisine with all odd lines up to the frequency `highest_rad_s`.
    ///
    /// # Errors
    /// Those of [`new`](Self::new).
    pub fn odd(
        omega_rad_s: f64,
        highest_rad_s: f64,
        amplitude: f64,
        seed: u64,
    ) -> Result<Self, RigError> {
        positive("omega_rad_s", omega_rad_s)?;
        positive("highest_rad_s", highest_rad_s)?;
        // A line exactly at the highest frequency belongs to it, whatever the division rounds to.
        let most = (highest_rad_s / omega_rad_s * (1.0 + 1e-12)).min(f64::from(LINE_MOST) + 2.0);
        let lines: Vec<u32> = (1..=most as u32).step_by(2).collect();
        Self::new(omega_rad_s, &lines, amplitude, seed)
    }

    /// Changes the phases until the crest factor is at most `goal`, if that can be reached; [`crest`](Self::crest)
    /// gives the crest factor that was reached. The peak stays and the amplitudes of the lines grow.
    ///
    /// # Errors
    /// [`RigError::NotPositive`] for the goal.
    pub fn with_crest(mut self, goal: f64) -> Result<Self, RigError> {
        positive("crest factor", goal)?;
        let mut best = self.clone();
        let points = self.points();
        // Bounds the work at some seconds for the longest multisine; a short one converges within.
        let rounds = ((1_usize << 24) / points).clamp(20, 4000);
        let mut planner = FftPlanner::new();
        let (back, there) = (planner.plan_fft_inverse(points), planner.plan_fft_forward(points));
        let mut buffer = vec![Complex64::ZERO; points];
        for round in 0..rounds {
            if best.crest <= goal {
                break;
            }
            self.fill(&mut buffer);
            back.process(&mut buffer);
            let peak = buffer.iter().fold(0.0_f64, |m, v| m.max(v.im.abs()));
            // Deep cuts first, then ever shallower ones.
            let level = peak * (0.85 + 0.14 * round as f64 / rounds as f64);
            for v in &mut buffer {
                *v = Complex64::from(v.im.clamp(-level, level));
            }
            there.process(&mut buffer);
            for (m, phasor) in self.phasors.iter_mut().enumerate() {
                // A sine's line is −j times its phasor.
                let line = Complex64::I * buffer[2 * m + 1];
                if *phasor != Complex64::ZERO && line.norm() > 0.0 {
                    *phasor = line / line.norm();
                }
            }
            let grid = self.grid();
            self.scale(&grid);
            if self.crest < best.crest {
                best = self.clone();
            }
        }
        Ok(best)
    }

    /// Fundamental frequency ω0 \[rad/s\].
    pub fn omega_rad_s(&self) -> f64 {
        self.omega_rad_s
    }
    /// Peak A \[rad or A\].
    pub fn amplitude(&self) -> f64 {
        self.amplitude
    }
    /// Crest factor c: peak over RMS; √2 for one line.
    pub fn crest(&self) -> f64 {
        self.crest
    }
    /// Frequency of the highest line \[rad/s\].
    pub fn highest_rad_s(&self) -> f64 {
        f64::from(self.highest) * self.omega_rad_s
    }
    /// Amplitude a of each line \[rad or A\].
    pub fn line_amplitude(&self) -> f64 {
        self.phasors.iter().fold(0.0, |m, p| m.max(p.norm()))
    }

    /// Number h and phasor `a·e^{jφ_h}` of each line, ascending in h.
    pub fn lines(&self) -> impl Iterator<Item = (u32, Complex64)> + '_ {
        let line = |(m, phasor): (usize, &Complex64)| (2 * m as u32 + 1, *phasor);
        self.phasors.iter().enumerate().map(line).filter(|(_, phasor)| *phasor != Complex64::ZERO)
    }

    /// Value at a time \[s\], in rad or A.
    pub fn value(&self, time_s: f64) -> f64 {
        self.at(self.omega_rad_s * time_s)
    }

    /// `Im(z·Σ_m p_m·z^(2m))` with `z = e^{jx}`.
    fn at(&self, x: f64) -> f64 {
        let z = Complex64::from_polar(1.0, x);
        let square = z * z;
        (z * self.phasors.iter().rev().fold(Complex64::ZERO, |sum, p| sum * square + p)).im
    }

    fn points(&self) -> usize {
        (POINTS_PER_LINE * self.highest as usize).next_power_of_two()
    }

    /// The phasors at their places in a spectrum: the imaginary part of its transform is the signal.
    fn fill(&self, spectrum: &mut [Complex64]) {
        spectrum.fill(Complex64::ZERO);
        for (m, phasor) in self.phasors.iter().enumerate() {
            spectrum[2 * m + 1] = *phasor;
        }
    }

    /// One period on a grid.
    fn grid(&self) -> Vec<f64> {
        let mut spectrum = vec![Complex64::ZERO; self.points()];
        self.fill(&mut spectrum);
        FftPlanner::new().plan_fft_inverse(spectrum.len()).process(&mut spectrum);
        spectrum.iter().map(|v| v.im).collect()
    }

    /// The peak between the points of a grid.
    fn peak(&self, grid: &[f64]) -> f64 {
        let highest = grid.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        let step = TAU / grid.len() as f64;
        // Odd harmonics alone: the second half is the first one's negative.
        let near = (0..grid.len() / 2).filter(|k| grid[*k].abs() >= NEAR_PEAK * highest);
        near.fold(highest, |m, k| m.max(self.climb(k as f64 * step, step)))
    }

    /// Magnitude at the extremum within a step of `from`, by Newton's method.
    fn climb(&self, from: f64, step: f64) -> f64 {
        let mut x = from;
        // From a thirty-second of the shortest wave three steps reach rounding.
        for _ in 0..3 {
            let z = Complex64::from_polar(1.0, x);
            let (mut slope, mut bend, mut turn) = (0.0, 0.0, z);
            for (m, p) in self.phasors.iter().enumerate() {
                let (h, line) = ((2 * m + 1) as f64, p * turn);
                slope += h * line.re;
                bend -= h * h * line.im;
                turn *= z * z;
            }
            let next = x - slope / bend;
            if (next - from).abs() > step || next.is_nan() {
                break;
            }
            x = next;
        }
        self.at(x).abs()
    }

    /// Scales all lines to the peak asked for and notes the crest factor.
    fn scale(&mut self, grid: &[f64]) {
        let peak = self.peak(grid);
        let power: f64 = self.phasors.iter().map(Complex64::norm_sqr).sum();
        self.crest = peak / (0.5 * power).sqrt();
        let factor = self.amplitude / peak;
        self.phasors.iter_mut().for_each(|p| *p *= factor);
    }
}
