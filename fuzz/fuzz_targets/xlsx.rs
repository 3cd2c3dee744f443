#![no_main]

use libfuzzer_sys::Corpus;
use lissom_formats::read_bytes;
use lissom_fuzz::{archive, target};

/// The part that leads to the workbook: its path and its content.
const ROOT: (&str, &[u8]) = (
    "_rels/.rels",
    b"<Relationships><Relationship \
      Type=\"http://schemas.openxmlformats.org/officeDocument/2006/relationships/officeDocument\" \
      Target=\"xl/workbook.xml\" Id=\"rId1\"/></Relationships>",
);

/// How a part of a workbook begins, its path, and its content if the input is another part.
const PARTS: [(&str, &str, &str); 5] = [
    (
        "<workbook",
        "xl/workbook.xml",
        "<workbook xmlns:r=\"http://schemas.openxmlformats.org/officeDocument/2006/relationships\">\
         <sheets><sheet name=\"log\" sheetId=\"1\" r:id=\"rId1\"/></sheets></workbook>",
    ),
    (
        "<Relationships",
        "xl/_rels/workbook.xml.rels",
        "<Relationships><Relationship \
         Type=\"http://schemas.openxmlformats.org/officeDocument/2006/relationships/worksheet\" \
         Target=\"worksheets/sheet1.xml\" Id=\"rId1\"/></Relationships>",
    ),
    (
        "<worksheet",
        "xl/worksheets/sheet1.xml",
        "<worksheet><sheetData><row r=\"1\"><c r=\"A1\" s=\"1\"><v>1</v></c><c r=\"B1\" t=\"s\">\
         <v>0</v></c><c r=\"C1\"><v>2</v></c></row><row r=\"2\"><c r=\"A2\"><v>2</v></c>\
         <c r=\"C2\"><v>2</v></c></row></sheetData></worksheet>",
    ),
    (
        "<styleSheet",
        "xl/styles.xml",
        "<styleSheet><cellXfs count=\"2\"><xf numFmtId=\"0\"/><xf numFmtId=\"14\"/></cellXfs>\
         </styleSheet>",
    ),
    ("<sst", "xl/sharedStrings.xml", "<sst><si><t>time</t></si></sst>"),
];

/// Reads a workbook whose one part is the input; the other parts are right.
fn read_with(bytes: &[u8]) -> Corpus {
    if !PARTS.iter().any(|(begin, ..)| bytes.starts_with(begin.as_bytes())) {
        return Corpus::Reject;
    }
    let mut parts = vec![ROOT];
    for (begin, path, content) in PARTS {
        let is_input = bytes.starts_with(begin.as_bytes());
        parts.push((path, if is_input { bytes } else { content.as_bytes() }));
    }
    let _ = read_bytes(archive(&parts));
    Corpus::Keep
}

target!(read_with);
