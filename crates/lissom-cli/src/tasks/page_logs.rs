//! What the report page shows of logs.

use lissom::identify::{FoundArm, LogPrediction};
use lissom::record::Campaign;
use lissom_views::own_logs;

use crate::shared::progress_bar::during;

/// Predicts logs for a page, with a progress line; `None` without an arm that can be simulated.
pub(crate) fn predicted(campaign: &Campaign, arm: Option<&FoundArm>) -> Option<LogPrediction> {
    during("prediction for the report page", || own_logs(campaign, arm))
}
