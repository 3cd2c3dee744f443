#![no_main]

use lissom_fuzz::{read_if_begins, target};

target!(|bytes| read_if_begins(bytes, &[b"\x93NUMPY"]));
