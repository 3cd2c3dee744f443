#![no_main]

use lissom_fuzz::{read_if_begins, target};

target!(|bytes| read_if_begins(
    bytes,
    &[b"MATLAB 5.0 MAT-file", b"\0\0\0\0", b"\n\0\0\0", b"\x14\0\0\0", b"\x1e\0\0\0", b"\0\0\x03"]
));
