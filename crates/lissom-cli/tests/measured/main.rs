//! Tests on logs measured on real machines. The logs are no part of the project: the tests read
//! them from the folder that `LISSOM_DATA` names, and say that they were skipped where it is unset.

#![expect(clippy::unwrap_used, reason = "tests")]

mod baseline;
mod common;
mod cu;
mod emps;
mod krauss;
mod krauss_loop;
mod quanser;
mod sets;
mod ur10e;

/// The folders that these tests read.
const FOLDERS: [&str; 5] = ["emps", "krauss-slfr", "quanser-2dsfl", "cu-flexarm", "ur10e"];

#[test]
fn every_folder_says_where_its_logs_come_from() {
    for name in FOLDERS {
        let Some(folder) = common::data(name) else { return };
        assert!(folder.join("PROVENANCE.md").is_file(), "{name} has no PROVENANCE.md");
    }
}
