//! What was taken from a log that no campaign.toml describes.

use lissom_io::inspect::CampaignDraft;

use super::printer::line;

/// Prints what was taken from the log, each with the reason.
pub(crate) fn taken(draft: &CampaignDraft) {
    let all: Vec<(&str, &str)> = draft.taken().collect();
    if all.is_empty() {
        return;
    }
    line("taken from the log:");
    for (text, why) in all {
        line(&format!("  {text}"));
        line(&format!("    because {why}"));
    }
}
