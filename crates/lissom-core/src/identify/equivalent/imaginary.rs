//! Imaginary parts that no damping explains: without damping the responses of an arm are real on the imaginary axis.

use num_complex::Complex64;

use crate::identify::equivalent::data::{EquivalentData, StdSource};
use crate::identify::equivalent::refusal::{EquivalentRefusal, PartOutside};
use crate::identify::equivalent::thresholds::{
    IMAGINARY_PRESENT, IMAGINARY_UNLIKE, NOT_OF_AN_ARM, PHASE_SIGN_CERTAIN,
};
use crate::identify::responses::correct::Response;
use crate::identify::responses::rational::{Damping, SharedPoles, Spurious, fit_shared_poles};

/// Of each output that has one: what its imaginary part has beside damping.
///
/// # Errors
/// [`EquivalentRefusal::Uneven`] where it is a tenth of the response or more.
pub(super) fn parts(
    data: &EquivalentData,
    fit: &SharedPoles,
    spurious: &[Option<Spurious>],
) -> Result<Vec<PartOutside>, EquivalentRefusal> {
    // Poles more damped than any of a beam would explain a delay.
    let beams = spurious.iter().filter(|s| **s != Some(Spurious::Damped)).count();
    let damping = if fit.damping == Damping::Within { Damping::Within } else { Damping::Small };
    let refitted = (beams < spurious.len() && beams > 0)
        .then(|| fit_shared_poles(&data.omega_rad_s, &data.outputs, beams, damping).ok());
    let model = refitted.flatten();
    let model = model.as_ref().unwrap_or(fit);
    // What the standard errors are, where they are not known.
    let spread = match data.std_source {
        StdSource::FromResidual => fit.weighted_rms,
        StdSource::Measured | StdSource::Floored => 1.0,
    };
    let (mut told, mut worst): (Vec<PartOutside>, Option<PartOutside>) = (Vec::new(), None);
    for (output, responses) in data.outputs.iter().enumerate() {
        let left = |(w, r): (&f64, &Response)| Left {
            by: r.value - model.damped_response(output, *w),
            value: r.value,
            std: r.std * spread,
        };
        let left: Vec<Left> = data.omega_rad_s.iter().zip(responses).map(left).collect();
        let (imaginary, real) = (rms(&left, |d| d.im), rms(&left, |d| d.re));
        let unlike =
            data.std_source == StdSource::FromResidual && imaginary > IMAGINARY_UNLIKE * real;
        let clear = imaginary > real && (imaginary > IMAGINARY_PRESENT || unlike);
        let late = fit.delays_s.get(output).copied().flatten();
        let late = late.filter(|late| late.value.abs() > IMAGINARY_PRESENT * late.std);
        if !(clear || late.is_some() || turned(&left)) {
            continue;
        }
        let part = PartOutside {
            name: data.names.get(output).cloned().unwrap_or_default(),
            share: share(&left),
            standard_errors: (data.std_source != StdSource::FromResidual).then_some(imaginary),
            delay_s: late,
        };
        let larger = worst.as_ref().is_none_or(|w| w.share < part.share);
        if clear && part.share > NOT_OF_AN_ARM && larger {
            worst = Some(part.clone());
        }
        told.push(part);
    }
    worst.map_or(Ok(told), |part| Err(EquivalentRefusal::Uneven(part)))
}

/// What damping leaves of a response.
struct Left {
    by: Complex64,
    value: Complex64,
    std: f64,
}

/// Root mean square of one part, in its deviations.
fn rms(left: &[Left], part: fn(&Complex64) -> f64) -> f64 {
    let squares = left.iter().map(|l| 2.0 * (part(&l.by) / l.std).powi(2));
    (squares.sum::<f64>() / left.len().max(1) as f64).sqrt()
}

/// The imaginary part's share of a response, median.
fn share(left: &[Left]) -> f64 {
    let shares = left.iter().map(|l| l.by.im.abs() / l.value.norm());
    let mut shares: Vec<f64> = shares.filter(|s| s.is_finite()).collect();
    shares.sort_by(f64::total_cmp);
    shares.get(shares.len() / 2).copied().unwrap_or(0.0)
}

/// Whether the residuals d of the responses H are a constant phase shift: whether `ΣIm(d·H*)/σ²` differs from zero by many of its
/// standard errors.
fn turned(left: &[Left]) -> bool {
    let (mut across, mut spread) = (0.0, 0.0);
    for l in left {
        let weight = l.std.powi(-2);
        let turn = (l.by * l.value.conj()).im;
        across += weight * turn;
        spread += (weight * turn).powi(2);
    }
    across.abs() > PHASE_SIGN_CERTAIN * spread.sqrt()
}
