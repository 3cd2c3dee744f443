#![no_main]

use lissom_fuzz::{read_text, target};

target!(|bytes| read_text(bytes, false));
