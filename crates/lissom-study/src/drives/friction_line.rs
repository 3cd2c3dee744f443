//! The line of Coulomb and viscous friction that a campaign has.

use lissom::drive::DryFriction;

use super::drive_campaign::{DriveCampaign, TrueRow};

/// Samples slower than this share of the largest speed are not in motion: that of
/// [`least_squares`](lissom::identify::least_squares).
const SLOWEST: f64 = 0.05;

/// Coulomb and viscous friction by ordinary least squares of the true friction torque on `sgn θ̇` and `θ̇`, over all samples
/// of all runs that are faster than 5 % of the largest speed.
///
/// It is the definition by which friction of real logs is compared, since nobody knows their law. Loads are no
/// friction and are left out; ripple is averaged as it falls. For Coulomb and viscous friction alone the line is the law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrictionLine {
    /// \[N·m\].
    pub coulomb_nm: f64,
    /// \[N·m·s/rad\].
    pub viscous_nm_s_per_rad: f64,
}

impl FrictionLine {
    /// The line of the law, without its wander: the value about which repeated campaigns scatter. Intervals and
    /// the bound count wander as noise, so that this is what they are about.
    pub fn of(campaign: &DriveCampaign) -> Self {
        Self::fitted(campaign, &campaign.dry, |_| 1.0)
    }

    /// The line of the law without its ripple: that of a result which has the ripple as a term of its own.
    pub fn without_ripple(campaign: &DriveCampaign) -> Self {
        Self::fitted(campaign, &campaign.dry_without_ripple, |_| 1.0)
    }

    /// The line with the wander as it fell in these runs.
    pub fn as_it_fell(campaign: &DriveCampaign) -> Self {
        Self::fitted(campaign, &campaign.dry, |row| row.factor)
    }

    fn fitted(
        campaign: &DriveCampaign,
        law: &DryFriction,
        factor: impl Fn(&TrueRow) -> f64,
    ) -> Self {
        let rows = || campaign.truth.iter().flatten();
        let fastest = rows().map(|row| row.speed_rad_s.abs()).fold(0.0, f64::max);
        let viscous = campaign.numbers.viscous_nm_s_per_rad;
        // Sums of 1, |v|, v², F and F·|v|: both columns have the direction's sign.
        let mut sums = [0.0; 5];
        for row in rows().filter(|row| row.speed_rad_s.abs() > SLOWEST * fastest) {
            let (speed, dry) = (row.speed_rad_s.abs(), braking_nm(law, row));
            let braking = factor(row) * dry + viscous * speed;
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
    if row.speed_rad_s > 0.0 { dry.forward } else { dry.backward }
}
