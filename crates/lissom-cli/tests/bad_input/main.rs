//! What the command says to input that it cannot use, and what it says of input that is poor.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

mod arms;
mod bench;
mod campaigns;
mod findings;
mod loads;
mod logs;
mod odd_files;
mod outputs;
mod results;
