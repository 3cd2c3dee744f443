//! Responses of several outputs to one input, with poles that are common to all outputs.

use nalgebra::DMatrix;
use num_complex::Complex64;

use crate::identify::estimate::Estimate;
use crate::identify::responses::correct::Response;
use crate::identify::responses::rational::pole_damping::Damping;
use crate::identify::responses::rational::refine::{PolePoint, refined, refined_with_delays};
use crate::identify::responses::rational::relocate::relocated;
use crate::identify::responses::rational::shared_poles_error::SharedPolesError;
use crate::identify::responses::rational::weighted::Weighted;
use crate::identify::responses::rational::{Pole, information, trial_frequencies};
use crate::identify::responses::thresholds::{MODE_DAMPING_MOST, POOR_FIT};
use crate::identify::thresholds::{CLEARLY_PRESENT, SIGN_SHOWN};

/// Damping ratio of the poles that vector fitting begins with.
const START_DAMPING: f64 = 0.01;
/// Most relocations, and the change of every frequency below which they end: refining does the rest.
const RELOCATIONS: usize = 12;
const NEAR: f64 = 0.02;

/// Reason why a pole is not a mode of the beam: it improves the model at the edges of the range, or stands for noise.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Spurious {
    /// It is outside the measured frequencies.
    Outside,
    /// Its damping ratio is above 0.25, or more than two standard errors below zero.
    Damped,
    /// Its gain is within four standard errors of zero in every output.
    Unfelt,
}

/// Poles that are common to all outputs, and their residues.
///
/// `H_i(s) = e^(−s·τ_i)·Σ_k (ρ_ik·ω_k² + ρ'_ik·ω_k·s)/(s² + 2ζ_kω_k·s + ω_k²)` with real ρ_ik and ρ'_ik. ρ'_ik is zero
/// except with [`Damping::Within`]; it is `2ζ_kρ_ik` if all damping of a mode is within the beam. τ_i is zero unless a
/// delay was searched for.
#[derive(Debug, Clone)]
pub struct SharedPoles {
    /// Poles, ascending in frequency.
    pub poles: Vec<Pole>,
    /// Static gain ρ_ik of output i (outer index) and pole k, in the unit of the response;
    /// their sum is the response at rest.
    pub static_gains: Vec<Vec<f64>>,
    /// ρ'_ik of output i (outer index) and pole k with [`Damping::Within`]; zero otherwise.
    pub in_s: Vec<Vec<Estimate>>,
    /// ζ_w of each pole: of its damping ratio what is within the beam, with the room that the responses leave it;
    /// zero and known where they were not asked.
    pub(crate) within: Vec<Estimate>,
    /// Delay τ_i of each output \[s\], if delays were searched for.
    pub delays_s: Vec<Option<Estimate>>,
    /// Covariance of ln ω_k (and ζ_k if damped), pole by pole, then of ρ_ik, output by output. It follows from the
    /// standard errors of the responses, and is increased if the residuals are larger than these.
    pub covariance: DMatrix<f64>,
    /// Root mean square of the residuals divided by the standard errors of the responses, corrected for the number of
    /// unknowns: about one if the model is as good as the data.
    pub weighted_rms: f64,
    /// Damping that the poles were allowed to have.
    pub damping: Damping,
    /// Lowest and highest measured frequency \[rad/s\].
    pub range_rad_s: (f64, f64),
    /// Bayesian information criterion.
    pub(super) criterion: f64,
}

