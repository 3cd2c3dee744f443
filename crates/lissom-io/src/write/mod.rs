//! Writes files completely or not at all.

mod arm_text;
mod campaign_text;
mod csv_text;
mod file_batch;
mod found_arm_text;
mod plan_text;
mod write_error;
#[cfg(test)]
mod write_tests;
mod write_whole;

pub use arm_text::{ARM_HEAD, WrittenArm, arm_text};
pub use campaign_text::{CampaignPlan, PlannedCommand, PlannedRun, campaign_text, write_campaign};
pub use csv_text::{csv_text, write_csv};
pub use file_batch::Batch;
pub use found_arm_text::found_arm_text;
pub use plan_text::{PLAN_HEAD, plan_text, write_plan};
pub use write_error::WriteError;
pub use write_whole::{create_folder, json_text, remove, write_json, write_text, write_whole};
