//! Detects responses whose phase has the wrong sign: their complex conjugates fit poles with positive damping.

use num_complex::Complex64;

use crate::identify::equivalent::data::EquivalentData;
use crate::identify::equivalent::thresholds::{CONJUGATE_LEAVES, PHASE_SIGN_CERTAIN};
use crate::identify::responses::correct::Response;
use crate::identify::responses::rational::{
    Damping, SharedPoles, Spurious, fit_shared_poles, fit_shared_poles_by_evidence,
};

/// Pairs of poles of one response at most.
const POLES: usize = 4;

/// Names of the points whose responses fit clearly better conjugated.
pub(super) fn turned_round(data: &EquivalentData) -> Vec<String> {
    let each = data.names.iter().zip(&data.outputs);
    let turned = each.filter(|(_, output)| is_turned(&data.omega_rad_s, output));
    turned.map(|(name, _)| name.clone()).collect()
}

fn is_turned(omega_rad_s: &[f64], output: &[Response]) -> bool {
    let conjugated = |r: &Response| Response { value: Complex64::conj(&r.value), ..*r };
    let conjugated: Vec<Response> = output.iter().map(conjugated).collect();
    let by_evidence = |output: &[Response]| {
        let outputs = [output.to_vec()];
        fit_shared_poles_by_evidence(omega_rad_s, &outputs, POLES, Damping::Small).ok()
    };
    let Some(other) = by_evidence(&conjugated).filter(|f| damped(f, 1.0)) else { return false };
    // As it is, with as many poles: they may have gone below zero themselves.
    let outputs = [output.to_vec()];
    let own = fit_shared_poles(omega_rad_s, &outputs, other.poles.len(), Damping::Small).ok();
    own.is_none_or(|own| {
        damped(&own, -1.0) || other.weighted_rms < CONJUGATE_LEAVES * own.weighted_rms
    })
}

/// Whether poles within the frequencies that are felt have damping whose sign is known and this one, and none
/// the other.
fn damped(fit: &SharedPoles, sign: f64) -> bool {
    let beams = (0..fit.poles.len()).filter(|&k| {
        let ratio = fit.damping_ratio(k).value;
        !matches!(fit.spurious(k), Some(Spurious::Outside | Spurious::Unfelt)) && ratio.abs() < 1.0
    });
    let known = |k: &usize| {
        let ratio = fit.damping_ratio(*k);
        if ratio.value.abs() > PHASE_SIGN_CERTAIN * ratio.std { sign * ratio.value } else { 0.0 }
    };
    let signs: Vec<f64> = beams.map(|k| known(&k)).collect();
    signs.iter().any(|s| *s > 0.0) && signs.iter().all(|s| *s >= 0.0)
}
