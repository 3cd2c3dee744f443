//! Files that are no logs or campaigns at all.

use crate::bench::{Bench, CAMPAIGN, csv, good};

#[test]
fn the_log_is_binary() {
    let noise = |k: u32| (k.wrapping_mul(2_654_435_761) >> 24) as u8;
    Bench::log((0..4000).map(noise).collect::<Vec<u8>>()).refuses("");
    Bench::log(b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR").refuses("");
}

#[test]
fn the_log_is_in_utf_16() {
    let wide = csv(&good()).encode_utf16().flat_map(u16::to_le_bytes);
    Bench::log([0xff, 0xfe].into_iter().chain(wide).collect::<Vec<u8>>()).refuses("");
}

#[test]
fn a_row_is_endless() {
    let row: Vec<String> = (0..1_000_000).map(|k| k.to_string()).collect();
    Bench::log(row.join(",")).refuses("");
}

#[test]
fn a_header_is_not_obeyed_by_the_terminal() {
    let header = format!("t,i,{},p", "\u{9b}2J".repeat(100));
    Bench::log(csv(&good()).replace("t,i,m,p", &header)).refuses("");
}

#[test]
fn a_unit_is_endless() {
    let unit = format!("unit = \"{}\"", "A*".repeat(1_000_000));
    Bench::replacing("unit = \"A\"", &unit).refuses("");
    let unit = format!("unit = \"{}\"", "A".repeat(1_000_000));
    Bench::replacing("unit = \"A\"", &unit).refuses("");
    let unit = format!("unit = \"{}A\"", "(".repeat(1_000_000));
    Bench::replacing("unit = \"A\"", &unit).refuses("");
}

#[test]
fn toml_is_nested_deeply() {
    let deep = "[".repeat(100_000);
    Bench::new().file("campaign.toml", format!("{CAMPAIGN}name = {deep}")).refuses("");
}
