//! `arm-bode.svg` and `corrected-response.svg`: frequency responses of the demo's arm.

use lissom::arm::Arm;
use lissom::identify::{Effort, Options, Response, identify};
use lissom_report::{BodePlot, Role, Series, Style};
use num_complex::Complex64;

use crate::Drawn;
use crate::arms::{demo_rig, noisy_rig};
use crate::experiments::{campaign, merged, ratios, settled_sine};

/// Points of a line.
const LINE: usize = 700;

fn line(arm: &Arm, (low, high): (f64, f64)) -> (Vec<f64>, Vec<Complex64>) {
    let omega = merged(ratios(low, high, LINE), arm.beam().natural_frequencies_rad_s());
    let response = omega.iter().map(|w| arm.motor_response(*w)).collect();
    (omega, response)
}

/// θ_m/i and θ_t/i without Coulomb friction.
pub(crate) fn arm() -> Drawn {
    let arm = demo_rig()?.arm;
    let (omega, motor) = line(&arm, (0.5, 100.0));
    let tip = omega.iter().zip(&motor).map(|(w, m)| arm.tip_response(*w)[0] * m).collect();
    let plot = BodePlot::new("Motor angle and tip angle per current", "rad/A")
        .subtitle(format!("Arm of one mass without Coulomb friction: θ_m/i has zeros at {:.2} rad/s, the beam's frequency with the motor clamped; θ_t/i has none.", arm.beam().natural_frequencies_rad_s()[0]))
        .series(Series::new("motor, θ_m/i", Role::Corrected, Style::Line, omega.clone(), motor))
        .series(Series::new("tip, θ_t/i", Role::Raw, Style::Line, omega, tip));
    Ok(Box::new(plot))
}

/// Frequencies, each also driven at its triple \[rad/s\].
const OMEGA_RAD_S: [f64; 7] = [1.7, 2.5, 3.1, 3.9, 5.1, 7.8, 9.3];
const AMPLITUDE_RAD: f64 = 1.0;
/// Noise of both angles \[rad\].
const NOISE_RAD: f64 = 5e-4;
const PERIODS: f64 = 12.0;
const SEED: u64 = 100;

/// The motor's response as measured, corrected for Coulomb friction, and true.
pub(crate) fn corrected() -> Drawn {
    let rig = noisy_rig(NOISE_RAD)?;
    let driven = OMEGA_RAD_S.into_iter().chain(OMEGA_RAD_S.map(|w| 3.0 * w));
    let sine = |w: f64| settled_sine(w, AMPLITUDE_RAD, PERIODS * std::f64::consts::TAU / w);
    let experiments = driven.map(sine).collect::<Result<Vec<_>, _>>()?;
    let campaign = campaign(&rig, &experiments, SEED)?;
    let options = Options { effort: Effort::Quick, ..Options::default() };
    let found = identify(&campaign, &options, |_| ())?;
    let omega: Vec<f64> = found.responses.iter().map(|p| p.omega_rad_s).collect();
    let raw: Vec<Complex64> = found.responses.iter().map(|p| p.motor_raw.value).collect();
    let corrected: Option<Vec<Response>> =
        found.responses.iter().map(|p| p.motor_corrected).collect();
    let corrected = corrected.ok_or("friction is not found")?;
    let value = corrected.iter().map(|r| r.value).collect();
    let std = corrected.iter().map(|r| r.std).collect();
    let (exact_omega, exact) = line(&rig.arm, (omega[0] / 1.1, omega[omega.len() - 1] * 1.1));
    let plot = BodePlot::new("Response of the motor, corrected for Coulomb friction", "rad/A")
        .subtitle(format!(
            "Sines of {AMPLITUDE_RAD} rad, sensor noise {NOISE_RAD} rad. Bars: one standard error"
        ))
        .series(Series::new("true", Role::Truth, Style::Line, exact_omega, exact))
        .series(Series::new("as measured", Role::Raw, Style::Points, omega.clone(), raw))
        .series(
            Series::new("corrected", Role::Corrected, Style::PointsWithBars, omega, value)
                .with_std(std),
        );
    Ok(Box::new(plot))
}
