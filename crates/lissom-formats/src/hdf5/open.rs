//! HDF5 files for the library that reads them: in pieces, and without soft links.

use std::io;

use hdf5_pure::{File, FileAccessProperties, FormatError as Hdf5Error, WriteMarkPolicy};

use super::dataset::damaged;
use crate::format_error::FormatError;
use crate::source::Source;

/// The file with these bytes.
pub(crate) fn opened(source: &Source) -> Result<File, FormatError> {
    // A program that did not close the file has marked it.
    let properties =
        FileAccessProperties::new().with_write_mark_policy(WriteMarkPolicy::AllowSnapshot);
    let source = WithoutSoftLinks(source.clone());
    File::from_source_with_options(source, properties).map_err(damaged)
}

#[expect(clippy::needless_pass_by_value, reason = "for map_err")]
fn failed(error: io::Error) -> Hdf5Error {
    Hdf5Error::Source(error.to_string())
}

/// A file whose groups of the older kind have no soft links: the library takes them for damage and reads none of the group.
struct WithoutSoftLinks(Source);

impl hdf5_pure::Source for WithoutSoftLinks {
    fn len(&self) -> u64 {
        self.0.length()
    }

    fn read_at(&self, place: u64, out: &mut [u8]) -> Result<(), Hdf5Error> {
        let end = place.saturating_add(out.len() as u64);
        if end > self.len() {
            let (expected, available) = (end as usize, self.len() as usize);
            return Err(Hdf5Error::UnexpectedEof { expected, available });
        }
        self.0.read_at(place, out).map_err(failed)
    }

    fn read_metadata_at(&self, place: u64, count: usize) -> Result<Vec<u8>, Hdf5Error> {
        let mut bytes = self.read_exact_at(place, count)?;
        if let Some(entries) = count_of_node(&bytes) {
            let end = place + (NODE_BYTES + entries * ENTRY_BYTES) as u64;
            let mut node = self.0.bytes(place..end).map_err(failed)?.into_owned();
            remove_soft_links(&mut node, entries);
            bytes.iter_mut().zip(node).for_each(|(byte, changed)| *byte = changed);
        }
        Ok(bytes)
    }
}

/// Bytes of the header of a node of a symbol table.
const NODE_BYTES: usize = 8;
/// Bytes of an entry with addresses of 64 bits.
const ENTRY_BYTES: usize = 40;

/// Number of entries of the node of a symbol table that begins here.
fn count_of_node(bytes: &[u8]) -> Option<usize> {
    let count = bytes.strip_prefix(b"SNOD\x01\x00")?.first_chunk::<2>()?;
    Some(usize::from(u16::from_le_bytes(*count)))
}

/// Removes the soft links of a node of a symbol table.
///
/// # Source
/// HDF5 file format specification 3.0, III.B and III.C: nodes and entries of symbol tables.
fn remove_soft_links(node: &mut [u8], count: usize) {
    let Some((header, entries)) = node.split_at_mut_checked(NODE_BYTES) else { return };
    if entries.len() < count * ENTRY_BYTES {
        return;
    }
    let mut kept = 0;
    for k in 0..count {
        let entry = k * ENTRY_BYTES..(k + 1) * ENTRY_BYTES;
        let bytes = entries.get(entry.clone()).unwrap_or_default();
        // No address of an object, and the type of a soft link.
        let is_soft = bytes.get(8..20) == Some(b"\xff\xff\xff\xff\xff\xff\xff\xff\x02\0\0\0");
        if !is_soft {
            entries.copy_within(entry, kept * ENTRY_BYTES);
            kept += 1;
        }
    }
    if let Some(stated) = header.get_mut(6..) {
        stated.copy_from_slice(&(kept as u16).to_le_bytes());
    }
}
