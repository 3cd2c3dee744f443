//! From bytes to text.

use std::borrow::Cow;

use encoding_rs::{Encoding, UTF_8, UTF_16BE, UTF_16LE, WINDOWS_1252};

use crate::format_error::FormatError;

/// Bytes that are looked at for UTF-16 without a byte order mark, and for bytes that no text has.
const LOOKED_AT: usize = 4096;

/// Whether a text is in UTF-16.
pub(super) fn is_utf16(bytes: &[u8]) -> bool {
    encoding(bytes).is_some_and(|(encoding, _)| encoding == UTF_16LE || encoding == UTF_16BE)
}

/// The encoding that the first bytes show, by a byte order mark of some bytes, or because every other byte is zero.
fn encoding(bytes: &[u8]) -> Option<(&'static Encoding, usize)> {
    let first = &bytes[..bytes.len().min(LOOKED_AT)];
    let zeros = |from: usize| first.iter().skip(from).step_by(2).filter(|b| **b == 0).count();
    let most = first.len() / 3;
    Encoding::for_bom(bytes).or(match first.len() {
        ..=3 => None,
        _ if zeros(1) > most => Some((UTF_16LE, 0)),
        _ if zeros(0) > most => Some((UTF_16BE, 0)),
        _ => None,
    })
}

/// Decodes UTF-8, UTF-16 (with or without a byte order mark) and, if it is neither, Windows-1252.
pub(crate) fn decoded(bytes: &[u8]) -> Result<Cow<'_, str>, FormatError> {
    let bytes = match encoding(bytes) {
        Some((encoding, mark)) if encoding == UTF_8 => &bytes[mark..],
        Some((encoding, mark)) => {
            return Ok(encoding.decode_without_bom_handling(&bytes[mark..]).0);
        }
        None => bytes,
    };
    if let Some(at) = bytes.iter().position(|byte| is_control(*byte)) {
        let row = bytes[..at].split(|b| *b == b'\n').count();
        return Err(FormatError::NotText { row });
    }
    Ok(utf8_or_windows(bytes))
}

/// Whether a byte is in no text.
pub(super) fn is_control(byte: u8) -> bool {
    byte.is_ascii_control() && !matches!(byte, b'\t' | b'\r' | b'\n' | b'\x0C')
}

/// Decodes UTF-8 and, if it is none, Windows-1252.
pub(super) fn utf8_or_windows(bytes: &[u8]) -> Cow<'_, str> {
    match std::str::from_utf8(bytes) {
        Ok(text) => text.into(),
        Err(_) => WINDOWS_1252.decode_without_bom_handling(bytes).0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn encodings() {
        let text = "Winkel [°],1";
        let little: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
        let big: Vec<u8> = text.encode_utf16().flat_map(u16::to_be_bytes).collect();
        let with_mark = [&b"\xFF\xFE"[..], &little].concat();
        let latin = b"Winkel [\xB0],1".to_vec();
        for bytes in [text.as_bytes().to_vec(), little, big, with_mark, latin] {
            assert_eq!(decoded(&bytes).unwrap(), text, "{bytes:?}");
        }
        assert!(decoded(b"a,b\n1,\x001\n2,3\n4,5\n6,7\n").is_err());
    }
}
