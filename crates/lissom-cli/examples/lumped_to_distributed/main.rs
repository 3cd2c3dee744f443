//! Lumped arms against the distributed beam they tend to, the open question of
//! `[Feliu1989, Section 7]`: prints the tables of `docs/src/theory/lumped-and-distributed.md` and draws its
//! figures, as SVG and PNG, into the folder named on the command line.

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a program for a terminal")]

mod convergence;
mod figures;
mod inertia;
mod tables;

use std::error::Error;
use std::path::PathBuf;

use lissom_report::Figure as _;

/// Where figures go when no folder is named.
const FOLDER: &str = "target/lumped-and-distributed";
/// Pixels of a PNG per unit of its SVG.
const PNG_SCALE: f32 = 2.0;

fn main() -> Result<(), Box<dyn Error>> {
    let mut args = std::env::args_os().skip(1);
    let folder = PathBuf::from(args.next().unwrap_or_else(|| FOLDER.into()));
    if let Some(more) = args.next() {
        return Err(format!("one folder is taken; what is {}?", more.display()).into());
    }
    for (title, table) in tables::all()? {
        println!("{title}\n\n{table}");
    }
    std::fs::create_dir_all(&folder)?;
    for (name, figure) in figures::all()? {
        let path = folder.join(name).with_extension("png");
        std::fs::write(&path, figure.to_png(PNG_SCALE)?)?;
        std::fs::write(path.with_extension("svg"), figure.to_svg()?)?;
        eprintln!("written: {}, .svg", path.display());
    }
    Ok(())
}
