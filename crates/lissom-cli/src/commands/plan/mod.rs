//! `lissom plan`.

mod plan_command;
mod planned_json;
mod reference_tables;

pub(crate) use plan_command::run;