/// Fits `modes` pairs of poles to the responses of several outputs (outer index) at `omega_rad_s`, weighted with their
/// standard errors.
///
/// No starting values are needed. Poles spread over the measured frequencies are relocated by relaxed vector fitting,
/// and then refined together with the residues by the Gauss-Newton method to maximum likelihood. If the residuals are
/// then larger than the standard errors, or there are too few frequencies for vector fitting, poles are also added one
/// after another.
///
/// ```
/// # use {lissom::identify::{Pole, Response}, num_complex::Complex64};
/// # let omega: Vec<f64> = (0..200).map(|k| 1.03_f64.powi(k)).collect();
/// # let poles = [(6.6, 0.005), (41.0, 0.01)].map(|(omega_rad_s, damping_ratio)| Pole { omega_rad_s, damping_ratio });
/// # let at = |gains: [f64; 2]| omega.iter().map(|&w| { let value: Complex64 = poles.iter().zip(gains).map(|(p, g)| g * p.omega_rad_s.powi(2) / p.denominator(w)).sum(); Response { value, std: 1e-3 * value.norm() } }).collect::<Vec<_>>();
/// # let (middle, tip) = (at([0.7, 0.3]), at([1.2, -0.2]));
/// use lissom::identify::{Damping, fit_shared_poles}; // a beam's middle and tip, modes at 6.6 and 41 rad/s
/// let fit = fit_shared_poles(&omega, &[middle, tip], 2, Damping::Small)?;
/// assert!((fit.poles[1].omega_rad_s - 41.0).abs() < 1e-6 && (fit.static_gains[1][1] + 0.2).abs() < 1e-8);
/// # Ok::<(), lissom::identify::SharedPolesError>(())
/// ```
///
/// # Errors
/// [`SharedPolesError`] if outputs have different frequencies, a response has no standard error, there are more
/// unknowns than values, or the poles cannot be separated.
///
/// # Source
/// `[Feliu1989, eq. (19)]`, step 4 of Section 4: one denominator for all points.
///
/// # Differences from the source
/// Poles may be damped. Residues are real, so a damped mode has the shape of the undamped one.
pub fn fit_shared_poles(
    omega_rad_s: &[f64],
    outputs: &[Vec<Response>],
    modes: usize,
    damping: Damping,
) -> Result<SharedPoles, SharedPolesError> {
    fit(&Weighted::new(omega_rad_s, outputs)?, modes, damping, PoleSearch::Thorough)
}

/// How poles are looked for.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum PoleSearch {
    /// All at once and, where much is left, also one after another.
    Thorough,
    /// One after another only where all at once comes to nothing.
    Quick,
}

pub(super) fn fit(
    data: &Weighted,
    modes: usize,
    damping: Damping,
    search: PoleSearch,
) -> Result<SharedPoles, SharedPolesError> {
    if modes == 0 {
        return Err(SharedPolesError::NoPoles);
    }
    let unknowns = unknowns(data, modes, damping);
    let readings = data.readings();
    // Each pole takes two frequencies to be seen at: its height and its width.
    if unknowns >= readings || 2 * modes > data.omega.len() {
        return Err(SharedPolesError::TooFew { unknowns, readings });
    }
    let found = |at: Option<(Weighted, PolePoint)>| {
        at.and_then(|(data, point)| SharedPoles::of(&data, point, damping))
    };
    // Vector fitting has two unknowns of each pole in every output, and two of each in σ.
    let together = 4 * modes < 2 * data.omega.len();
    let together = together.then(|| found(relocated_and_refined(data, modes, damping))).flatten();
    if let Some(fit) = &together
        && (fit.weighted_rms < POOR_FIT || search == PoleSearch::Quick)
    {
        return together.ok_or(SharedPolesError::NotFound { modes });
    }
    let by_one = found(one_after_another(data, modes, damping));
    let found = together.into_iter().chain(by_one);
    let best = found.min_by(|a, b| a.weighted_rms.total_cmp(&b.weighted_rms));
    best.ok_or(SharedPolesError::NotFound { modes })
}

/// [`information`] with what an unknown costs stretched as the corrected criterion of Akaike has it: with nearly
/// as many unknowns as readings a model describes noise.
///
/// # Source
/// Hurvich and Tsai, Regression and time series model selection in small samples, Biometrika 76 (1989).
fn for_few_readings(readings: usize, unknowns: usize, cost: f64) -> f64 {
    let (n, p) = (readings as f64, unknowns as f64);
    let free = readings.saturating_sub(unknowns + 1) as f64;
    information(readings, unknowns, cost) + p * n.ln() * (n / free - 1.0)
}

/// Estimates of so many poles, their residues and the delays.
fn unknowns(data: &Weighted, modes: usize, damping: Damping) -> usize {
    modes * (damping.unknowns() + data.outputs.len() * damping.terms()) + data.delays()
}

/// The best near `poles`, and the data turned back by its delays.
pub(super) fn best_near(
    data: &Weighted,
    poles: Vec<Pole>,
    damping: Damping,
) -> Option<(Weighted, PolePoint)> {
    let mut data = data.clone();
    let point = if data.delays() > 0 {
        refined_with_delays(&mut data, poles, damping)?
    } else {
        refined(&data, poles, damping)?
    };
    Some((data, point))
}

/// From poles spread over the data.
fn relocated_and_refined(
    data: &Weighted,
    modes: usize,
    damping: Damping,
) -> Option<(Weighted, PolePoint)> {
    let (low, high) = data.range();
    let start = |k: usize| Pole {
        omega_rad_s: low * (high / low).powf((k as f64 + 0.5) / modes as f64),
        damping_ratio: START_DAMPING,
    };
    best_near(data, settled(data, (0..modes).map(start).collect())?, damping)
}

