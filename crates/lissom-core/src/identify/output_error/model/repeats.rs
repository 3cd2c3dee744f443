//! Readings that only repeat the one before.

use crate::identify::output_error::engine::data::Masks;
use crate::identify::output_error::engine::noise::is_least;
use crate::identify::output_error::model::fit::ArmFit;
use crate::record::Campaign;
use crate::replay::Prediction;

/// Leaves out readings of a sensor without noise until the predicted value has changed by the assumed noise since the
/// last reading that counts. `None` if all sensors have noise of their own.
///
/// Such a sensor shows one step as long as the joint rests. With the assumed noise, each reading would say again that
/// the angle is not near the edge of the step. So it is counted once.
pub(crate) fn without_repeats(
    campaign: &Campaign,
    fit: &ArmFit,
    predicted: &[Option<Prediction>],
    masks: &[Masks],
) -> Option<Vec<Masks>> {
    if !fit.noise.iter().any(is_least) {
        return None;
    }
    let mut masks = masks.to_vec();
    for (window, found) in fit.windows.iter().zip(predicted) {
        let found = found.as_ref()?;
        let first = *window.samples.start();
        let channels = fit.noise.iter().zip(&found.channels).zip(&mut masks[window.run]);
        for ((noise, predicted), mask) in channels.filter(|((noise, _), _)| is_least(noise)) {
            let mask = mask.get_or_insert_with(|| vec![true; campaign.runs[window.run].len()]);
            let mut told = f64::INFINITY;
            for (value, counts) in predicted.iter().zip(&mut mask[first..]) {
                if (value - told).abs() < noise.sigma {
                    *counts = false;
                } else {
                    told = *value;
                }
            }
        }
    }
    Some(masks)
}
