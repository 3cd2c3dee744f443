//! Numbers with digits and at most one point, which are most of those in logs.

/// A number with at most 15 digits, so that one division of two exact numbers gives the nearest value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlainDecimal {
    /// The number.
    pub value: f64,
    /// Digits after the point.
    pub decimals: usize,
    /// Number of its characters.
    pub length: usize,
}

/// Numbers up to here, divided by an exact power of ten, are the nearest to what is written.
const MOST: u64 = 999_999_999_999_999;
/// So many digits are below 2^64.
const MOST_DIGITS: usize = 19;

/// Powers of ten that are exact.
const TENS: [f64; MOST_DIGITS + 1] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
    1e17, 1e18, 1e19,
];

impl PlainDecimal {
    /// A text that is such a number, with this decimal sign.
    pub fn value_of(text: &str, point: u8) -> Option<f64> {
        Self::leading(text.as_bytes(), point)
            .filter(|of| of.length == text.len())
            .map(|of| of.value)
    }

    /// The number at the beginning of a text, with this decimal sign.
    #[inline]
    pub fn leading(text: &[u8], point: u8) -> Option<Self> {
        let negative = text.first() == Some(&b'-');
        let mut rest = &text[usize::from(negative)..];
        let (mut digits, mut count) = (0_u64, 0);
        // Before the point are few digits, behind it many.
        while let Some((byte @ b'0'..=b'9', others)) = rest.split_first()
            && count < MOST_DIGITS
        {
            (digits, count, rest) = (10 * digits + u64::from(byte - b'0'), count + 1, others);
        }
        let whole = count;
        let has_point = rest.first() == Some(&point);
        if has_point {
            rest = &rest[1..];
            while let Some(chunk) = rest.first_chunk()
                && count + 8 <= MOST_DIGITS
            {
                let (value, its_count) = first_of(*chunk);
                (digits, count) = (digits * POWERS[its_count] + value, count + its_count);
                rest = &rest[its_count..];
                if its_count < 8 {
                    break;
                }
            }
            while let Some((byte @ b'0'..=b'9', others)) = rest.split_first()
                && count < MOST_DIGITS
            {
                (digits, count, rest) = (10 * digits + u64::from(byte - b'0'), count + 1, others);
            }
        }
        let is_cut = rest.first().is_some_and(u8::is_ascii_digit);
        if count == 0 || digits > MOST || is_cut {
            return None;
        }
        let decimals = count - whole;
        let value = digits as f64 / TENS[decimals];
        let value = if negative { -value } else { value };
        Some(Self {
            value,
            decimals,
            length: usize::from(negative) + count + usize::from(has_point),
        })
    }
}

/// Powers of ten.
const POWERS: [u64; 9] = [1, 10, 100, 1000, 10_000, 100_000, 1_000_000, 10_000_000, 100_000_000];

/// The digits at the beginning of eight characters: their value and number. All are looked at together, each in its byte of
/// one integer.
fn first_of(text: [u8; 8]) -> (u64, usize) {
    const ALL: u64 = 0x0101_0101_0101_0101;
    let word = u64::from_le_bytes(text);
    // The highest bit of a byte is set where the character is below '0' or above '9'.
    let others = (word.wrapping_sub(0x30 * ALL) | word.wrapping_add(0x46 * ALL)) & (0x80 * ALL);
    let count = (others.trailing_zeros() / 8) as usize;
    if count == 0 {
        return (0, 0);
    }
    // Zeros before the digits, in the lower bytes.
    let digits = (word.wrapping_sub(0x30 * ALL)) << (64 - 8 * count);
    // Pairs, then fours, then all eight.
    let pairs = (digits.wrapping_mul(10)).wrapping_add(digits >> 8) & 0x00FF_00FF_00FF_00FF;
    let fours = (pairs.wrapping_mul(100)).wrapping_add(pairs >> 16) & 0x0000_FFFF_0000_FFFF;
    let eight = (fours.wrapping_mul(10_000)).wrapping_add(fours >> 32) & 0xFFFF_FFFF;
    (eight, count)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn is_as_the_library_reads(cell: &str) {
        for rest in ["", ",1", ";", "\n0.123456789"] {
            let text = format!("{cell}{rest}");
            if let Some(found) = PlainDecimal::leading(text.as_bytes(), b'.') {
                let read: f64 = cell.parse().unwrap();
                assert!(found.value.total_cmp(&read).is_eq(), "{text}: {found:?}");
                assert_eq!(found.length, cell.len(), "{text}");
                let point = cell.find('.').map_or(cell.len(), |at| at + 1);
                assert_eq!(found.decimals, cell.len() - point, "{text}");
            }
        }
    }

    #[test]
    fn plain_decimals() {
        for cell in [
            "0",
            "-0",
            "-0.0",
            "1.",
            ".5",
            "-.25",
            "12.345678901",
            "0.000000004738",
            "123456789012345",
            "999999999999999",
            "0.00000000012345",
        ] {
            is_as_the_library_reads(cell);
            assert!(PlainDecimal::leading(cell.as_bytes(), b'.').is_some(), "{cell}");
        }
        for cell in [
            "",
            ".",
            "-",
            "--1",
            "1234567890123456",
            "1.234567890123456789",
            "00000000000000000000.1",
        ] {
            assert_eq!(PlainDecimal::leading(cell.as_bytes(), b'.'), None, "{cell}");
        }
        assert_eq!(PlainDecimal::value_of("1,5", b','), Some(1.5));
        assert_eq!(PlainDecimal::leading(b"1,5", b'.').unwrap().length, 1);
    }

    proptest! {
        #[test]
        fn as_the_library_reads(cell in "-?[0-9]{0,12}\\.?[0-9]{0,12}") {
            is_as_the_library_reads(&cell);
        }

        #[test]
        fn digits_before_anything(text in any::<[u8; 8]>()) {
            let digits: Vec<u8> = text.into_iter().take_while(u8::is_ascii_digit).collect();
            let value = digits.iter().fold(0, |sum, digit| 10 * sum + u64::from(digit - b'0'));
            prop_assert_eq!(first_of(text), (value, digits.len()));
        }
    }
}
