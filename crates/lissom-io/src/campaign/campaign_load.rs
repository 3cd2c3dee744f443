//! The table `[load]`: loads on the motor other than friction.

use lissom_core::record::Axis;

use super::campaign_signals::Signals;
use crate::config::{ConfigError, Table, Value};
use crate::units::Dimension;

/// Whether gravity is to be identified, and the load's m·g·l \[N·m\] if it is known.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct CampaignLoad {
    pub(super) gravity: bool,
    pub(super) mgl_nm: Option<f64>,
}

/// Reads the table.
pub(super) fn load(table: &Table<'_>, signals: &Signals) -> Result<CampaignLoad, ConfigError> {
    table.only("gravity mgl")?;
    let value = table.get("gravity");
    let gravity = value.as_ref().map_or(Ok(false), Value::truth)?;
    if let Some(mgl) = table.get("mgl").filter(|_| !gravity) {
        let hint = "add gravity = true, or remove `mgl`";
        return Err(mgl.error(" has no effect without `gravity = true`", hint));
    }
    if let Some(value) = value.filter(|_| gravity) {
        if signals.axis == Axis::Linear {
            return Err(value.error(
                ": gravity on a linear axis is a constant force",
                "remove it: every result has this force as the offset of friction",
            ));
        }
        if !signals.tips.is_empty() {
            return Err(value.error(
                ": gravity is identified only for a rigid joint, but this campaign has tips",
                "remove `gravity`, or the tips",
            ));
        }
    }
    Ok(CampaignLoad { gravity, mgl_nm: table.positive("mgl", Dimension::TORQUE)? })
}
