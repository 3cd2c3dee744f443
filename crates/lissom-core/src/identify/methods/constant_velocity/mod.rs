//! The classical constant-velocity method: the current that keeps a steady velocity, extrapolated to zero speed.

mod findings;
mod line;
mod steady_friction;

use crate::identify::estimate::Estimate;
use crate::identify::findings::Finding;
use crate::identify::prepare::prepared::Prepared;
use crate::identify::prepare::run_analysis::RunAnalysis;
use crate::identify::prepare::steady_points::SteadyPoint;
use crate::record::Channels;
use findings::findings;
pub use line::{FrictionLine, LineError, LineShape};

/// Result of the constant-velocity method.
#[derive(Debug, Clone, PartialEq)]
pub struct ConstantVelocity {
    /// Coulomb friction, mean of both directions \[N·m or N\]; `None` unless there is a line for each direction.
    pub coulomb: Option<Estimate>,
    /// Offset, (forward − backward)/2 \[N·m or N\].
    pub offset: Option<Estimate>,
    /// Viscous friction, mean of the lines \[N·m·s/rad or N·s/m\].
    pub viscous: Option<Estimate>,
    /// Line through the points with positive velocity.
    pub forward: Result<FrictionLine, LineError>,
    /// Line through the points with negative velocity.
    pub backward: Result<FrictionLine, LineError>,
    /// All parts with constant velocity, run by run.
    pub points: Vec<SteadyPoint>,
}

/// Finds the parts of the runs with constant velocity, and extrapolates their mean command to zero speed.
///
/// At a constant velocity nothing accelerates, and `τ = ±CF + V·θ̇`: a straight line of torque over velocity for each
/// direction. τ is the command times its torque constant
/// \[N·m, N, or the unit of the command if the constant is unknown\]. The standard error of each point comes from the
/// scatter of the signals in its part, with their correlation in time. Errors of the velocity count through the slope.
/// If the points scatter about the line by more than their standard errors, that scatter counts instead.
///
/// The shape of the points is tested: see [`LineShape`].
///
/// ```
/// # use lissom::record::{Axis, Campaign, Channels, Command, CommandQuantity, Hold, Run, TimeBase};
/// # let runs = [-3.0, -2.0, -1.0, 1.0, 2.0, 3.0].map(|v: f64| {
/// #     let motor = (0..500).map(|k| v * 0.01 * f64::from(k)).collect();
/// #     let torque = (0..500).map(|k| 0.3 * v.signum() + 0.05 * v + 1e-3 * (f64::from(k) * 0.7).sin()).collect();
/// #     Run::new("steady", TimeBase::uniform(0.0, 0.01), torque, motor, vec![]).unwrap()
/// # });
/// # let command = Command { quantity: CommandQuantity::Current, hold: Hold::Measured, torque_per_command: Some(1.0), back_emf_viscous: 0.0, limit: None };
/// # let campaign = Campaign::new(Channels { axis: Axis::Rotary, command, tips: vec![] }, runs.to_vec()).unwrap();
/// use lissom::identify::{Prepared, constant_velocity}; // of six speeds with V = 0.05, CF = 0.3
/// let prepared = Prepared::of(&campaign);
/// let found = constant_velocity(&prepared);
/// assert!((found.coulomb.unwrap().value - 0.3).abs() < 1e-4);
/// ```
///
/// # Source
/// `[Feliu1989, Section 6.2.2 and Figure 8]`, without standard errors.
pub fn constant_velocity(prepared: &Prepared<'_>) -> ConstantVelocity {
    let points = prepared.runs().iter().flat_map(|r| r.steady.iter().copied()).collect();
    ConstantVelocity::of_points(&prepared.campaign().channels, points)
}

/// The same where a line goes through some points or a run was made for it, with what there is to know of it.
pub(crate) fn where_meant(prepared: &Prepared<'_>) -> (Option<ConstantVelocity>, Vec<Finding>) {
    let found = constant_velocity(prepared);
    let meant = prepared.runs().iter().any(RunAnalysis::is_constant_velocity);
    let findings = findings(prepared.campaign(), &found, meant);
    ((meant || found.lines().next().is_some()).then_some(found), findings)
}

impl ConstantVelocity {
    /// The estimates that these points give.
    pub(crate) fn of_points(channels: &Channels, points: Vec<SteadyPoint>) -> Self {
        let constant = channels.command.torque_per_unit();
        let direction = |sign: f64| {
            let points: Vec<line::SpeedPoint> = points
                .iter()
                .filter(|p| p.velocity.value * sign > 0.0)
                .map(|p| line::SpeedPoint {
                    speed: p.velocity.scaled(sign),
                    drive: p.command.scaled(sign * constant),
                })
                .collect();
            line::line(&points, channels.command.back_emf_viscous)
        };
        let (forward, backward) = (direction(1.0), direction(-1.0));
        let halves = |a: Estimate, b: Estimate, sign: f64| Estimate {
            value: 0.5 * (a.value + sign * b.value),
            std: 0.5 * a.std.hypot(b.std),
        };
        let (mut coulomb, mut offset) = (None, None);
        if let (Ok(f), Ok(b)) = (&forward, &backward) {
            coulomb = Some(halves(f.coulomb, b.coulomb, 1.0));
            offset = Some(halves(f.coulomb, b.coulomb, -1.0));
        }
        let viscous = match (&forward, &backward) {
            (Ok(f), Ok(b)) => Some(halves(f.viscous, b.viscous, 1.0)),
            (Ok(line), Err(_)) | (Err(_), Ok(line)) => Some(line.viscous),
            _ => None,
        };
        Self { coulomb, offset, viscous, forward, backward, points }
    }

    /// The fitted lines with the names of their directions, forward first.
    pub fn lines(&self) -> impl Iterator<Item = (&'static str, &FrictionLine)> {
        let named = |name, line| (name, line);
        let (forward, backward) = (self.forward.as_ref().ok(), self.backward.as_ref().ok());
        forward
            .map(|l| named("forward", l))
            .into_iter()
            .chain(backward.map(|l| named("backward", l)))
    }
}
