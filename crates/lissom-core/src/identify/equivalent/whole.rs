//! Section 4 from measured responses to the arm, with checks of each step.

use nalgebra::DMatrix;

use crate::identify::equivalent::data::{Equivalent, EquivalentData, StdSource, relative_residual};
use crate::identify::equivalent::equivalent_arm::arm_below;
use crate::identify::equivalent::refusal::EquivalentRefusal;
use crate::identify::equivalent::sound::sound;
use crate::identify::equivalent::thresholds::{NO_ANGLE, OUTSIDE_DAMPING_MOST, POLE_IN_TORQUE};
use crate::identify::equivalent::turned_round::turned_round;
use crate::identify::equivalent::zeros::response_zeros;
use crate::identify::equivalent::{
    EquivalentError, equivalent_beam, findings, imaginary, standard_errors,
};
use crate::identify::findings::{Finding, rows};
use crate::identify::responses::correct::Response;
use crate::identify::responses::rational::{
    MotorData, Pole, SharedPoles, Spurious, fit_shared_poles_with_delays, information,
};
use crate::identify::responses::thresholds::MODE_DAMPING_MOST;
use crate::identify::thresholds::SIGN_SHOWN;

/// Pairs of poles looked for, whatever the number of points.
const POLES_LEAST: usize = 8;

/// Computes the equivalent arm: steps 1 to 6 of Section 4 of the 1989 report.
///
/// Poles are fitted as the data require, and those that are not modes are removed. The points that separate the modes
/// best are kept, as many as there are modes. Then Â and B̂ follow (step 5) and, with the motor's response, Ĥ, ĥ, J and
/// V (step 6). With `modes` only that many of the lowest modes are kept.
///
/// # Errors
/// [`EquivalentRefusal`], with the reason and a hint.
///
/// # Source
/// `[Feliu1989, Section 4]`
pub fn equivalent(
    data: &EquivalentData,
    modes: Option<usize>,
) -> Result<Equivalent, EquivalentRefusal> {
    let (points, names) = (data.outputs.len(), data.names.len());
    if points != names {
        return Err(EquivalentRefusal::Names { names, points });
    }
    sound(data)?;
    let most = POLES_LEAST.max(2 * points + 2);
    let fit = fit_shared_poles_with_delays(&data.omega_rad_s, &data.outputs, most)
        .map_err(|source| EquivalentRefusal::Fit { source, names: data.names.clone() });
    let found = fit.and_then(|fit| match data.std_source {
        StdSource::FromResidual => {
            let (outputs, fit) = standard_errors::of_points(data, fit, most);
            judged(&EquivalentData { outputs, ..data.clone() }, fit, modes)
        }
        StdSource::Measured | StdSource::Floored => judged(data, fit, modes),
    });
    let suspect = match &found {
        Err(refusal) => refusal.may_be_a_turned_phase(),
        Ok(whole) => whole.may_be_a_turned_phase(),
    };
    let turned = if suspect { turned_round(data) } else { Vec::new() };
    if turned.is_empty() { found } else { Err(EquivalentRefusal::TurnedRound { names: turned }) }
}

