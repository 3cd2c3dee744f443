//! Coulomb and viscous friction of a campaign by least squares of its true friction.

use lissom::drive::DryFriction;

use super::drive_campaign::{DriveCampaign, TrueRow};

/// Samples slower than this share of the largest speed are not in motion: that of
/// [`least_squares`](lissom::identify::least_squares).
const SLOWEST: f64 = 0.05;

/// Coulomb and viscous friction by ordinary least squares of the true friction torque on `sgn θ̇` and `θ̇`, over all
/// samples of all runs that are faster than 5 % of the largest speed.
///
/// With this definition friction of real logs can be compared, since their law is not known. Loads are not friction and
/// are left out; ripple is averaged over the angles of the runs. If there is only Coulomb and viscous friction, the
/// line is the law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrictionLine {
    /// \[N·m\].
    pub coulomb_nm: f64,
    /// \[N·m·s/rad\].
    pub viscous_nm_s_per_rad: f64,
}

/// The parts of friction to which a line is fitted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LineOf {
    /// With gear ripple. The line without it is that of a result that has the ripple as a separate term.
    pub ripple: bool,
    /// With the wander of friction in these runs. The value without it is that about which repeated campaigns scatter.
    /// Intervals and the bound treat wander as noise, so they are for this value.
    pub wander: bool,
}

impl LineOf {
    /// The line that a result without further terms should give.
    pub const LAW: Self = Self { ripple: true, wander: false };
}

impl FrictionLine {
    /// Fits the line of a campaign.
    pub fn of(campaign: &DriveCampaign, of: LineOf) -> Self {
        let law = if of.ripple { &campaign.dry } else { &campaign.dry_without_ripple };
        let rows = || campaign.truth.iter().flatten();
        let fastest = rows().map(|row| row.speed_rad_s.abs()).fold(0.0, f64::max);
        let viscous = campaign.numbers.viscous_nm_s_per_rad;
        // Sums of 1, |v|, v², F and F·|v|: both columns have the direction's sign.
        let mut sums = [0.0; 5];
        for row in rows().filter(|row| row.speed_rad_s.abs() > SLOWEST * fastest) {
            let (speed, dry) = (row.speed_rad_s.abs(), braking_nm(law, row));
            let factor = if of.wander { row.factor } else { 1.0 };
            let braking = factor * dry + viscous * speed;
            let terms = [1.0, speed, speed * speed, braking, braking * speed];
            for (sum, term) in sums.iter_mut().zip(terms) {
                *sum += term;
            }
        }
        let [one, v, vv, f, fv] = sums;
        let determinant = one * vv - v * v;
        Self {
            coulomb_nm: (f * vv - fv * v) / determinant,
            viscous_nm_s_per_rad: (one * fv - v * f) / determinant,
        }
    }
}

/// Dry friction against the motion at a row, without wander \[N·m\].
pub(super) fn braking_nm(law: &DryFriction, row: &TrueRow) -> f64 {
    let dry = law.at(row.speed_rad_s, row.angle_rad);
    if row.speed_rad_s > 0.0 { dry.forward() } else { dry.backward() }
}
