//! `lissom demo`.

mod demo_campaign;
mod demo_command;

pub(crate) use demo_command::run;
