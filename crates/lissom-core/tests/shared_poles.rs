//! Poles that all outputs share, against responses whose poles are known.

use std::f64::consts::FRAC_1_SQRT_2;

use lissom::identify::{
    Damping, Pole, Response, SharedPolesError, Spurious, fit_shared_poles,
    fit_shared_poles_by_evidence,
};
use num_complex::Complex64;
use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;

struct Truth {
    poles: Vec<Pole>,
    gains: Vec<Vec<f64>>,
}

impl Truth {
    /// Modes over two decades, lightly damped, in two outputs.
    fn new(modes: usize, random: &mut Xoshiro256PlusPlus) -> Self {
        let mut normal = || -> f64 { StandardNormal.sample(random) };
        let pole = |k: usize, normal: &mut dyn FnMut() -> f64| Pole {
            omega_rad_s: 5.0
                * 200f64.powf(k as f64 / (modes as f64 - 0.5))
                * (1.0 + 0.05 * normal().clamp(-2.0, 2.0)),
            damping_ratio: 0.003 * (1.0 + normal().abs()),
        };
        let poles = (0..modes).map(|k| pole(k, &mut normal)).collect();
        let gain = |normal: &mut dyn FnMut() -> f64| {
            let size = 0.3 + normal().abs();
            size.copysign(normal())
        };
        let gains = (0..2).map(|_| (0..modes).map(|_| gain(&mut normal)).collect()).collect();
        Self { poles, gains }
    }

    fn response(&self, output: usize, omega: f64) -> Complex64 {
        let parts = self.poles.iter().zip(&self.gains[output]);
        parts.map(|(p, g)| g * p.omega_rad_s.powi(2) / p.denominator(omega)).sum()
    }

    /// Responses with noise of a relative deviation.
    fn measured(
        &self,
        omega: &[f64],
        noise: f64,
        random: &mut Xoshiro256PlusPlus,
    ) -> Vec<Vec<Response>> {
        let mut normal = || -> f64 { StandardNormal.sample(random) };
        let mut point = |output: usize, w: f64| {
            let value = self.response(output, w);
            let std = noise * value.norm();
            // √E|Δ|² is √2 times the standard error of either part.
            let error = Complex64::new(normal(), normal()) * (std * FRAC_1_SQRT_2);
            Response { value: value + error, std }
        };
        (0..self.gains.len()).map(|o| omega.iter().map(|w| point(o, *w)).collect()).collect()
    }
}

fn grid(points: usize) -> Vec<f64> {
    (0..points).map(|i| 2000f64.powf(i as f64 / (points - 1) as f64)).collect()
}

#[test]
fn ten_modes_are_found_without_a_start() {
    let omega = grid(1000);
    for seed in 0..8 {
        let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
        let truth = Truth::new(10, &mut random);
        let outputs = truth.measured(&omega, 0.01, &mut random);
        let fit = fit_shared_poles(&omega, &outputs, 10, Damping::Small).unwrap();
        assert!((0.9..1.15).contains(&fit.weighted_rms), "{seed}: {}", fit.weighted_rms);
        for (k, pole) in truth.poles.iter().enumerate() {
            let found = fit.natural_frequency_rad_s(k);
            assert!((found.value - pole.omega_rad_s).abs() < 5.0 * found.std, "{seed}: {found:?}");
            assert!(found.std < 1e-3 * found.value && fit.spurious(k).is_none());
        }
        // Against the truth, not the data: a tenth of the noise.
        let off = |o: usize, w: &f64| {
            let exact = truth.response(o, *w);
            (fit.response(o, *w) - exact).norm_sqr() / (1e-4 * exact.norm_sqr())
        };
        let all: f64 = (0..2).flat_map(|o| omega.iter().map(move |w| off(o, w))).sum();
        assert!((all / 2000.0).sqrt() < 0.2);
    }
}