/// One pole after another, each from the best of many frequencies: slower, and for data that hold too
/// little for a relocation, or where one has come to nothing.
fn one_after_another(
    data: &Weighted,
    modes: usize,
    damping: Damping,
) -> Option<(Weighted, PolePoint)> {
    let mut best: Option<(Weighted, PolePoint)> = None;
    for _ in 0..modes {
        let (data, before) = match best {
            Some((data, point)) => (data, point.poles),
            None => (data.clone(), Vec::new()),
        };
        best = best_near(&data, with_one_more(&data, &before, damping)?, damping);
    }
    best
}

/// `poles` and the one, of many frequencies, whose addition lowers the cost most.
pub(super) fn with_one_more(
    data: &Weighted,
    poles: &[Pole],
    damping: Damping,
) -> Option<Vec<Pole>> {
    let with = |omega_rad_s: f64| {
        let more = Pole { omega_rad_s, damping_ratio: START_DAMPING };
        PolePoint::new(data, poles.iter().copied().chain([more]).collect(), damping)
    };
    let found = trial_frequencies(&data.omega).into_iter().filter_map(with);
    Some(found.min_by(|a, b| a.cost.total_cmp(&b.cost))?.poles)
}

/// Relocated until they stand nearly still.
fn settled(data: &Weighted, mut poles: Vec<Pole>) -> Option<Vec<Pole>> {
    for _ in 0..RELOCATIONS {
        let next = relocated(data, &poles)?;
        let change = |(a, b): (&Pole, &Pole)| (a.omega_rad_s / b.omega_rad_s).ln().abs();
        let most = next.iter().zip(&poles).map(change).fold(0.0, f64::max);
        poles = next;
        if most < NEAR {
            break;
        }
    }
    Some(poles)
}

impl SharedPoles {
    pub(super) fn of(data: &Weighted, point: PolePoint, damping: Damping) -> Option<Self> {
        let (readings, modes) = (data.readings(), point.poles.len());
        let unknowns = unknowns(data, modes, damping);
        let free = readings.checked_sub(unknowns).filter(|free| *free > 0)?;
        let weighted_rms = (point.cost / free as f64).sqrt();
        let covariance = point.covariance()? * weighted_rms.max(1.0).powi(2);
        let std = |at: usize| covariance[(at, at)].max(0.0).sqrt();
        let (places, _) = point.places();
        let (mut gains, mut in_s, mut delays_s) = (Vec::new(), Vec::new(), Vec::new());
        for ((estimates, first), output) in
            point.own_estimates.iter().zip(&places).zip(&data.outputs)
        {
            gains.push(estimates.iter().take(modes).copied().collect());
            let term = |k: usize| match damping {
                Damping::Within => {
                    Estimate { value: estimates[modes + k], std: std(first + modes + k) }
                }
                Damping::None | Damping::Small => Estimate { value: 0.0, std: 0.0 },
            };
            in_s.push((0..modes).map(term).collect());
            let last = first + estimates.len() - 1;
            let late = |value: f64| Estimate { value, std: std(last) / data.range().1 };
            delays_s.push(output.delay_s.map(late));
        }
        let poles = 0..modes * damping.unknowns();
        let at: Vec<usize> =
            poles.chain(places.iter().flat_map(|first| *first..first + modes)).collect();
        Some(Self {
            within: vec![Estimate { value: 0.0, std: 0.0 }; modes],
            poles: point.poles,
            static_gains: gains,
            in_s,
            delays_s,
            covariance: covariance.select_rows(&at).select_columns(&at),
            weighted_rms,
            damping,
            range_rad_s: data.range(),
            criterion: for_few_readings(readings, unknowns, point.cost),
        })
    }

    /// Bayesian information criterion, standard errors known but for one factor.
    pub(crate) fn criterion(&self) -> f64 {
        self.criterion
    }

    /// Standard error of unknown `i` of the covariance.
    fn deviation(&self, i: usize) -> f64 {
        self.covariance[(i, i)].max(0.0).sqrt()
    }

    /// Natural frequency of pole `k` \[rad/s\].
    pub fn natural_frequency_rad_s(&self, k: usize) -> Estimate {
        let value = self.poles[k].omega_rad_s;
        Estimate { value, std: value * self.deviation(k * self.damping.unknowns()) }
    }

