//! Arguments of `lissom plot`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::stored_args::StoredArgs;

/// Draws one figure of the report page of a stored result, for a paper or a presentation. Without --figure: lists the
/// figures that there are. Figures of motion, torque, cycles and residuals need logs.
#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub(crate) struct PlotArgs {
    #[command(flatten)]
    pub(crate) stored: StoredArgs,
    /// Name of the figure, e.g. bode-motor [default: list the names]
    #[arg(long, value_name = "NAME")]
    pub(crate) figure: Option<String>,
    /// Run of the figure, if there is one for each run [default: the first of the list]
    #[arg(long, value_name = "NAME", requires = "figure")]
    pub(crate) run: Option<String>,
    /// svg, png or pdf [default: by the ending of --out, otherwise svg]
    #[arg(long, value_name = "FORMAT", requires = "figure", hide_possible_values = true)]
    pub(crate) format: Option<PlotFormat>,
    /// The file [default: the name of the figure]
    #[arg(long, value_name = "FILE", requires = "figure")]
    pub(crate) out: Option<PathBuf>,
}

/// Format of a figure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum PlotFormat {
    Svg,
    Png,
    Pdf,
}

const HELP: &str = "\
Examples:
  lissom plot result.json
  lissom plot result.json --figure bode-motor --format pdf
  lissom plot result.json campaign.toml --figure motion --run run-07 --out motion.pdf
  lissom plot result.json run-09.csv --like campaign.toml --figure torque --out torque.png
SVG and PDF are vector graphics. PDF has its text as outlines and needs no font.";
