//! Tables of frequency responses: delimited text with a header, in one or several files with the same frequencies.
//!
//! The name of a column gives its meaning; `docs/src/how-to/equivalent.md` has the rules. One column is the frequency,
//! with its unit (`omega_rad_s`, `frequency_hz`, `f [Hz]`). A response is two columns, `re` and `im`, or a magnitude
//! (`db` or `mag`) and a phase (`deg`, or `phase [rad]`); a column `std` may be added. The rest of the name is the name
//! of the output: `tip_re` and `tip_im` are for `tip`. Without a rest, the output has the name of the file.

mod read_responses;
mod response_columns;
mod response_error;
#[cfg(test)]
mod responses_tests;

pub use read_responses::{FrequencyResponses, MeasuredResponse, read_responses};
pub use response_error::{Positive, ResponseError};
