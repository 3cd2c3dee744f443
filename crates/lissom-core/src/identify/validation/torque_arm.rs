//! The parts of an arm that predict torque.

use crate::replay::ModalArm;

/// An arm, and the coupling of its tips where its modes are not known.
#[derive(Debug, Clone, Copy)]
pub(in crate::identify) struct TorqueArm<'a> {
    pub(in crate::identify) arm: &'a ModalArm,
    /// Torque on the motor per deflection of each tip \[N·m/rad\], where the arm has no modes for it; else empty.
    pub(in crate::identify) coupling_alone_nm_per_rad: &'a [f64],
}

impl TorqueArm<'_> {
    /// Whether the arm has the modes of its coupling, and so moves.
    pub(in crate::identify) fn moves(&self) -> bool {
        self.coupling_alone_nm_per_rad.is_empty()
    }
}
