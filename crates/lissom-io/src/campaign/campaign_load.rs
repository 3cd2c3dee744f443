//! The table `[load]`: loads on the motor other than friction.

use lissom_core::record::Axis;

use super::campaign_error::CampaignError;
use super::campaign_signals::Signals;
use crate::config::Table;
use crate::io_error::Error;
use crate::units::Dimension;

/// Whether gravity is to be identified, and the load's m·g·l \[N·m\] if it is known.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct CampaignLoad {
    pub(super) gravity: bool,
    pub(super) mgl_nm: Option<f64>,
}

/// Reads the table.
pub(super) fn load(table: &Table<'_>, signals: &Signals) -> Result<CampaignLoad, Error> {
    table.only(&["gravity", "mgl"])?;
    let mgl = table.get("mgl");
    let Some(value) = table.get("gravity") else {
        return match mgl {
            Some(mgl) => Err(CampaignError::MglAlone { place: mgl.place() }.into()),
            None => Ok(CampaignLoad::default()),
        };
    };
    let wanted = value.truth()?;
    if let Some(mgl) = mgl.as_ref().filter(|_| !wanted) {
        return Err(CampaignError::MglAlone { place: mgl.place() }.into());
    }
    let place = value.place();
    if wanted && signals.axis == Axis::Linear {
        return Err(CampaignError::GravityOnLinearAxis { place }.into());
    }
    if wanted && !signals.tips.is_empty() {
        return Err(CampaignError::GravityWithTips { place }.into());
    }
    let mgl_nm = mgl.map(|mgl| mgl.positive(Dimension::TORQUE)).transpose()?;
    Ok(CampaignLoad { gravity: wanted, mgl_nm })
}
