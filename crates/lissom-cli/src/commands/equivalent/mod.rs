//! `lissom equivalent`.

mod equivalent_command;
mod saved_arm;

pub(crate) use equivalent_command::run;
