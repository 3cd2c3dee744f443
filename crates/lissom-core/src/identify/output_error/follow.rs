//! The motion of a given arm in runs from which it was not identified.

use rayon::prelude::*;

use crate::identify::interrupt::Interrupt;
use crate::identify::output_error::engine::budget::Budget;
use crate::identify::output_error::engine::search::{ReplayProblem, is_possible};
use crate::identify::output_error::engine::windows::widen;
use crate::identify::output_error::engine::{data, noise};
use crate::identify::output_error::thresholds::{LAST_STEP_FALL, LAST_STEPS_MOST};
use crate::record::Campaign;
use crate::replay::{Body, ModalArm, Sampling, SensorNoise, Window};

/// Windows of about `length_s` (whole runs if that is longer), each with the initial state and the tips' zeros for
/// which the arm's motion is closest to the log. The arm itself is not changed.
///
/// The search starts from the result of `shorter` windows, if there are any: over a long window it may end in a
/// motion that sticks and slips at other times than the log.
pub(crate) fn follow(
    arm: &ModalArm,
    campaign: &Campaign,
    length_s: f64,
    shorter: &[Window],
) -> Vec<Window> {
    let masks = data::masks(campaign);
    let noise: Vec<SensorNoise> = noise::of_samples(campaign).into_iter().map(weighable).collect();
    let sampling = Sampling { noise: &noise, blocks: &[], masks: &masks, command_noise: 0.0 };
    // No limit is needed: each window has few unknowns and few steps.
    let budget = Budget::new(u64::MAX, Interrupt::default());
    let problem = ReplayProblem {
        campaign,
        parameters: &[],
        sampling,
        budget: &budget,
        robust: false,
        promise: LAST_STEP_FALL,
        near_enough: 0.0,
    };
    if !is_possible(campaign, arm) {
        return Vec::new();
    }
    let nearest = |window: Window| {
        let point = problem.at(Body::free(arm.clone()), vec![window]);
        problem.search(point, LAST_STEPS_MOST).0.windows
    };
    let begun = widen(campaign, arm, shorter, length_s);
    begun.into_par_iter().with_max_len(1).flat_map_iter(nearest).collect()
}

/// Gives no weight to a channel without noise: it does not move.
fn weighable(noise: SensorNoise) -> SensorNoise {
    if noise.sigma > 0.0 { noise } else { SensorNoise::gaussian(f64::MAX.sqrt()) }
}
