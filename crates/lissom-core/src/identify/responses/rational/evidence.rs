//! Number of poles that responses require, and their kind of damping.

use crate::identify::estimate::Estimate;
use crate::identify::responses::correct::Response;
use crate::identify::responses::rational::Pole;
use crate::identify::responses::rational::pole_damping::Damping;
use crate::identify::responses::rational::shared_poles::{PoleSearch, SharedPoles, best_near, fit};
use crate::identify::responses::rational::shared_poles_error::SharedPolesError;
use crate::identify::responses::rational::weighted::Weighted;
use crate::identify::responses::thresholds::{CRITERION_CALLED_FOR, POLES_IN_VAIN};

/// What is left is rounding below this share of the responses.
const ROUNDING: f64 = 1e-10;

/// Like [`fit_shared_poles`](super::fit_shared_poles), with the number of pole pairs, up to `most`, that has the lowest
/// Bayesian information criterion. No pair is added to a model that is already as good as its data.
///
/// # Errors
/// Those of [`fit_shared_poles`](super::fit_shared_poles) with one pair of poles.
pub fn fit_shared_poles_by_evidence(
    omega_rad_s: &[f64],
    outputs: &[Vec<Response>],
    most: usize,
    damping: Damping,
) -> Result<SharedPoles, SharedPolesError> {
    by_evidence(&Weighted::new(omega_rad_s, outputs)?, most, damping, PoleSearch::Thorough)
}

/// The same with [`Damping::Small`], and where the data call for it with a delay of each output, or with terms
/// in s in the residues.
///
/// To first order a delay is such terms, `ρ'_ik = −τ_i·ω_k·ρ_ik`: both at once cannot be told apart. Where both
/// would do, terms that damping of a beam can make are taken for them.
pub(crate) fn fit_shared_poles_with_delays(
    omega_rad_s: &[f64],
    outputs: &[Vec<Response>],
    most: usize,
) -> Result<SharedPoles, SharedPolesError> {
    let data = Weighted::new(omega_rad_s, outputs)?;
    let plain = by_evidence(&data, most, Damping::Small, PoleSearch::Thorough)?;
    if left_of(&data, &plain) < ROUNDING {
        return Ok(plain);
    }
    // What either explains needs no poles of its own.
    let most = plain.poles.len();
    let called_for = |f: &SharedPoles| f.criterion < plain.criterion - CRITERION_CALLED_FOR;
    let fitted = |data: &Weighted, damping: Damping| {
        by_evidence(data, most, damping, PoleSearch::Quick).ok().filter(called_for)
    };
    let late = fitted(&data.with_delays(), Damping::Small);
    let within = fitted(&data, Damping::Within);
    Ok(match (late, within) {
        (Some(late), Some(within)) => {
            let handicap =
                if within.damps() { CRITERION_CALLED_FOR } else { -CRITERION_CALLED_FOR };
            let taken = within.criterion < late.criterion + handicap;
            if taken { within.counting_hidden_delays() } else { late.may_damp_within() }
        }
        (None, Some(within)) => within.counting_hidden_delays(),
        (Some(late), None) => late.may_damp_within(),
        (None, None) => {
            let near = best_near(&data, plain.poles.clone(), Damping::Within);
            let within =
                near.and_then(|(data, point)| SharedPoles::of(&data, point, Damping::Within));
            match within {
                Some(within) => SharedPoles { within: within.rooms(), ..plain },
                None => plain.may_damp_within(),
            }
        }
    })
}

/// What a fit leaves, as a share of the responses.
fn left_of(data: &Weighted, fit: &SharedPoles) -> f64 {
    let squares: f64 = data.outputs.iter().map(super::weighted::Output::squares).sum();
    fit.weighted_rms * (data.readings() as f64 / squares).sqrt()
}

