//! Numbers of binary files.

/// Type of the numbers of a binary file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum NumberType {
    I8,
    I16,
    I32,
    I64,
    U8,
    U16,
    U32,
    U64,
    F16,
    F32,
    F64,
    /// Counts of 64 bits, from an origin; the least one stands for a missing value.
    Ticks {
        origin: i64,
    },
}

/// Type and byte order of numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Number {
    pub(crate) kind: NumberType,
    pub(crate) big_endian: bool,
}

/// What `$of` makes of the Rust type of a number; other types follow as the arms of a match.
macro_rules! by_type {
    ($kind:expr, $of:ident, { $($others:tt)* }) => {
        match $kind {
            NumberType::I8 => $of!(i8),
            NumberType::I16 => $of!(i16),
            NumberType::I32 => $of!(i32),
            NumberType::I64 => $of!(i64),
            NumberType::U8 => $of!(u8),
            NumberType::U16 => $of!(u16),
            NumberType::U32 => $of!(u32),
            NumberType::U64 => $of!(u64),
            NumberType::F32 => $of!(f32),
            NumberType::F64 => $of!(f64),
            $($others)*
        }
    };
}

impl NumberType {
    /// Size of a number \[byte\].
    pub(crate) fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 | Self::F16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::I64 | Self::U64 | Self::F64 | Self::Ticks { .. } => 8,
        }
    }
}

impl Number {
    pub(crate) fn new(kind: NumberType, big_endian: bool) -> Self {
        Self { kind, big_endian }
    }

    /// Appends `count` numbers that begin every `stride` bytes; fewer if there are fewer bytes.
    pub(crate) fn append(self, out: &mut Vec<f64>, bytes: &[u8], stride: usize, count: usize) {
        /// Numbers of one type, in both byte orders.
        macro_rules! of {
            ($number:ty) => {
                if self.big_endian {
                    spaced(out, bytes, stride, count, |b| <$number>::from_be_bytes(b) as f64)
                } else {
                    spaced(out, bytes, stride, count, |b| <$number>::from_le_bytes(b) as f64)
                }
            };
        }
        by_type!(self.kind, of, {
            NumberType::Ticks { origin } => {
                let since = |ticks: i64| ticks.wrapping_sub(origin) as f64;
                let value = |ticks: i64| if ticks == i64::MIN { f64::NAN } else { since(ticks) };
                spaced(out, bytes, stride, count, |b| value(self.i64(b)));
            }
            NumberType::F16 if self.big_endian => {
                spaced(out, bytes, stride, count, |b| half(u16::from_be_bytes(b)));
            }
            NumberType::F16 => spaced(out, bytes, stride, count, |b| half(u16::from_le_bytes(b))),
        });
    }

    /// The number at the beginning of the bytes.
    #[cfg(feature = "mcap")]
    pub(crate) fn value(self, bytes: &[u8]) -> Option<f64> {
        macro_rules! of {
            ($number:ty) => {{
                let bytes = *bytes.first_chunk()?;
                if self.big_endian {
                    <$number>::from_be_bytes(bytes) as f64
                } else {
                    <$number>::from_le_bytes(bytes) as f64
                }
            }};
        }
        Some(by_type!(self.kind, of, {
            NumberType::F16 | NumberType::Ticks { .. } => return None,
        }))
    }

    fn i64(self, bytes: [u8; 8]) -> i64 {
        if self.big_endian { i64::from_be_bytes(bytes) } else { i64::from_le_bytes(bytes) }
    }

    /// Ticks counted from the first of the bytes.
    pub(crate) fn since_first(self, bytes: &[u8]) -> Self {
        let first = bytes.first_chunk().map(|first| self.i64(*first));
        let origin = first.filter(|ticks| *ticks != i64::MIN).unwrap_or(0);
        Self { kind: NumberType::Ticks { origin }, ..self }
    }
}

fn spaced<const N: usize>(
    out: &mut Vec<f64>,
    bytes: &[u8],
    stride: usize,
    count: usize,
    value: impl Fn([u8; N]) -> f64,
) {
    if stride == N {
        let numbers = bytes.as_chunks::<N>().0;
        out.extend(numbers.iter().take(count).map(|b| value(*b)));
    } else {
        let first = |chunk: &[u8]| chunk.first_chunk::<N>().map(|b| value(*b));
        out.extend(bytes.chunks(stride.max(1)).take(count).map_while(first));
    }
}

/// A number of 16 bits, IEEE 754 half precision: sign, 5 bits of exponent, 10 bits of fraction.
pub(crate) fn half(bits: u16) -> f64 {
    let fraction = f64::from(bits & 0x3ff);
    let size = match (bits >> 10) & 0x1f {
        0 => fraction * 2f64.powi(-24),
        0x1f if fraction < 0.5 => f64::INFINITY,
        0x1f => f64::NAN,
        exponent => (fraction / 1024.0 + 1.0) * 2f64.powi(i32::from(exponent) - 15),
    };
    if bits & 0x8000 == 0 { size } else { -size }
}

#[cfg(test)]
mod tests {
    use super::half;

    #[test]
    fn half_precision_has_its_values() {
        let cases = [(0x3c00, 1.0), (0xc000, -2.0), (0x7bff, 65504.0), (0x0001, 2f64.powi(-24))];
        for (bits, value) in cases {
            assert!((half(bits) - value).abs() < 1e-15, "{bits:x}");
        }
        assert!(half(0x7c00).is_infinite() && half(0x7e00).is_nan());
    }
}
