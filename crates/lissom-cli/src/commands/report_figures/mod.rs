//! `lissom figures`.

mod figures_command;

pub(crate) use figures_command::run;
