//! Whether a joint sticks, or in which direction it slips.

/// State of a joint, or of a tip that rubs on a surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mode {
    /// At rest, held by friction.
    Stick,
    /// Moving forward.
    Forward,
    /// Moving backward.
    Backward,
}

impl Mode {
    /// Mode of a velocity; sticking at zero.
    pub(crate) fn of(velocity: f64) -> Self {
        if velocity > 0.0 {
            Self::Forward
        } else if velocity < 0.0 {
            Self::Backward
        } else {
            Self::Stick
        }
    }

    /// +1 forward, −1 backward.
    pub(crate) fn sign(self) -> f64 {
        if self == Self::Backward { -1.0 } else { 1.0 }
    }
}