fn by_evidence(
    data: &Weighted,
    most: usize,
    damping: Damping,
    search: PoleSearch,
) -> Result<SharedPoles, SharedPolesError> {
    let mut best = fit(data, 1, damping, search);
    let mut in_vain = 0;
    for modes in 2..=most {
        let good = |f: &SharedPoles| f.weighted_rms <= 1.0 || left_of(data, f) < ROUNDING;
        if best.as_ref().is_ok_and(good) || in_vain == POLES_IN_VAIN {
            break;
        }
        match fit(data, modes, damping, search) {
            Ok(found) if best.as_ref().is_ok_and(|b| found.criterion >= b.criterion) => {
                in_vain += 1;
            }
            Ok(found) => (best, in_vain) = (Ok(found), 0),
            Err(_) => in_vain += 1,
        }
    }
    best
}

impl SharedPoles {
    /// ζ_w of each pole: of its damping ratio what is within the beam, `ρ'_ik = 2ζ_w·ρ_ik` over all outputs, and no
    /// farther from none and all than that leaves room for.
    fn rooms(&self) -> Vec<Estimate> {
        let room = |k: usize| {
            let (mut across, mut size) = (0.0, 0.0);
            for (terms, gains) in self.in_s.iter().zip(&self.static_gains) {
                let weight = terms[k].std.powi(-2);
                across += weight * terms[k].value * gains[k];
                size += 2.0 * weight * gains[k] * gains[k];
            }
            let most = self.poles[k].damping_ratio.max(0.0);
            let (value, std) = (across / size, (2.0 * size).sqrt().recip());
            if value.is_finite() && std.is_finite() {
                Estimate { value: value.clamp(0.0, most), std: std.min(most) }
            } else {
                Estimate { value: 0.0, std: most }
            }
        };
        (0..self.poles.len()).map(room).collect()
    }

    /// Nothing is known of ζ_w but that damping has two ends: responses with a delay do not tell it.
    fn may_damp_within(mut self) -> Self {
        let room = |p: &Pole| Estimate { value: 0.0, std: p.damping_ratio.max(0.0) };
        self.within = self.poles.iter().map(room).collect();
        self
    }

    /// Largest delay of output `i` \[s\] that terms in s leave room for: with `2ζ_w = ρ'_ik/ρ_ik + τ_i·ω_k` the damping
    /// within the beam stays between none and all of every mode.
    pub(crate) fn hidden_delay_s(&self, i: usize) -> f64 {
        let (mut early, mut late) = (f64::INFINITY, f64::INFINITY);
        for k in (0..self.poles.len()).filter(|k| self.spurious(*k).is_none()) {
            let (pole, gain) = (self.poles[k], self.static_gains[i][k]);
            let (ratio, std) = (self.in_s[i][k].value / gain, (self.in_s[i][k].std / gain).abs());
            let most = 2.0 * pole.damping_ratio.max(0.0);
            if (ratio + std).is_finite() {
                early = early.min((ratio + std).max(0.0) / pole.omega_rad_s);
                late = late.min((most - ratio + std).max(0.0) / pole.omega_rad_s);
            }
        }
        let most = early.max(late);
        if most.is_finite() { most } else { 0.0 }
    }

    /// Gains' standard errors with what such a delay does to them beside terms in s, `ρ_ik·(τ_i·ω_k)²/2`.
    fn counting_hidden_delays(mut self) -> Self {
        self.within = self.rooms();
        let modes = self.poles.len();
        for i in 0..self.static_gains.len() {
            let late_s = self.hidden_delay_s(i);
            let each = self.static_gains[i].iter().zip(&self.poles);
            let error: Vec<f64> =
                each.map(|(g, p)| 0.5 * g * (late_s * p.omega_rad_s).powi(2)).collect();
            let first = modes * (self.damping.unknowns() + i);
            for (k, a) in error.iter().enumerate() {
                for (l, b) in error.iter().enumerate() {
                    self.covariance[(first + k, first + l)] += a * b;
                }
            }
        }
        self
    }

    /// Whether damping of a beam can make the terms in s what they are, within three deviations.
    fn damps(&self) -> bool {
        let each = self.in_s.iter().zip(&self.static_gains);
        each.flat_map(|(terms, gains)| terms.iter().zip(gains).zip(&self.poles)).all(
            |((term, gain), pole)| {
                let most = 2.0 * pole.damping_ratio.max(0.0) * gain;
                let room = 3.0 * term.std;
                (most.min(0.0) - room..=most.max(0.0) + room).contains(&term.value)
            },
        )
    }
}