    /// Damping ratio of pole `k` \[1\]; exactly zero if no damping is allowed.
    pub fn damping_ratio(&self, k: usize) -> Estimate {
        let std = match self.damping {
            Damping::None => 0.0,
            Damping::Small | Damping::Within => self.deviation(k * self.damping.unknowns() + 1),
        };
        Estimate { value: self.poles[k].damping_ratio, std }
    }

    /// Static gain `ρ_ik` of output `i` and pole `k`.
    pub fn static_gain(&self, i: usize, k: usize) -> Estimate {
        let modes = self.poles.len();
        let at = modes * self.damping.unknowns() + i * modes + k;
        Estimate { value: self.static_gains[i][k], std: self.deviation(at) }
    }

    /// Returns this fit with only the given poles and outputs, in the given order. Those that are left out still count
    /// in the standard errors, but their part of the responses is removed. `None` if an index does not exist.
    pub fn only(&self, poles: &[usize], outputs: &[usize]) -> Option<Self> {
        let (modes, unknowns) = (self.poles.len(), self.damping.unknowns());
        let there = |places: &[usize], count: usize| places.iter().all(|p| *p < count);
        if !there(poles, modes) || !there(outputs, self.static_gains.len()) {
            return None;
        }
        let of_poles = poles.iter().flat_map(|k| (0..unknowns).map(move |u| k * unknowns + u));
        let of_gains = outputs
            .iter()
            .flat_map(|i| poles.iter().map(move |k| modes * unknowns + i * modes + k));
        let at: Vec<usize> = of_poles.chain(of_gains).collect();
        let gains = |i: &usize| poles.iter().map(|&k| self.static_gains[*i][k]).collect();
        Some(Self {
            poles: poles.iter().map(|&k| self.poles[k]).collect(),
            static_gains: outputs.iter().map(gains).collect(),
            in_s: outputs
                .iter()
                .map(|i| poles.iter().map(|&k| self.in_s[*i][k]).collect())
                .collect(),
            within: poles.iter().map(|&k| self.within[k]).collect(),
            delays_s: outputs.iter().map(|&i| self.delays_s[i]).collect(),
            covariance: self.covariance.select_rows(&at).select_columns(&at),
            ..self.clone()
        })
    }

    /// Reason why pole `k` is not a mode of the beam; `None` for a mode.
    pub fn spurious(&self, k: usize) -> Option<Spurious> {
        let pole = self.poles[k];
        let (low, high) = self.range_rad_s;
        let damping = self.damping_ratio(k);
        let felt = |i: usize| {
            let gain = self.static_gain(i, k);
            gain.value.abs() > CLEARLY_PRESENT * gain.std
        };
        if !(low..=high).contains(&pole.omega_rad_s) {
            Some(Spurious::Outside)
        } else if damping.value > MODE_DAMPING_MOST || damping.value < -SIGN_SHOWN * damping.std {
            Some(Spurious::Damped)
        } else if !(0..self.static_gains.len()).any(felt) {
            Some(Spurious::Unfelt)
        } else {
            None
        }
    }

    /// Response of output `i` at a frequency.
    pub fn response(&self, i: usize, omega_rad_s: f64) -> Complex64 {
        let prompt = self.with_terms(i, omega_rad_s, |k| self.in_s[i][k].value);
        match self.delays_s[i] {
            Some(late) => prompt * Complex64::from_polar(1.0, -omega_rad_s * late.value),
            None => prompt,
        }
    }

    /// The same without delay, and with of ρ'_ik only what damping of a beam can make it: of ρ_ik's sign and no
    /// larger than `2ζ_kρ_ik`.
    pub(crate) fn damped_response(&self, i: usize, omega_rad_s: f64) -> Complex64 {
        self.with_terms(i, omega_rad_s, |k| {
            let most = 2.0 * self.poles[k].damping_ratio.max(0.0) * self.static_gains[i][k];
            self.in_s[i][k].value.clamp(most.min(0.0), most.max(0.0))
        })
    }

    fn with_terms(&self, i: usize, omega: f64, in_s: impl Fn(usize) -> f64) -> Complex64 {
        let part = |(k, (pole, gain)): (usize, (&Pole, &f64))| {
            let w = pole.omega_rad_s;
            Complex64::new(gain * w * w, in_s(k) * w * omega) / pole.denominator(omega)
        };
        self.poles.iter().zip(&self.static_gains[i]).enumerate().map(part).sum()
    }
}
