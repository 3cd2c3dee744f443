//! `cargo deny`: licences, bans and sources always; advisories if their database can be reached.

use std::path::Path;

use crate::step::{Failure, ask, cargo, run};

/// Checks the dependencies against `deny.toml`.
pub(crate) fn check(root: &Path) -> Result<(), Failure> {
    let (installed, _) = ask(&mut cargo(root, &["deny", "--version"]))?;
    if !installed {
        return Err(Failure::Missing {
            tool: "cargo-deny",
            install: "cargo install cargo-deny --locked",
        });
    }
    let parts = ["deny", "check", "--hide-inclusion-graph", "licenses", "bans", "sources"];
    run("cargo deny: licences, bans, sources", &mut cargo(root, &parts))?;

    // The database is fetched in a separate step, so that a failed check below is not a failed download.
    let (reached, errors) = ask(&mut cargo(root, &["deny", "fetch", "db"]))?;
    if !reached {
        println!("\n--- cargo deny: advisories NOT CHECKED: their database cannot be reached");
        if let Some(reason) = errors.lines().rfind(|line| !line.trim().is_empty()) {
            println!("    {}", reason.trim());
        }
        return Ok(());
    }
    let advisories = ["deny", "check", "--disable-fetch", "--hide-inclusion-graph", "advisories"];
    run("cargo deny: advisories", &mut cargo(root, &advisories))
}
