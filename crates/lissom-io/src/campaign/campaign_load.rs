//! The table `[load]`: what acts on the motor beside friction.

use lissom::record::Axis;

use super::campaign_error::CampaignError;
use super::campaign_signals::Signals;
use crate::config::Table;
use crate::io_error::Error;

/// Whether gravity is to be identified.
pub(super) fn gravity(table: &Table<'_>, signals: &Signals) -> Result<bool, Error> {
    table.only(&["gravity"])?;
    let Some(value) = table.get("gravity") else { return Ok(false) };
    let wanted = value.truth()?;
    let place = value.place();
    if wanted && signals.axis == Axis::Linear {
        return Err(CampaignError::GravityOnLinearAxis { place }.into());
    }
    if wanted && !signals.tips.is_empty() {
        return Err(CampaignError::GravityWithTips { place }.into());
    }
    Ok(wanted)
}
