//! The smallest possible standard errors of a drive's parameters.

use lissom::information::{Inverse, inverted};
use nalgebra::{DMatrix, DVector};

use super::drive_campaign::{DriveCampaign, TrueRow};
use super::drive_parameter::DriveParameter;
use super::effects::Input;
use super::friction_line::braking_nm;

/// Noise of the torque relative to the planned peak torque if there is none, so that sums stay finite.
const NOISE_LEAST: f64 = 1e-6;

/// Cramér-Rao bounds of the parameters of the torque equation, with wander of friction as noise.
///
/// `τ = J·θ̈ + V·θ̇ + C·sgn θ̇ + O [+ g_s·sin θ + g_c·cos θ] + w`, over the rows in which the joint slips; the motion
/// is known. The noise w is the noise of the measured current, white from row to row, and wander: a first-order
/// autoregressive process times the dry friction at the row. A scalar Kalman filter whitens all columns, run by run.
///
/// Noise and steps of the angle are neglected: in the smooth windows of a regression their error is smaller than that
/// of the noise of a measured current or of a wander of one percent. The law has only Coulomb and viscous friction;
/// with an unseen mode θ̈ is that of the motor.
#[derive(Debug, Clone, PartialEq)]
pub struct TorqueBound {
    std: Vec<(DriveParameter, f64)>,
}

impl TorqueBound {
    /// The bound of a campaign; `None` if its motion does not determine all parameters, or the torque has no noise.
    pub fn of(campaign: &DriveCampaign) -> Option<Self> {
        if noise_share(campaign) == 0.0 && campaign.effects.wander.is_none() {
            return None;
        }
        let gravity = campaign.declares_gravity();
        let size = if gravity { 6 } else { 4 };
        let mut information = DMatrix::zeros(size, size);
        for rows in &campaign.truth {
            add_run(campaign, rows, gravity, &mut information);
        }
        let Inverse { matrix: covariance, lost } = inverted(&information);
        if lost.contains(&true) {
            return None;
        }
        let std = |i: usize| covariance[(i, i)].sqrt();
        let mut all = vec![
            (DriveParameter::Inertia, std(0)),
            (DriveParameter::Viscous, std(1)),
            (DriveParameter::Coulomb, std(2)),
            (DriveParameter::Load, std(3)),
        ];
        if let (true, Some(load)) = (gravity, campaign.effects.gravity) {
            // The amplitude moves along the phase.
            let (sine, cosine) = load.phase_rad.sin_cos();
            let variance = cosine * cosine * covariance[(4, 4)]
                + sine * sine * covariance[(5, 5)]
                + 2.0 * sine * cosine * covariance[(4, 5)];
            all.push((DriveParameter::Gravity, variance.sqrt()));
        }
        Some(Self { std: all })
    }

    /// The smallest standard deviation of an estimate, in the unit of its parameter.
    pub fn std(&self, parameter: DriveParameter) -> Option<f64> {
        self.std.iter().find(|(p, _)| *p == parameter).map(|(_, std)| *std)
    }
}

fn noise_share(campaign: &DriveCampaign) -> f64 {
    match campaign.effects.input {
        Input::Measured { noise_share, .. } => noise_share,
        Input::Held => 0.0,
    }
}

fn add_run(
    campaign: &DriveCampaign,
    rows: &[TrueRow],
    gravity: bool,
    information: &mut DMatrix<f64>,
) {
    let numbers = &campaign.numbers;
    let step_s = numbers.row_s;
    let noise = (noise_share(campaign).max(NOISE_LEAST) * numbers.peak_nm).powi(2);
    let (keep, drawn) = campaign.effects.wander.map_or((0.0, 0.0), |w| {
        let keep = (-step_s / w.correlation_time_s).exp();
        (keep, w.relative_std.powi(2) * (1.0 - keep * keep))
    });
    let size = information.nrows();
    // The prediction of the wander by each column, and the variance of the wander.
    let mut wander = DVector::zeros(size);
    let mut variance = campaign.effects.wander.map_or(0.0, |w| w.relative_std.powi(2));
    for k in 1..rows.len().saturating_sub(1) {
        wander *= keep;
        variance = keep * keep * variance + drawn;
        let [before, row, after] = [rows[k - 1], rows[k], rows[k + 1]];
        let speed = row.speed_rad_s;
        if before.speed_rad_s * speed <= 0.0 || speed * after.speed_rad_s <= 0.0 {
            continue;
        }
        let acceleration = (after.speed_rad_s - before.speed_rad_s) / (2.0 * step_s);
        let (sine, cosine) = row.angle_rad.sin_cos();
        let all = [acceleration, speed, speed.signum(), 1.0, sine, cosine];
        let columns = DVector::from_row_slice(&all[..if gravity { 6 } else { 4 }]);
        let by_wander = speed.signum() * braking_nm(&campaign.dry, &row);
        let of_row = by_wander * by_wander * variance + noise;
        let left = columns - &wander * by_wander;
        let gain = variance * by_wander / of_row;
        wander += &left * gain;
        variance *= 1.0 - gain * by_wander;
        information.ger(1.0 / of_row, &left, &left, 1.0);
    }
}
