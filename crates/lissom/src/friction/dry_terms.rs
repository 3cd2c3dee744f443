//! What dry friction has beyond one Coulomb constant: a change near rest, ripple over the travel.

use super::falloff::Falloff;
use super::place::Place;

/// Largest share of its range by which an argument of the law may move over a step that is replayed
/// with friction linear in time, its mean over the step right.
const SHARE_PER_STEP: f64 = 0.4;
/// Largest (rate × step) at which friction that falls with speed lets the speed grow, and the same where
/// the motor has just been let go: what it errs by there grows with it.
const GROWTH: f64 = 0.5;
const LET_GO: f64 = 0.1;
/// Share of its speed by which the law is continued beyond a reversal.
const BEYOND: f64 = -0.5;
/// Speeds at which friction near rest has nothing left, over its own: of an exponential, and of a square's.
const GONE: [f64; 2] = [9.0, 3.0];

/// Dry friction's terms beside Coulomb and offset:
/// `s·(A·e^{−|θ̇|/v_s} + Σ_i B_i·cos k_iθ + C_i·sin k_iθ)`, s the direction of motion.
///
/// # Source
/// `[Armstrong1994]` for the falloff: with A > 0 the Stribeck effect, with A < 0 friction that grows less
/// than in proportion.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DryTerms {
    /// Change near rest.
    pub near_rest: Option<NearRest>,
    /// Waves over the angle.
    pub ripples: Vec<Ripple>,
}

/// `s·A·e^{−|θ̇|/v_s}` or `s·A·e^{−(θ̇/v_s)²}`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearRest {
    /// A \[N·m\]: friction at rest is C + A.
    pub torque_nm: f64,
    /// v_s \[rad/s\].
    pub speed_rad_s: f64,
    /// Which of the two.
    pub falloff: Falloff,
}

/// `s·(B·cos kθ + C·sin kθ)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ripple {
    /// k: waves per turn, or radians per metre.
    pub per_rad: f64,
    /// B \[N·m\].
    pub cosine_nm: f64,
    /// C \[N·m\].
    pub sine_nm: f64,
}

impl DryTerms {
    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.near_rest.is_none() && self.ripples.is_empty()
    }

    /// Torque against the motion at an angle and a speed: without s.
    pub fn braking_nm(&self, angle_rad: f64, speed_rad_s: f64) -> f64 {
        let near = self.near_rest.map_or(0.0, |n| n.torque_nm * n.share(speed_rad_s));
        let wave = |r: &Ripple| {
            let (sine, cosine) = (r.per_rad * angle_rad).sin_cos();
            r.cosine_nm * cosine + r.sine_nm * sine
        };
        near + self.ripples.iter().map(wave).sum::<f64>()
    }

    /// Their torque on the motor, signed.
    pub(crate) fn torque_nm(&self, at: Place) -> f64 {
        at.sign * self.braking_nm(at.angle, at.speed)
    }

    /// Derivatives of that by the angle and by the velocity.
    pub(crate) fn slopes(&self, at: Place) -> [f64; 2] {
        let wave = |r: &Ripple| {
            let (sine, cosine) = (r.per_rad * at.angle).sin_cos();
            r.per_rad * (r.sine_nm * cosine - r.cosine_nm * sine)
        };
        let near = self.near_rest.map_or(0.0, |n| n.torque_nm * n.falls(at.speed) / n.speed_rad_s);
        [at.sign * self.ripples.iter().map(wave).sum::<f64>(), -near]
    }

    /// Longest step over which friction may be taken for linear in time \[s\], for a motor that turns at
    /// `turning` at most, slows down to the place's speed at most, accelerates by `acceleration`, and by
    /// `per_torque` more per torque.
    pub(crate) fn step_s(
        &self,
        at: Place,
        turning: f64,
        acceleration: f64,
        per_torque: f64,
    ) -> f64 {
        let near = self.near_rest.filter(|n| n.acts_at(at.speed)).map(|n| {
            let moves = SHARE_PER_STEP * n.speed_rad_s / acceleration.abs();
            let growth = if at.speed < n.speed_rad_s { LET_GO } else { GROWTH };
            moves.min(growth * n.speed_rad_s / (per_torque * n.torque_nm).abs())
        });
        let turns = self.ripples.iter().map(|r| SHARE_PER_STEP / (r.per_rad * turning).abs());
        turns.chain(near).fold(f64::INFINITY, f64::min)
    }
}

impl NearRest {
    /// What of it is there at a speed.
    pub(crate) fn share(&self, speed: f64) -> f64 {
        self.falloff.share(self.ratio(speed))
    }

    /// By how much that falls as the speed rises by v_s.
    pub(crate) fn falls(&self, speed: f64) -> f64 {
        let steeper = match self.falloff {
            Falloff::Exponential => 1.0,
            Falloff::Gaussian => 2.0 * self.ratio(speed),
        };
        steeper * self.share(speed)
    }

    fn ratio(&self, speed: f64) -> f64 {
        (speed / self.speed_rad_s).max(BEYOND)
    }

    /// Whether anything is left of it at a speed.
    pub(crate) fn acts_at(&self, speed: f64) -> bool {
        let gone = match self.falloff {
            Falloff::Exponential => GONE[0],
            Falloff::Gaussian => GONE[1],
        };
        speed < gone * self.speed_rad_s
    }
}
