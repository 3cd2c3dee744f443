//! `separability.svg`: a campaign that separates inertia from coupling, and one that hardly does.

use std::error::Error;

use lissom::identify::{Method, Options, OutputError, identify};
use lissom::replay::Parameter;
use lissom::rig::Rig;
use lissom_report::{Axis, LinePlot, Role, Trace, TraceStyle};

use crate::Drawn;
use crate::arms::noisy_rig;
use crate::experiments::{campaign, even, settled_sine};

const AMPLITUDE_RAD: f64 = 0.3;
/// Time logged of a campaign, all runs together \[s\].
const RECORD_S: f64 = 40.0;
/// Noise of both angles \[rad\].
const NOISE_RAD: f64 = 3e-4;
const SEED: u64 = 500;
/// Square of the radius that holds 95 % of a normal distribution in two dimensions, in standard deviations: −2·ln 0.05.
const RADIUS_SQUARE: f64 = 5.991_464_547;
/// Points of an ellipse.
const LINE: usize = 200;

/// Confidence ellipses of inertia and coupling, as standard errors from the truth.
pub(crate) fn figure() -> Drawn {
    let rig = noisy_rig(NOISE_RAD)?;
    let truth = [rig.arm.motor.inertia_kg_m2(), rig.arm.dynamics().coupling_motor];
    let mode = rig.arm.beam().natural_frequencies_rad_s()[0];
    let mut plot = LinePlot::new(
        "Inertia and coupling: regions of 95 % confidence",
        Axis::linear("inertia, difference from the true value (%)"),
        Axis::linear("coupling, difference (%)"),
    )
    .subtitle(format!("Sines of {AMPLITUDE_RAD} rad, {RECORD_S} s in all, sensor noise {NOISE_RAD} rad; the beam's mode is at {mode:.2} rad/s"));
    let campaigns: [(&str, Role, &[f64]); 3] = [
        ("one sine at 3 rad/s", Role::Raw, &[3.0]),
        ("one sine at 12 rad/s", Role::Other(0), &[12.0]),
        ("both sines", Role::Corrected, &[3.0, 12.0]),
    ];
    for (label, role, omega) in campaigns {
        let found = found(&rig, omega)?;
        let (x, y) = ellipse(&found, truth)?;
        plot = plot.trace(Trace::line(label, role, x, y));
    }
    let centre = Trace::new("true values", Role::Truth, TraceStyle::Points, vec![0.0], vec![0.0]);
    Ok(Box::new(plot.trace(centre)))
}

fn found(rig: &Rig, omega: &[f64]) -> Result<OutputError, Box<dyn Error>> {
    let sine = |w: &f64| settled_sine(*w, AMPLITUDE_RAD, RECORD_S / omega.len() as f64);
    let experiments = omega.iter().map(sine).collect::<Result<Vec<_>, _>>()?;
    let campaign = campaign(rig, &experiments, SEED)?;
    let found = identify(&campaign, &Options::default(), |_| ())?;
    if found.method != Some(Method::OutputError) {
        return Err("the output error is rejected".into());
    }
    Ok(found.output_error.ok_or("no solution")?)
}

/// The ellipse in percent of the true values.
fn ellipse(found: &OutputError, truth: [f64; 2]) -> Result<(Vec<f64>, Vec<f64>), Box<dyn Error>> {
    let free = [Parameter::Inertia, Parameter::Stiffness(0)];
    let place = |p: &Parameter| found.parameters.iter().position(|q| q == p).ok_or("not free");
    let (i, j) = (place(&free[0])?, place(&free[1])?);
    let share = |k: usize| 100.0 * (free[k].of(&found.arm) / truth[k] - 1.0);
    let scale = truth.map(|t| 100.0 / t);
    let a = found.covariance[(i, i)].sqrt() * scale[0];
    let b = found.covariance[(i, j)] * scale[0] * scale[1] / a;
    let c = (found.covariance[(j, j)] * scale[1] * scale[1] - b * b).max(0.0).sqrt();
    let point = |turn: f64| {
        let (sine, cosine) = turn.sin_cos();
        let radius = RADIUS_SQUARE.sqrt();
        (share(0) + radius * a * cosine, share(1) + radius * (b * cosine + c * sine))
    };
    Ok(even(0.0, std::f64::consts::TAU, LINE).into_iter().map(point).unzip())
}
