//! Memory while two of 25 channels of a file of 200 MB are read: that of their values, and not that of the file.

#![expect(clippy::unwrap_used, reason = "tests")]

use std::fs::File;
use std::io::{Seek, SeekFrom, Write};
use std::path::Path;

use allocation_counter::measure;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use lissom_formats::{ChannelRef, ReadOptions, read_channels};

const CHANNELS: usize = 25;
const ROWS: usize = 1_000_000;
/// The same rows are written several times.
const BLOCK_ROWS: usize = 10_000;
const BLOCKS: usize = ROWS / BLOCK_ROWS;
/// The channels that are read, from 1.
const WANTED: [usize; 2] = [3, 20];

/// Most bytes: those of the wanted values and of their time stamps, in vectors that grow, and of blocks of the file. The
/// file has 200 MB.
const MOST_BYTES: u64 = 50_000_000;

fn value(row: usize, channel: usize) -> f64 {
    (row % BLOCK_ROWS) as f64 + 1e-3 * channel as f64
}

/// A row of values.
fn row(row: usize) -> Vec<u8> {
    (1..=CHANNELS).flat_map(|channel| value(row, channel).to_le_bytes()).collect()
}

/// The values of a channel in a block of rows.
fn column(channel: usize) -> Vec<u8> {
    (0..BLOCK_ROWS).flat_map(|row| value(row, channel).to_le_bytes()).collect()
}

/// A text with its length before it.
fn text(text: &str) -> Vec<u8> {
    [&(text.len() as u32).to_le_bytes(), text.as_bytes()].concat()
}

/// Writes a file, and reads the wanted channels of it.
fn check(write: impl Fn(&mut File), name: impl Fn(usize) -> String) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("log");
    write(&mut File::create(&path).unwrap());
    let bytes = bytes_of_reading(&path, &WANTED.map(&name));
    assert!(bytes < MOST_BYTES, "{bytes} bytes");
}

fn bytes_of_reading(path: &Path, names: &[String]) -> u64 {
    let wanted: Vec<ChannelRef> = names.iter().cloned().map(ChannelRef::Name).collect();
    let mut found = None;
    let counted =
        measure(|| found = Some(read_channels(path, &ReadOptions::default(), &wanted).unwrap()));
    let found = found.unwrap();
    assert!(found.channels.len() >= CHANNELS && found.notes.is_empty(), "{:?}", found.notes);
    for (name, number) in names.iter().zip(WANTED) {
        let channel = found.channels.iter().find(|channel| channel.name == *name).unwrap();
        assert_eq!(channel.values.len(), ROWS);
        let expected = (0..ROWS).map(|row| value(row, number).to_bits());
        assert!(channel.values.iter().map(|v| v.to_bits()).eq(expected), "{name}");
    }
    counted.bytes_max
}

#[test]
fn an_array_of_numpy_is_read_in_blocks() {
    let write = |file: &mut File| {
        let header =
            format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({ROWS}, {CHANNELS}), }}");
        let length = (header.len() as u16).to_le_bytes();
        file.write_all(&[b"\x93NUMPY\x01\x00", &length[..], header.as_bytes()].concat()).unwrap();
        let block: Vec<u8> = (0..BLOCK_ROWS).flat_map(row).collect();
        (0..BLOCKS).for_each(|_| file.write_all(&block).unwrap());
    };
    check(write, |k| format!("data[{k}]"));
}

fn words(words: &[u32]) -> Vec<u8> {
    words.iter().flat_map(|w| w.to_le_bytes()).collect()
}

/// A data element of MATLAB.
fn element(kind: u32, data: &[u8]) -> Vec<u8> {
    let mut bytes = [words(&[kind, data.len() as u32]), data.to_vec()].concat();
    bytes.resize(bytes.len().next_multiple_of(8), 0);
    bytes
}

fn write_header(file: &mut File) {
    let mut header = b"MATLAB 5.0 MAT-file".to_vec();
    header.resize(124, b' ');
    file.write_all(&[&header, &b"\x00\x01IM"[..]].concat()).unwrap();
}

/// A MATLAB array with the values of a channel; its number of bytes.
fn write_array(out: &mut impl Write, name: &str, channel: usize) -> usize {
    let parts = [
        element(6, &words(&[6, 0])),
        element(5, &words(&[ROWS as u32, 1])),
        element(1, name.as_bytes()),
        words(&[9, 8 * ROWS as u32]),
    ]
    .concat();
    let bytes = parts.len() + 8 * ROWS;
    out.write_all(&[words(&[14, bytes as u32]), parts].concat()).unwrap();
    let block = column(channel);
    (0..BLOCKS).for_each(|_| out.write_all(&block).unwrap());
    8 + bytes
}

#[test]
fn variables_of_matlab_are_skipped() {
    let write = |file: &mut File| {
        write_header(file);
        for channel in 1..=CHANNELS {
            write_array(file, &format!("x{channel}"), channel);
        }
    };
    check(write, |k| format!("x{k}"));
}

