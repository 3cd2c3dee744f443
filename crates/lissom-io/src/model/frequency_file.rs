//! Frequencies from a file: one number in each row, or the first column of delimited text.

use std::fs::File;
use std::io::{self, BufRead as _, BufReader, Read as _};
use std::path::Path;

use thiserror::Error;

use crate::excerpt::excerpt;

/// Largest number of frequencies in a file.
const MOST: usize = 1_000_000;
/// Bytes that are read of a row; only the first cell is used.
const LONGEST: u64 = 1 << 16;

/// Why a file is not a list of frequencies.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FrequencyError {
    /// The file cannot be read.
    #[error("{file}: cannot be read: {source}")]
    Read {
        /// The file.
        file: String,
        /// The cause.
        source: io::Error,
    },
    /// A row does not begin with a number.
    #[error("{file}, line {line}: \"{}\" is not a frequency", excerpt(found))]
    NotANumber {
        /// The file.
        file: String,
        /// The line, from 1.
        line: usize,
        /// Its first cell.
        found: String,
    },
    /// A number that is not positive and finite.
    #[error("{file}, line {line}: {found} is not positive and finite")]
    NotPositive {
        /// The file.
        file: String,
        /// The line, from 1.
        line: usize,
        /// The number.
        found: f64,
    },
    /// A file without frequencies.
    #[error("{file}: there is no frequency in it")]
    Empty {
        /// The file.
        file: String,
    },
    /// Too many frequencies.
    #[error("{file}: it has more than {most} frequencies")]
    TooMany {
        /// The file.
        file: String,
        /// The largest number allowed.
        most: usize,
    },
}

impl FrequencyError {
    /// What the user can do.
    pub fn hint(&self) -> Option<String> {
        Some(
            match self {
                Self::Read { .. } => {
                    "give a file, or a range START:STOP:COUNT in rad/s, such as 0.1:100:200"
                }
                Self::NotPositive { .. } => "frequencies are in rad/s and greater than zero",
                Self::NotANumber { .. } | Self::Empty { .. } => {
                    "write one frequency in rad/s in each line, or put them into the first column"
                }
                Self::TooMany { .. } => "give fewer frequencies",
            }
            .to_owned(),
        )
    }
}

/// Reads frequencies \[rad/s\] in the order of the file.
///
/// Empty rows, rows that begin with `#` or `%`, and a first row of names are skipped.
///
/// # Errors
/// [`FrequencyError`] if the file is not a list of frequencies.
pub fn read_frequencies(path: &Path) -> Result<Vec<f64>, FrequencyError> {
    let name = || path.display().to_string();
    let failed = |source| FrequencyError::Read { file: name(), source };
    let mut reader = BufReader::new(File::open(path).map_err(failed)?);
    let (mut frequencies, mut bytes, mut line, mut named) = (Vec::new(), Vec::new(), 0, false);
    loop {
        bytes.clear();
        let length = reader.by_ref().take(LONGEST).read_until(b'\n', &mut bytes).map_err(failed)?;
        if length == 0 {
            break;
        }
        line += 1;
        if !bytes.ends_with(b"\n") {
            reader.skip_until(b'\n').map_err(failed)?;
        }
        let text = String::from_utf8_lossy(&bytes);
        let row = text.trim_start_matches('\u{feff}').trim();
        if row.is_empty() || row.starts_with(['#', '%']) {
            continue;
        }
        let cell = row.split([',', ';', '\t', ' ']).next().unwrap_or("").trim_matches('"');
        match cell.parse::<f64>() {
            Ok(omega) if omega > 0.0 && omega.is_finite() => frequencies.push(omega),
            Ok(found) => return Err(FrequencyError::NotPositive { file: name(), line, found }),
            Err(_) if frequencies.is_empty() && !named => named = true,
            Err(_) => {
                let found = cell.to_owned();
                return Err(FrequencyError::NotANumber { file: name(), line, found });
            }
        }
        if frequencies.len() > MOST {
            return Err(FrequencyError::TooMany { file: name(), most: MOST });
        }
    }
    if frequencies.is_empty() {
        Err(FrequencyError::Empty { file: name() })
    } else {
        Ok(frequencies)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(bytes: &[u8]) -> Result<Vec<f64>, FrequencyError> {
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), bytes).unwrap();
        read_frequencies(file.path())
    }

    #[test]
    fn one_number_a_row_or_the_first_column() {
        assert_eq!(read(b"1\n2.5\n\n# slow\n1e2\n").unwrap(), [1.0, 2.5, 100.0]);
        assert_eq!(read(b"\xef\xbb\xbfomega,re\r\n1,0.5\r\n2,0.4\r\n").unwrap(), [1.0, 2.0]);
        assert_eq!(read(b"3 4\n5\t6\n7;8").unwrap(), [3.0, 5.0, 7.0]);
    }

    #[test]
    fn what_is_no_frequency_is_named_with_its_line() {
        let fails = |bytes: &[u8], end: &str| {
            let error = read(bytes).unwrap_err();
            assert!(error.to_string().ends_with(end), "{error}");
            assert!(error.hint().is_some());
        };
        fails(b"", "there is no frequency in it");
        fails(b"omega\n", "there is no frequency in it");
        fails(b"1\nx\n", "line 2: \"x\" is not a frequency");
        fails(b"omega\nrad/s\n1\n", "line 2: \"rad/s\" is not a frequency");
        fails(b"1\n-2\n", "line 2: -2 is not positive and finite");
        fails(b"0\n", "line 1: 0 is not positive and finite");
        fails(b"nan\n", "line 1: NaN is not positive and finite");
        fails(b"\x89PNG\r\n\x1a\n", "line 2: \"\u{fffd}\" is not a frequency");
    }
}