/// Of sound numbers.
fn judged(
    data: &EquivalentData,
    fit: SharedPoles,
    modes: Option<usize>,
) -> Result<Equivalent, EquivalentRefusal> {
    let points = data.outputs.len();
    let spurious: Vec<Option<Spurious>> = (0..fit.poles.len()).map(|k| fit.spurious(k)).collect();
    let found: Vec<usize> = (0..spurious.len()).filter(|k| spurious[*k].is_none()).collect();
    if found.is_empty() || is_noise(data, &fit) {
        let outside = spurious.iter().all(|s| *s == Some(Spurious::Outside));
        return Err(if outside && !is_noise(data, &fit) {
            EquivalentRefusal::NoModeWithin { range_rad_s: fit.range_rad_s }
        } else {
            EquivalentRefusal::Noise { poles: fit.poles.len() }
        });
    }
    let imaginary = imaginary::parts(data, &fit, &spurious)?;
    let kept_modes: Vec<usize> =
        found.iter().copied().take(modes.unwrap_or(found.len()).max(1)).collect();
    let count = kept_modes.len();
    if points < count {
        let modes_rad_s = kept_modes.iter().map(|&k| fit.poles[k].omega_rad_s).collect();
        return Err(EquivalentRefusal::FewerPoints { points, modes_rad_s });
    }
    let chosen = told_apart(&fit, &kept_modes, points);
    let every: Vec<usize> = (0..points).collect();
    let Some(kept) = fit.only(&kept_modes, &chosen) else {
        return Err(EquivalentRefusal::Noise { poles: fit.poles.len() });
    };
    let refused = |source| EquivalentRefusal::Beam {
        source,
        names: chosen.iter().map(|&i| data.names[i].clone()).collect(),
        modes_rad_s: kept.poles.iter().map(|p| p.omega_rad_s).collect(),
    };
    let beam = equivalent_beam(&kept).map_err(refused)?;
    let above: Vec<usize> = (0..fit.poles.len())
        .filter(|&k| {
            let above = fit.poles[k].omega_rad_s > fit.range_rad_s.1;
            above && spurious[k] == Some(Spurious::Outside)
        })
        .collect();
    let beyond: Vec<Pole> = above.iter().filter_map(|&k| in_the_torque(&fit, k)).collect();
    // A mode left out moves zeros within the frequencies, too.
    let shown: Vec<usize> = found.iter().chain(&above).copied().collect();
    let Some(all) = fit.only(&shown, &every) else {
        return Err(EquivalentRefusal::Noise { poles: fit.poles.len() });
    };
    let with = |motor: &MotorData| match data.std_source {
        StdSource::FromResidual => {
            arm_below(&kept, &standard_errors::of_motor(motor, &kept, &beyond), &beyond)
        }
        StdSource::Measured | StdSource::Floored => arm_below(&kept, motor, &beyond),
    };
    let arm = data.motor.as_ref().map(with).transpose();
    let (arm, no_torque) = match arm {
        Ok(arm) => (arm, None),
        Err(
            error @ (EquivalentError::MotorTooFew { .. } | EquivalentError::MotorResponse { .. }),
        ) => (None, Some(error)),
        Err(error) => return Err(refused(error)),
    };
    let form = match &arm {
        Some(arm) => arm.strainless(),
        None => beam.strainless(&[]),
    };
    // Turned slowly, points that are no angles would not turn with the motor: there is no form for use.
    let given = beam.given();
    let strainless = form.filter(|_| given <= NO_ANGLE);
    let mut whole = Equivalent {
        relative_residual: relative_residual(data, &fit),
        names: data.names.clone(),
        zeros: (0..points).map(|i| response_zeros(&all, i)).collect(),
        fit,
        spurious,
        modes: kept_modes,
        points: chosen,
        kept,
        beam,
        arm,
        strainless,
        imaginary,
        std_source: data.std_source,
        findings: Vec::new(),
    };
    whole.findings = findings::findings(data, &whole, found.len(), given, no_torque);
    Ok(whole)
}

impl Equivalent {
    /// Whether what is odd about it may come of a phase's sign.
    fn may_be_a_turned_phase(&self) -> bool {
        let below = |k: usize| {
            let ratio = self.fit.damping_ratio(k);
            ratio.value < -SIGN_SHOWN * ratio.std
        };
        self.imaginary.iter().any(|part| part.delay_s.is_none())
            || self.findings.iter().any(Finding::is::<rows::EquivalentMisfit>)
            || (0..self.fit.poles.len()).any(below)
    }
}

/// A pole above the frequencies as the motor's torque has it; `None` where it has none of its own.
fn in_the_torque(fit: &SharedPoles, k: usize) -> Option<Pole> {
    let pole = fit.poles[k];
    let known = (0.0..OUTSIDE_DAMPING_MOST).contains(&pole.damping_ratio);
    let damping_ratio = if known { pole.damping_ratio } else { 0.0 };
    let near = pole.omega_rad_s < POLE_IN_TORQUE * fit.range_rad_s.1;
    (near && pole.damping_ratio.abs() < MODE_DAMPING_MOST).then_some(Pole { damping_ratio, ..pole })
}

/// Whether nothing at all describes the responses as well as the fit does.
fn is_noise(data: &EquivalentData, fit: &SharedPoles) -> bool {
    let readings = 2 * data.omega_rad_s.len() * data.outputs.len();
    let unknowns = fit.covariance.nrows();
    let part = |r: &Response| 2.0 * r.value.norm_sqr() / (r.std * r.std);
    let nothing: f64 = data.outputs.iter().flatten().map(part).sum();
    let left = fit.weighted_rms.powi(2) * readings.saturating_sub(unknowns) as f64;
    information(readings, 0, nothing) <= information(readings, unknowns, left)
}

/// As many points as modes, those that span the most: one after the other the point whose gains are farthest
/// from what the chosen ones have, each mode in its own size.
fn told_apart(fit: &SharedPoles, modes: &[usize], points: usize) -> Vec<usize> {
    let mut gains = DMatrix::from_fn(points, modes.len(), |i, k| fit.static_gains[i][modes[k]]);
    if points <= modes.len() {
        return (0..points).collect();
    }
    for mut column in gains.column_iter_mut() {
        let size = column.norm();
        if size > 0.0 {
            column /= size;
        }
    }
    let mut chosen: Vec<usize> = Vec::new();
    while chosen.len() < modes.len() {
        let free = (0..points).filter(|i| !chosen.contains(i));
        let farthest = free.max_by(|a, b| gains.row(*a).norm().total_cmp(&gains.row(*b).norm()));
        let Some(next) = farthest else { break };
        let direction = gains.row(next).normalize();
        for mut row in gains.row_iter_mut() {
            let along = row.dot(&direction);
            row -= &direction * along;
        }
        chosen.push(next);
    }
    chosen.sort_unstable();
    chosen
}
