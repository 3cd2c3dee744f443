//! How the raw data of an object are stored.

use crate::number::NumberType;

/// Type of the values of a channel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum RawType {
    Number(NumberType),
    TimeStamp,
    Complex {
        size: usize,
    },
    Text,
    Daqmx,
    /// A type whose size is not known.
    Unknown,
}

impl RawType {
    /// Size of a value \[byte\]; `None` if it differs or is not known.
    pub(super) fn size(self) -> Option<usize> {
        match self {
            Self::Number(number) => Some(number.size()),
            Self::TimeStamp => Some(16),
            Self::Complex { size } => Some(size),
            Self::Text | Self::Daqmx | Self::Unknown => None,
        }
    }
}

/// How the raw data of an object are stored in a chunk.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct RawIndex {
    pub(super) of: RawType,
    /// Number of values.
    pub(super) count: u64,
    /// Size of all values \[byte\].
    pub(super) bytes: u64,
}
