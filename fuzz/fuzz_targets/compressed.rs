#![no_main]

use lissom_fuzz::{read_if_begins, target};

target!(|bytes| read_if_begins(bytes, &[b"PK\x03\x04", b"\x1f\x8b", b"\x28\xb5\x2f\xfd"]));
