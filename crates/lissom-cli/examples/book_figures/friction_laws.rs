//! `friction-laws.svg`: friction torque against speed.

use lissom::arm::Arm;
use lissom::drive::{Coulomb, DriveError, DryFriction, Falloff};
use lissom_report::{Axis, LinePlot, Role, Trace};

use crate::Drawn;
use crate::arms::demo_rig;
use crate::experiments::even;

/// Fastest velocity shown \[rad/s\], and points of each half of a line.
const FASTEST_RAD_S: f64 = 10.0;
const LINE: usize = 200;

/// Three laws with the viscous friction of the demo's motor.
pub(crate) fn figure() -> Drawn {
    let arm = demo_rig()?.arm;
    let sliding = arm.coulomb;
    let rest = Coulomb::symmetric(1.6 * sliding.forward())?;
    let laws: [(&str, Role, DryFriction); 3] = [
        ("Coulomb and viscous", Role::Corrected, sliding.into()),
        (
            "higher near rest, falling off with speed",
            Role::Raw,
            DryFriction::from(sliding).with_rest(rest, 1.0, Falloff::Exponential)?,
        ),
        ("different by direction", Role::Truth, by_direction(sliding)?),
    ];
    let mut plot = LinePlot::new(
        "Friction torque against speed",
        Axis::linear("velocity of the motor (rad/s)"),
        Axis::linear("friction torque (N·m)"),
    )
    .subtitle("At rest friction holds any torque between the ends of the vertical line.");
    for (label, role, law) in laws {
        let (x, y) = curve(&arm, &law);
        plot = plot.trace(Trace::line(label, role, x, y));
    }
    Ok(Box::new(plot))
}

fn by_direction(coulomb: Coulomb) -> Result<DryFriction, DriveError> {
    Ok(Coulomb::by_direction(0.7 * coulomb.forward(), 1.3 * coulomb.backward())?.into())
}

/// Torque against the motion, with its jump at rest.
fn curve(arm: &Arm, law: &DryFriction) -> (Vec<f64>, Vec<f64>) {
    let viscous = arm.motor.viscous_nm_s_per_rad();
    let half = |from: f64, to: f64, sign: f64| {
        let torque = move |v: f64| law.at(v, 0.0).slipping(sign) + viscous * v;
        even(from, to, LINE).into_iter().map(move |v| (v, torque(v)))
    };
    half(-FASTEST_RAD_S, 0.0, -1.0).chain(half(0.0, FASTEST_RAD_S, 1.0)).unzip()
}
