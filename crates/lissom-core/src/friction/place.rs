//! Angle, speed and direction at which a friction law is evaluated.

/// Where a law is evaluated.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Place {
    /// Angle of the joint \[rad\].
    pub(crate) angle: f64,
    /// Speed in the direction of motion \[rad/s\]; negative just beyond a reversal, where the law is continued.
    pub(crate) speed: f64,
    /// Direction: +1 or −1.
    pub(crate) sign: f64,
}

impl Place {
    /// Place of a joint that turns with `velocity`; at rest its direction is that of `toward`, forward if both are zero.
    pub(crate) fn of_velocity(angle: f64, velocity: f64, toward: f64) -> Self {
        let way = if velocity == 0.0 { toward } else { velocity };
        let sign = if way < 0.0 { -1.0 } else { 1.0 };
        Self { angle, speed: velocity.abs(), sign }
    }
}
