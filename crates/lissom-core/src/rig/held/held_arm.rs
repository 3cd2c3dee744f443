//! An arm made ready for torques that are held over samples.

use super::flow::{ArmPart, Flow, ModalBlock, sum_push};
use super::modal::Modal;
use crate::arm::Arm;
use crate::rig::RigError;

/// An arm prepared for torques that are constant over each sample: its modes while the motor slips and while it sticks,
/// and their motion over given durations.
///
/// One prepared arm serves any number of [`HeldMotion`](super::HeldMotion)s.
#[derive(Debug, Clone)]
pub struct HeldArm<'a> {
    pub(in crate::rig) arm: &'a Arm,
    pub(in crate::rig) modes: Modes,
}

/// The arm's modes in both phases.
#[derive(Debug, Clone)]
pub(in crate::rig) struct Modes {
    pub(in crate::rig) modal: Modal,
    pub(in crate::rig) slip: Flow,
    pub(in crate::rig) stick: Flow,
    /// C_t on the slip's states `z` when the motor is at rest.
    pub(in crate::rig) coupling: Vec<f64>,
    /// q_i − θ_m on the blocks' states, slipping and sticking.
    pub(in crate::rig) deflections: [Vec<Vec<[f64; 2]>>; 2],
    pub(in crate::rig) durations: Vec<Duration>,
}

/// What the blocks do in a given time.
#[derive(Debug, Clone)]
pub(in crate::rig) struct Duration {
    pub(in crate::rig) time_s: f64,
    pub(in crate::rig) slip: Vec<ArmPart>,
    pub(in crate::rig) stick: Vec<ArmPart>,
    /// Angle that a torque of 1 N·m turns the motor by.
    pub(in crate::rig) turned: f64,
}

impl Duration {
    fn new(slip: &Flow, stick: &Flow, time_s: f64) -> Self {
        let over = |flow: &Flow| flow.blocks.iter().map(|b| b.over(time_s)).collect::<Vec<_>>();
        let (slip, stick) = (over(slip), over(stick));
        Self { time_s, turned: sum_push(&slip), slip, stick }
    }

    /// The slip over another time; nothing is allocated.
    pub(in crate::rig) fn set_slip(&mut self, modes: &Modes, time_s: f64) {
        fill(&mut self.slip, &modes.slip.blocks, time_s);
        self.turned = sum_push(&self.slip);
        self.time_s = time_s;
    }

    /// The stick over another time; nothing is allocated.
    pub(in crate::rig) fn set_stick(&mut self, modes: &Modes, time_s: f64) {
        fill(&mut self.stick, &modes.stick.blocks, time_s);
        self.time_s = time_s;
    }
}

fn fill(parts: &mut [ArmPart], blocks: &[ModalBlock], time_s: f64) {
    parts.iter_mut().zip(blocks).for_each(|(part, block)| *part = block.over(time_s));
}

impl<'a> HeldArm<'a> {
    /// Prepares an arm for torques that are constant over any of `durations_s` \[s\].
    ///
    /// Other durations are possible later, but slower. `None` if the modes are too close to each other (for example with a
    /// nearly critical damper), or if there are more than 150 coordinates: [`Hybrid`](crate::rig::Hybrid) moves such an arm.
    ///
    /// # Errors
    /// [`RigError::NotPositive`] for a duration that is not positive and finite.
    pub fn new(arm: &'a Arm, durations_s: &[f64]) -> Result<Option<Self>, RigError> {
        for &found in durations_s {
            if !(found > 0.0 && found.is_finite()) {
                return Err(RigError::NotPositive { quantity: "held duration [s]", found });
            }
        }
        Ok(Modes::new(arm, durations_s).map(|modes| Self { arm, modes }))
    }

    /// The arm.
    pub fn arm(&self) -> &'a Arm {
        self.arm
    }
}

impl Modes {
    fn new(arm: &Arm, durations_s: &[f64]) -> Option<Self> {
        let modal = Modal::new(arm)?;
        let slip = Flow::new(&modal.slip, &modal.push(), &modal.velocity())?;
        let coupling = modal.coupling();
        // At rest z has no velocity: its first entry is left out.
        let at_rest = |row: &nalgebra::DVector<f64>| row.rows(1, row.len() - 1).into_owned();
        let stick = Flow::new(&modal.stick, &at_rest(&(modal.push() * 0.0)), &at_rest(&coupling))?;
        let rows: Vec<_> = (0..modal.len()).map(|i| modal.deflection(i)).collect();
        let deflections = [
            rows.iter().map(|row| slip.row(row)).collect(),
            rows.iter().map(|row| stick.row(&at_rest(row))).collect(),
        ];
        let durations = durations_s.iter().map(|t| Duration::new(&slip, &stick, *t)).collect();
        let coupling = coupling.as_slice().to_vec();
        Some(Self { modal, slip, stick, coupling, deflections, durations })
    }

    /// Room for a duration that was not asked for.
    pub(in crate::rig) fn other_duration(&self) -> Duration {
        Duration::new(&self.slip, &self.stick, 0.0)
    }

    /// Which duration this is.
    pub(in crate::rig) fn duration(&self, time_s: f64) -> Option<&Duration> {
        self.durations.iter().find(|d| d.time_s.to_bits() == time_s.to_bits())
    }
}
