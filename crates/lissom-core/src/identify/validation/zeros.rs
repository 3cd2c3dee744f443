//! Readings of tips without deflection, from the log alone.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use crate::identify::output_error::{Masks, masks};
use crate::identify::prepare::tip_zero::tip_zeros;
use crate::identify::validation::kernel::Kernel;
use crate::identify::validation::torque_arm::TorqueArm;
use crate::record::{Campaign, Hold, Run, TipQuantity};
use crate::replay::ModalArm;

/// What each tip of each run shows undeflected.
///
/// A beam that nothing holds is straight in the mean. Under one window over the whole run
///
/// ```text
/// ⟨y_i − θ⟩ = z_i + Σ_j r_ij·⟨ψ_j − θ⟩,  ω_j²·⟨ψ_j − θ⟩ = −⟨ψ̈_j⟩ + d_j·⟨θ̇ − ψ̇_j⟩ − a_j·⟨ψ̇_j⟩ − Σ_l P_jl·⟨ψ̇_l⟩
/// ```
///
/// where all rates are those of the window and nearly nothing: an arm whose beam is another one hardly moves
/// z_i, unlike that of a replay, which takes up what the arm misses. Zeros where the tips do not show the modes; where no mode is
/// known, those that the regression takes off.
pub(in crate::identify) fn zeros(found: TorqueArm<'_>, campaign: &Campaign) -> Vec<Vec<f64>> {
    let arm = found.arm;
    let tips = campaign.channels.tips.len();
    if !found.moves() {
        return tip_zeros(campaign);
    }
    let masks = masks(campaign);
    let n = arm.modes.len();
    let square = n > 0 && arm.shapes.len() == n && tips == n;
    let shapes = square.then(|| DMatrix::from_fn(n, n, |i, j| arm.shapes[i][j]));
    let inverse = |shapes: DMatrix<f64>| Some((shapes.clone().try_inverse()?, shapes));
    let Some((in_modes, shapes)) = shapes.and_then(inverse) else {
        return vec![vec![0.0; tips]; campaign.runs.len()];
    };
    let of_run = |(run, masks): (&Run, &Masks)| {
        of_run(arm, campaign, run, &longest_read(masks, run.len()), &shapes, &in_modes)
            .unwrap_or_else(|| vec![0.0; tips])
    };
    campaign.runs.iter().zip(&masks).map(of_run).collect()
}

/// `y_i − θ` of each tip in time with the motor, under one window over a run.
struct Deflection {
    kernel: Kernel,
    mean: DVector<f64>,
    rate: DVector<f64>,
    acceleration: DVector<f64>,
}

impl Deflection {
    fn of(arm: &ModalArm, campaign: &Campaign, run: &Run, read: &Range<usize>) -> Option<Self> {
        let n = run.tips().len();
        let intervals = read.len().checked_sub(2).filter(|i| *i >= n)?;
        let kernel = Kernel::new(intervals, run.sample_time_s(), Hold::Measured, 0.0);
        let begin = read.start;
        let motor = |k: usize| run.motor()[k];
        let [mut mean, mut rate, mut acceleration] = [(); 3].map(|()| DVector::zeros(n));
        for (i, tip) in run.tips().iter().enumerate() {
            let deflects = campaign.channels.tips[i].quantity == TipQuantity::Deflection;
            let lag_s = arm.tip_lags_s.get(i).copied().unwrap_or(0.0);
            let bent = |k: usize| tip[k] - if deflects { 0.0 } else { motor(k) };
            let late = |k: usize| tip[k] + if deflects { motor(k) } else { 0.0 };
            rate[i] = kernel.rate(begin, bent);
            acceleration[i] = kernel.acceleration(begin, bent);
            mean[i] = kernel.mean(begin, bent) + lag_s * kernel.rate(begin, late);
        }
        Some(Self { kernel, mean, rate, acceleration })
    }
}

fn of_run(
    arm: &ModalArm,
    campaign: &Campaign,
    run: &Run,
    read: &Range<usize>,
    shapes: &DMatrix<f64>,
    in_modes: &DMatrix<f64>,
) -> Option<Vec<f64>> {
    let n = shapes.nrows();
    let Deflection { kernel, mean, rate, acceleration } = Deflection::of(arm, campaign, run, read)?;
    let (begin, motor) = (read.start, |k: usize| run.motor()[k]);
    let turns = kernel.rate(begin, motor);
    // Of ψ_j: with those of the motor.
    let (behind, accelerates) = (in_modes * rate, in_modes * acceleration);
    let own = behind.add_scalar(turns);
    let with_motor = kernel.acceleration(begin, motor);
    let points = arm.points_in_modes().map(|p| p * &own);
    let strained = DVector::from_fn(n, |j, _| {
        let m = &arm.modes[j];
        let grounded = m.grounded_per_s * own[j] + points.as_ref().map_or(0.0, |p| p[j]);
        let pulled = -(accelerates[j] + with_motor) - m.within_per_s * behind[j] - grounded;
        pulled / (m.omega_rad_s * m.omega_rad_s)
    });
    let zeros = mean - shapes * strained;
    zeros.iter().all(|z| z.is_finite()).then(|| zeros.iter().copied().collect())
}

/// The longest stretch in which no sensor stands at the end of its range.
fn longest_read(masks: &Masks, len: usize) -> Range<usize> {
    let reads = |k: usize| masks.iter().flatten().all(|mask| mask[k]);
    let (mut best, mut begin) = (0..0, 0);
    for k in 0..=len {
        if k == len || !reads(k) {
            if k - begin > best.len() {
                best = begin..k;
            }
            begin = k + 1;
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_longest_stretch_between_ends_of_the_range() {
        let mask = |bad: &[usize]| -> Masks {
            vec![Some((0..10).map(|k| !bad.contains(&k)).collect()), None]
        };
        assert_eq!(longest_read(&mask(&[]), 10), 0..10);
        assert_eq!(longest_read(&mask(&[2, 8]), 10), 3..8);
        assert_eq!(longest_read(&mask(&[0, 1, 2, 3]), 10), 4..10);
    }
}