#[test]
fn a_compressed_struct_of_matlab_is_expanded_in_pieces() {
    let write = |file: &mut File| {
        write_header(file);
        let names = (1..=CHANNELS).map(|k| format!("{:\0<8}", format!("x{k}")));
        let parts = [
            element(6, &words(&[2, 0])),
            element(5, &words(&[1, 1])),
            element(1, b"log"),
            words(&[4 << 16 | 5, 8]),
            element(1, names.collect::<String>().as_bytes()),
        ]
        .concat();
        let array = write_array(&mut std::io::sink(), "", 1);
        let place = file.stream_position().unwrap();
        file.write_all(&words(&[15, 0])).unwrap();
        let mut packed = ZlibEncoder::new(&mut *file, Compression::fast());
        let bytes = parts.len() + CHANNELS * array;
        packed.write_all(&[words(&[14, bytes as u32]), parts].concat()).unwrap();
        for channel in 1..=CHANNELS {
            write_array(&mut packed, "", channel);
        }
        packed.finish().unwrap();
        let end = file.stream_position().unwrap();
        file.seek(SeekFrom::Start(place)).unwrap();
        file.write_all(&words(&[15, (end - place - 8) as u32])).unwrap();
    };
    check(write, |k| format!("log/x{k}"));
}

#[test]
fn channels_in_segments_of_tdms_are_skipped() {
    let write = |file: &mut File| {
        let mut metadata = (CHANNELS as u32).to_le_bytes().to_vec();
        for channel in 1..=CHANNELS {
            metadata.extend(text(&format!("/'g'/'x{channel}'")));
            // Length of the index, f64, one dimension, number of values, no properties.
            metadata.extend([20_u32, 10, 1].map(u32::to_le_bytes).concat());
            metadata.extend((BLOCK_ROWS as u64).to_le_bytes());
            metadata.extend(0_u32.to_le_bytes());
        }
        // Metadata, a new list of objects, and raw data.
        let mut segment = b"TDSm\x0e\x00\x00\x00\x69\x12\x00\x00".to_vec();
        segment.extend(((metadata.len() + 8 * CHANNELS * BLOCK_ROWS) as u64).to_le_bytes());
        segment.extend((metadata.len() as u64).to_le_bytes());
        segment.extend(metadata);
        (1..=CHANNELS).for_each(|channel| segment.extend(column(channel)));
        (0..BLOCKS).for_each(|_| file.write_all(&segment).unwrap());
    };
    check(write, |k| format!("g/x{k}"));
}

#[test]
fn records_of_wpilib_are_read_one_by_one() {
    let write = |file: &mut File| {
        let start = [&[0, 1, 0, 0, 0][..], &text("x"), &text("double[]"), &text("")].concat();
        file.write_all(b"WPILOG\x00\x01\0\0\0\0").unwrap();
        file.write_all(&[&[0, 0, start.len() as u8, 0], &start[..]].concat()).unwrap();
        let record = |k| [&[0, 1, 8 * CHANNELS as u8, 5], &row(k)[..]].concat();
        let block: Vec<u8> = (0..BLOCK_ROWS).flat_map(record).collect();
        (0..BLOCKS).for_each(|_| file.write_all(&block).unwrap());
    };
    check(write, |k| format!("x[{k}]"));
}

#[cfg(feature = "mcap")]
#[test]
fn chunks_of_mcap_are_read_one_by_one() {
    let record = |kind: u8, content: &[u8]| {
        [&[kind], &(content.len() as u64).to_le_bytes()[..], content].concat()
    };
    let write = |file: &mut File| {
        let definition = format!("float64[{CHANNELS}] x");
        let schema = [&[1, 0][..], &text("p/X"), &text("ros2msg"), &text(&definition)].concat();
        let channel = [&[1, 0, 1, 0][..], &text("/t"), &text("cdr"), &text("")].concat();
        file.write_all(b"\x89MCAP0\r\n").unwrap();
        file.write_all(&[record(3, &schema), record(4, &channel)].concat()).unwrap();
        // Number of the channel and of the message, two times, and the header of CDR.
        let message = |k| record(5, &[&[1][..], &[0; 21], &[0, 1, 0, 0], &row(k)].concat());
        let records: Vec<u8> = (0..BLOCK_ROWS).flat_map(message).collect();
        // Two times, size, no checksum, no compression, size.
        let size = (records.len() as u64).to_le_bytes();
        let chunk = record(6, &[&[0; 16][..], &size, &[0; 8], &size, &records].concat());
        (0..BLOCKS).for_each(|_| file.write_all(&chunk).unwrap());
        file.write_all(&record(15, &[0; 4])).unwrap();
    };
    check(write, |k| format!("/t/x[{k}]"));
}

/// A table with decimal commas.
fn write_table(out: &mut impl Write) {
    let names: Vec<String> = (1..=CHANNELS).map(|k| format!("c{k} [rad]")).collect();
    writeln!(out, "{}", names.join(";")).unwrap();
    let mut block = String::new();
    for row in 0..BLOCK_ROWS {
        let cells: Vec<String> = (1..=CHANNELS).map(|k| format!("{:.3}", value(row, k))).collect();
        block += &(cells.join(";").replace('.', ",") + "\n");
    }
    (0..BLOCKS).for_each(|_| out.write_all(block.as_bytes()).unwrap());
}

#[test]
fn a_text_is_read_line_by_line() {
    let write = |file: &mut File| write_table(file);
    check(write, |k| format!("c{k} [rad]"));
}

#[test]
fn a_compressed_text_is_expanded_while_it_is_read() {
    let write = |file: &mut File| {
        let mut file = flate2::write::GzEncoder::new(file, Compression::fast());
        write_table(&mut file);
        file.finish().unwrap();
    };
    check(write, |k| format!("c{k} [rad]"));
}
