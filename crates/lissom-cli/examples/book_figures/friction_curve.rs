//! `friction-curve.svg`: friction against speed, without a law and under the law chosen.

use lissom::drive::{Coulomb, DryFriction, Falloff};
use lissom::identify::{Effort, NORMAL_95, Options, identify};
use lissom::rig::{FrictionWander, JointFriction};
use lissom_report::{Axis, LinePlot, Role, Trace};

use crate::Drawn;
use crate::arms::noisy_rig;
use crate::experiments::{campaign, even, settled_sine};

/// Friction at rest, over that at speed, and the speed over which it falls off \[rad/s\].
const REST_RATIO: f64 = 1.5;
const FALLOFF_RAD_S: f64 = 1.0;
/// Standard deviation of a slow change of all dry friction \[1\], and its correlation time \[s\].
const WANDER: (f64, f64) = (0.03, 1.0);
/// Frequency \[rad/s\] and amplitude \[rad\] of the sines.
const SINES: [(f64, f64); 6] =
    [(1.0, 0.5), (1.0, 1.0), (1.7, 1.0), (3.1, 1.0), (3.9, 1.0), (9.3, 0.5)];
const RECORD_S: f64 = 20.0;
/// Noise of both angles \[rad\].
const NOISE_RAD: f64 = 5e-4;
const SEED: u64 = 200;
/// Points of a line.
const LINE: usize = 300;

/// Estimates with 95 % intervals, the law chosen, and the truth.
pub(crate) fn figure() -> Drawn {
    let mut rig = noisy_rig(NOISE_RAD)?;
    let sliding = rig.arm.coulomb;
    let rest = Coulomb::symmetric(REST_RATIO * sliding.forward())?;
    let law = DryFriction::from(sliding).with_rest(rest, FALLOFF_RAD_S, Falloff::Exponential)?;
    rig.scene.friction = JointFriction::Dry(law.clone());
    rig.scene.wander = Some(FrictionWander::new(WANDER.0, WANDER.1)?);
    let sine = |(omega, amplitude)| settled_sine(omega, amplitude, RECORD_S);
    let experiments = SINES.into_iter().map(sine).collect::<Result<Vec<_>, _>>()?;
    let campaign = campaign(&rig, &experiments, SEED)?;
    let options = Options { effort: Effort::Quick, ..Options::default() };
    let found = identify(&campaign, &options, |_| ())?.friction_law.ok_or("no friction law")?;
    let points: Vec<_> = found.curve.iter().filter(|p| p.direction > 0.0).collect();
    let [slowest, fastest] = found.speed_range;
    let viscous = rig.arm.motor.viscous_nm_s_per_rad();
    let all = even(0.0, fastest, LINE);
    let truth = all.iter().map(|v| law.at(*v, 0.0).forward() + viscous * v).collect();
    let speeds = even(slowest, fastest, LINE);
    let chosen: Option<Vec<f64>> = speeds.iter().map(|v| found.chosen.friction(*v, 1.0)).collect();
    let plot = LinePlot::new(
        "Friction against speed, forward",
        Axis::linear("speed (rad/s)"),
        Axis::linear("friction torque (N·m)"),
    )
    .subtitle(format!(
        "{} runs; friction changes by {:.0} % (rms) from stroke to stroke. Bars: 95 % intervals",
        SINES.len(),
        100.0 * WANDER.0
    ))
    .trace(Trace::line("truth", Role::Truth, all, truth))
    .trace(Trace::line("law chosen", Role::Fitted, speeds, chosen.ok_or("no figures")?))
    .trace(Trace::points_with_bars(
        "estimate without a law",
        Role::Corrected,
        points.iter().map(|p| p.speed).collect(),
        points.iter().map(|p| p.friction.value).collect(),
        points.iter().map(|p| NORMAL_95 * p.friction.std).collect(),
    ));
    Ok(Box::new(plot))
}
