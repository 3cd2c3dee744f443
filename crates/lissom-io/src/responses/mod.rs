//! Tables of frequency responses: delimited text with a header, one file or several on one grid.
//!
//! What a column is, its name says; `docs/src/how-to/equivalent.md` has the rules. One column is the frequency, with its
//! unit (`omega_rad_s`, `frequency_hz`, `f [Hz]`). A response is two columns, `re` and `im`, or a magnitude (`db`,
//! or `mag`) and a phase (`deg`, or `phase [rad]`); `std` may stand beside them. What is left of a name is
//! the output's: `tip_re` and `tip_im` are of `tip`; where nothing is left it is the file's.

mod read_responses;
mod response_columns;
mod response_error;
#[cfg(test)]
mod responses_tests;

pub use read_responses::{FrequencyResponses, MeasuredResponse, read_responses};
pub use response_error::{Positive, ResponseError};
