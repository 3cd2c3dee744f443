//! `constant-velocity.svg`: the torque that keeps up a constant velocity.

use lissom::drive::Coulomb;
use lissom::identify::{NORMAL_95, Prepared, constant_velocity};
use lissom::rig::{Drive, Experiment, Reference};
use lissom_report::{Axis, LinePlot, Role, Trace, TraceStyle, significant};

use crate::Drawn;
use crate::arms::noisy_rig;
use crate::experiments::campaign;

/// Speeds, both directions \[rad/s\].
const SPEEDS_RAD_S: [f64; 6] = [4.0, 8.0, 12.0, 16.0, 20.0, 24.0];
const RECORD_S: f64 = 20.0;
/// Noise of both angles \[rad\].
const NOISE_RAD: f64 = 1e-3;
const SEED: u64 = 300;

/// Torque over speed in both directions, and their lines extrapolated to rest.
pub(crate) fn figure() -> Drawn {
    let mut rig = noisy_rig(NOISE_RAD)?;
    let coulomb = rig.arm.coulomb.forward();
    rig.arm.coulomb = Coulomb::by_direction(1.1 * coulomb, 0.9 * coulomb)?;
    let ramp = |v: f64| Experiment::new(Drive::Angle(Reference::ramp(v)?), RECORD_S);
    let velocities = SPEEDS_RAD_S.into_iter().chain(SPEEDS_RAD_S.map(|v| -v));
    let experiments = velocities.map(ramp).collect::<Result<Vec<_>, _>>()?;
    let campaign = campaign(&rig, &experiments, SEED)?;
    let found = constant_velocity(&Prepared::of(&campaign));
    let constant = rig.arm.motor.torque_constant_nm_per_a();
    let mut plot = LinePlot::new(
        "Torque at constant velocities, extrapolated to rest",
        Axis::linear("speed (rad/s)").range(0.0, 25.0),
        Axis::linear("torque that overcomes friction (N·m)"),
    )
    .subtitle(format!(
        "True Coulomb friction: {} N·m forward, {} N·m backward",
        significant(rig.arm.coulomb.forward(), 3),
        significant(rig.arm.coulomb.backward(), 3)
    ));
    let directions = [
        ("forward", 1.0, Role::Corrected, found.forward),
        ("backward", -1.0, Role::Raw, found.backward),
    ];
    for (name, sign, role, line) in directions {
        let line = line?;
        let points = || found.points.iter().filter(move |p| p.velocity.value * sign > 0.0);
        let at = |v: f64| line.coulomb.value + line.viscous.value * v;
        let (slowest, fastest) = (SPEEDS_RAD_S[0], SPEEDS_RAD_S[SPEEDS_RAD_S.len() - 1]);
        plot = plot
            .trace(Trace::line("", role, vec![slowest, fastest], vec![at(slowest), at(fastest)]))
            .trace(Trace::points_with_bars(
                name,
                role,
                points().map(|p| sign * p.velocity.value).collect(),
                points().map(|p| sign * constant * p.command.value).collect(),
                points().map(|p| NORMAL_95 * constant * p.command.std).collect(),
            ))
            .trace(Trace::new(
                format!("at rest {} N·m", significant(line.coulomb.value, 3)),
                role,
                TraceStyle::Dashes,
                vec![0.0, slowest],
                vec![at(0.0), at(slowest)],
            ));
    }
    Ok(Box::new(plot))
}
