//! Logs that are used, and what is said of them.

use crate::bench::{Bench, csv, good};

#[test]
fn the_good_log_is_good() {
    let result = Bench::new().result();
    println!("{:#}", result["findings"]);
    println!("{:#}", result["friction"]);
    assert!(result["friction"]["coulomb_nm"]["value"].is_number());
}