#[test]
fn exact_responses_are_fitted_exactly() {
    let omega = grid(400);
    for damping in [Damping::Small, Damping::None] {
        let mut random = Xoshiro256PlusPlus::seed_from_u64(3);
        let mut truth = Truth::new(4, &mut random);
        if damping == Damping::None {
            truth.poles.iter_mut().for_each(|p| p.damping_ratio = 0.0);
        }
        let exact = |o: usize, w: &f64| {
            let value = truth.response(o, *w);
            Response { value, std: 1e-3 * value.norm() }
        };
        let outputs: Vec<Vec<Response>> =
            (0..2).map(|o| omega.iter().map(|w| exact(o, w)).collect()).collect();
        let fit = fit_shared_poles(&omega, &outputs, 4, damping).unwrap();
        for (k, pole) in truth.poles.iter().enumerate() {
            let found = fit.poles[k];
            assert!((found.omega_rad_s / pole.omega_rad_s - 1.0).abs() < 1e-9, "{found:?}");
            assert!((found.damping_ratio - pole.damping_ratio).abs() < 1e-9, "{found:?}");
            for o in 0..2 {
                assert!((fit.static_gains[o][k] - truth.gains[o][k]).abs() < 1e-8);
            }
        }
    }
}

#[test]
fn the_order_is_that_of_the_data() {
    let omega = grid(300);
    let mut chosen = Vec::new();
    for seed in 0..12 {
        let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
        let modes = 1 + seed as usize % 4;
        let truth = Truth::new(modes, &mut random);
        let outputs = truth.measured(&omega, 0.02, &mut random);
        let fit = fit_shared_poles_by_evidence(&omega, &outputs, 8, Damping::Small).unwrap();
        chosen.push((modes, fit.poles.len()));
        assert!((0..modes.min(fit.poles.len())).all(|k| fit.spurious(k).is_none()));
    }
    assert!(chosen.iter().all(|(there, found)| there == found), "{chosen:?}");
}

/// 95 % intervals of 60 fits, six estimates each: 360 of which 342 are expected to hold, give or take 4.
#[test]
fn intervals_hold() {
    let omega = grid(120);
    let mut held = 0;
    for seed in 0..60 {
        let mut random = Xoshiro256PlusPlus::seed_from_u64(1000 + seed);
        let truth = Truth::new(2, &mut random);
        let outputs = truth.measured(&omega, 0.03, &mut random);
        let fit = fit_shared_poles(&omega, &outputs, 2, Damping::Small).unwrap();
        for k in 0..2 {
            let estimates = [
                (fit.natural_frequency_rad_s(k), truth.poles[k].omega_rad_s),
                (fit.damping_ratio(k), truth.poles[k].damping_ratio),
                (fit.static_gain(1, k), truth.gains[1][k]),
            ];
            let holds = estimates.iter().filter(|(f, t)| (f.value - t).abs() < 1.96 * f.std);
            held += holds.count();
        }
    }
    assert!((327..=356).contains(&held), "{held} of 360");
}

#[test]
fn a_pole_that_is_none_is_named() {
    let omega = grid(300);
    let mut random = Xoshiro256PlusPlus::seed_from_u64(5);
    let truth = Truth::new(2, &mut random);
    let outputs = truth.measured(&omega, 0.02, &mut random);
    let fit = fit_shared_poles(&omega, &outputs, 3, Damping::Small).unwrap();
    let spurious: Vec<Spurious> = (0..3).filter_map(|k| fit.spurious(k)).collect();
    assert_eq!(spurious.len(), 1, "{spurious:?}");
}

#[test]
fn what_cannot_be_fitted_is_refused() {
    let omega = grid(50);
    let mut random = Xoshiro256PlusPlus::seed_from_u64(1);
    let truth = Truth::new(1, &mut random);
    let good = truth.measured(&omega, 0.01, &mut random);
    let fit = |omega: &[f64], outputs: &[Vec<Response>], modes: usize| {
        fit_shared_poles(omega, outputs, modes, Damping::Small).map(|_| ()).unwrap_err()
    };
    assert_eq!(fit(&omega, &[], 1), SharedPolesError::NoOutput);
    assert_eq!(fit(&omega, &good, 0), SharedPolesError::NoPoles);
    let mut short = good.clone();
    short[1].pop();
    assert_eq!(
        fit(&omega, &short, 1),
        SharedPolesError::Grid { output: 1, found: 49, expected: 50 }
    );
    let mut sure = good.clone();
    sure[0][7].std = 0.0;
    assert_eq!(fit(&omega, &sure, 1), SharedPolesError::Response { output: 0, index: 7 });
    let mut negative = omega.clone();
    negative[3] = -1.0;
    let refused = SharedPolesError::Frequency { index: 3, found_rad_s: -1.0 };
    assert_eq!(fit(&negative, &good, 1), refused);
    assert!(matches!(fit(&omega, &good, 40), SharedPolesError::TooFew { .. }));
}
