//! `lissom plan`.

mod plan_command;
mod reference_tables;

pub(crate) use plan_command::run;
