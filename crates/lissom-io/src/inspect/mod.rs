//! A look at a log before anything is known about it: channels, units, clock, and which channel is probably what.
//!
//! [`inspect`] reads a log of any format and describes its channels. [`Roles`] says which channel is probably
//! the time, the command and the motor, and why. [`CampaignDraft`] makes a `campaign.toml` of that and of what the user
//! says; units come from the file or from the user, never from a guess.

mod channel_facts;
mod clock_facts;
mod draft;
mod draft_error;
mod inspected_channel;
mod inspection;
mod inspection_file;
mod own_log;
mod picks;
mod relations;
mod roles;
mod row_labels;
mod stated_unit;
mod user_choice;
mod words;

pub use channel_facts::ChannelFacts;
pub use clock_facts::ClockFacts;
pub use draft::{CampaignDraft, Description, LogTrim};
pub use draft_error::DraftError;
pub use inspected_channel::InspectedChannel;
pub use inspection::{Inspection, inspect, inspect_content, inspect_data, inspect_with};
pub use inspection_file::{
    ClockEntry, InspectedChannelEntry, InspectedLogEntry, InspectionFile, RoleEntry,
};
pub use lissom_formats::ReadOptions as TextOptions;
pub use relations::Relation;
pub use roles::{Guess, Role, Roles};
pub use row_labels::{LabelOrder, RowLabels};
pub use stated_unit::{StatedUnit, UnitSource};
pub use user_choice::{Choice, CommandKey};
