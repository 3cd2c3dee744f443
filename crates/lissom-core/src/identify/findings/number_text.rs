//! Estimates in messages.

use lissom_text::with_uncertainty;

use crate::identify::estimate::Estimate;

/// A value with its standard error.
pub(super) fn with_error(estimate: Estimate) -> String {
    with_uncertainty(estimate.value, estimate.std)
}

/// A number with a minus sign in place of a hyphen.
pub(super) fn minus(number: &str) -> String {
    number.replace('-', "−")
}

/// `later` for a positive delay, `earlier` for a negative one.
pub(super) fn later(delay_s: f64) -> &'static str {
    if delay_s < 0.0 { "earlier" } else { "later" }
}

/// The size of a delay in milliseconds, without its sign.
pub(super) fn milliseconds(delay: Estimate) -> String {
    format!("{} ms", with_uncertainty(1e3 * delay.value.abs(), 1e3 * delay.std))
}
