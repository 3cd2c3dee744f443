//! Files that are no logs or campaigns at all.

use crate::bench::{Bench, CAMPAIGN, csv, good};

#[test]
fn the_log_is_binary() {
    let noise = |k: u32| (k.wrapping_mul(2_654_435_761) >> 24) as u8;
    Bench::log((0..4000).map(noise).collect::<Vec<u8>>()).refuses(
        "error: run.csv: row 1 is not text\n\
         hint: a log is text with commas, semicolons, tabs or blanks between the numbers: export the file as CSV",
    );
    Bench::log(b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR").refuses(
        "error: run.csv: this is a picture, not a table that can be read\n\
         hint: give the table of numbers as text",
    );
}

#[test]
fn the_log_is_in_utf_16() {
    let log = csv(&good());
    let wide = log.encode_utf16().flat_map(u16::to_le_bytes);
    let marked = Bench::log([0xff, 0xfe].into_iter().chain(wide.clone()).collect::<Vec<u8>>());
    assert!(marked.findings("wrong-readings").is_empty());
    assert!(Bench::log(wide.collect::<Vec<u8>>()).findings("wrong-readings").is_empty());
}

#[test]
fn a_row_is_endless() {
    let row: Vec<String> = (0..1_000_000).map(|k| k.to_string()).collect();
    Bench::log(row.join(",")).refuses(
        "error: run.csv: row 1 is longer than 1048576 bytes\n\
         hint: a log has one sample in each row: check the line ends, or export fewer columns",
    );
}

#[test]
fn a_header_is_not_obeyed_by_the_terminal() {
    let header = format!("t,i,{},p", "\u{9b}2J".repeat(100));
    Bench::log(csv(&good()).replace("t,i,m,p", &header)).refuses(
        "error: run.csv: there is no column \"m\"; the columns are \"t\", \"i\", \
         \"�2J�2J�2J�2J�2J�2J�2J�2J�2J�2J�2J�2J�2J�2J�2J�2J�2J�2J�2J�2J…\", \"p\"\n\
         hint: give one of these names exactly, or the column's number from 1",
    );
}

#[test]
fn a_unit_is_endless() {
    let unit = format!("unit = \"{}\"", "A*".repeat(1_000_000));
    Bench::replacing("unit = \"A\"", &unit).refuses(
        "error: campaign.toml, line 3: `signals.current.unit`: \
         \"A*A*A*A*A*A*A*A*A*A*A*A*A*A*A*A*A*A*A*A*A*A*A*A*A*A*A*A*A*A*…\" is not a unit: it \
         ends too early\n\
         hint: write * for products and / for quotients, as in \"N*m^2\"",
    );
    let unit = format!("unit = \"{}\"", "A".repeat(1_000_000));
    Bench::replacing("unit = \"A\"", &unit).refuses(
        "error: campaign.toml, line 3: `signals.current.unit`: \
         \"AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA…\": there is no unit \
         `AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA…`\n\
         hint: write units as in \"mA\", \"deg\" or \"lbf*in/A\", with * for products and / for \
         quotients",
    );
    let unit = format!("unit = \"{}A\"", "(".repeat(1_000_000));
    Bench::replacing("unit = \"A\"", &unit).refuses(
        "error: campaign.toml, line 3: `signals.current.unit`: \
         \"((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((…\" is not a unit: \
         unexpected `(`\n\
         hint: write * for products and / for quotients, as in \"N*m^2\"",
    );
}

#[test]
fn toml_is_nested_deeply() {
    let deep = "[".repeat(100_000);
    Bench::new().file("campaign.toml", format!("{CAMPAIGN}name = {deep}")).refuses(
        "error: campaign.toml, line 12, column 88: cannot recurse further; max recursion depth \
         met\n\
         hint: the file is TOML: `key = value` lines below [table] lines",
    );
}
