//! What the fuzz targets share: each reads inputs of one format only, so that its corpus stays one of that format.

use std::io::{Cursor, Write as _};
use std::panic;

use libfuzzer_sys::Corpus;
use lissom_formats::read_bytes;
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

/// A target: `$read` reads an input and states whether the corpus may keep it.
#[macro_export]
macro_rules! target {
    ($read:expr) => {
        libfuzzer_sys::fuzz_target!(
            init: $crate::let_others_panic(),
            |bytes: &[u8]| -> libfuzzer_sys::Corpus { $read(bytes) }
        );
    };
}

/// Lets a panic of another library pass on to lissom, which makes an error of it; libFuzzer would end at each panic.
pub fn let_others_panic() {
    let ends = panic::take_hook();
    panic::set_hook(Box::new(move |info| {
        if info.location().is_none_or(|place| place.file().contains("lissom-formats")) {
            ends(info);
        }
    }));
}

/// Reads an input that begins as one of `begins`.
pub fn read_if_begins(bytes: &[u8], begins: &[&[u8]]) -> Corpus {
    if !begins.iter().any(|begin| bytes.starts_with(begin)) {
        return Corpus::Reject;
    }
    let _ = read_bytes(bytes.to_vec());
    Corpus::Keep
}

/// Reads an input that no other target reads.
pub fn read_text(bytes: &[u8], is_json: bool) -> Corpus {
    let first = bytes.trim_ascii_start().first();
    let looks = matches!(first, Some(b'{' | b'['));
    if looks != is_json || lissom_formats::is_no_plain_table(bytes) {
        return Corpus::Reject;
    }
    let _ = read_bytes(bytes.to_vec());
    Corpus::Keep
}

/// An archive of stored entries, with right checksums: an input alone would hardly ever have them.
pub fn archive(entries: &[(&str, &[u8])]) -> Vec<u8> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, content) in entries {
        // Writing to memory does not fail.
        let _ = archive.start_file(*name, SimpleFileOptions::default());
        let _ = archive.write_all(content);
    }
    archive.finish().map(Cursor::into_inner).unwrap_or_default()
}
