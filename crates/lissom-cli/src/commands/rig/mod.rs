//! `lissom rig`.

mod campaign_folder;
mod rig_command;
pub(crate) mod virtual_campaign;

pub(crate) use rig_command::run;
