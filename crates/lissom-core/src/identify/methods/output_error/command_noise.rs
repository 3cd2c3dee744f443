//! Effect of the noise of a measured command on a replay.

use rayon::prelude::*;

use crate::identify::methods::regression::MotorRegression;
use crate::identify::prepare::channel_noise::{channel_noise, independent_noise};
use crate::record::{Campaign, Hold, Run};

/// How far the noise of the measured command, integrated twice over the regression's window, moves the angle beside the noise of the
/// angle's sensor: `σ_τ/J·√T·L^{3/2}/√3` over σ_θ, T the sample time and L the window's length; the median of the runs.
/// `None` of a command that is held, which acts as it is logged.
///
/// Where it is more than one, the equation of torques has the larger noise on its right side, as least squares suppose, and a
/// replay would take what it integrates for motion.
pub(crate) fn command_noise(campaign: &Campaign, motor: &MotorRegression) -> Option<f64> {
    let command = &campaign.channels.command;
    if command.hold == Hold::Sampled {
        return None;
    }
    let inertia = motor.inertia?.value.abs();
    let of_run = |run: &Run| {
        let torque_nm = independent_noise(run.command()) * command.torque_per_unit().abs();
        let angle = torque_nm / inertia * run.sample_time_s().sqrt() * motor.window_s.powf(1.5);
        angle / 3.0_f64.sqrt() / channel_noise(run.motor()).std
    };
    let mut ratios: Vec<f64> = campaign.runs.par_iter().with_max_len(1).map(of_run).collect();
    ratios.sort_by(f64::total_cmp);
    ratios.get(ratios.len() / 2).copied().filter(|ratio| ratio.is_finite())
}
