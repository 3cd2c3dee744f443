//! `lissom plot RESULT [LOG...]`.

use std::path::{Path, PathBuf};

use lissom_io::nearest;
use lissom_io::write::Batch;
use lissom_views::page_figures::OF_LOGS;
use lissom_views::{NamedFigure, page_figures};

use crate::args::plot_args::{PlotArgs, PlotFormat};
use crate::shared::exit_codes::ExitCode;
use crate::shared::failure::Failure;
use crate::shared::output_guard;
use crate::shared::shell_word::shell_word;
use crate::tasks::stored_result::StoredResult;
use crate::views::plot_file::PNG_SCALE;
use crate::views::{figure_table, printer};

pub(crate) fn run(args: &PlotArgs) -> Result<ExitCode, Failure> {
    let stored = &args.stored;
    let Some(name) = &args.figure else {
        let found = StoredResult::read(stored)?;
        figure_table::figures(&page_figures(found.content()), stored.logs.is_empty());
        return Ok(ExitCode::SUCCESS);
    };
    let format = format(args)?;
    if let Some(out) = &args.out {
        guard(args, format, out)?;
    }
    let found = StoredResult::read(stored)?;
    let figures = page_figures(found.content());
    let chosen = chosen(args, name, &figures)?;
    let out = args.out.clone().unwrap_or_else(|| {
        let run = chosen.run.as_ref().map_or_else(String::new, |run| format!("-{}", plain(run)));
        PathBuf::from(format!("{}{run}.{}", chosen.name, ending(format)))
    });
    guard(args, format, &out)?;
    let figure = chosen.figure.as_ref();
    let bytes = match format {
        PlotFormat::Svg => figure.to_svg()?.into_bytes(),
        PlotFormat::Png => figure.to_png(PNG_SCALE)?,
        PlotFormat::Pdf => figure.to_pdf()?,
    };
    let mut batch = Batch::new();
    batch.file(&out, &bytes)?;
    batch.commit()?;
    printer::line(&format!("written: {}", shell_word(&out.display().to_string())));
    Ok(ExitCode::SUCCESS)
}

/// The figure of this name, of the run that is asked for or the first.
fn chosen<'a>(
    args: &PlotArgs,
    name: &str,
    figures: &'a [NamedFigure],
) -> Result<&'a NamedFigure, Failure> {
    let file = || args.stored.result.clone();
    let named: Vec<&NamedFigure> = figures.iter().filter(|figure| figure.name == name).collect();
    let Some(first) = named.first() else {
        let known = figures.iter().map(|figure| figure.name.as_str());
        let of_logs = OF_LOGS.iter().any(|kind| *kind == name || is_of_channel(kind, name));
        let needs_logs = args.stored.logs.is_empty() && of_logs;
        let near = nearest(name, known);
        return Err(Failure::NoFigure { result: file(), name: name.to_owned(), near, needs_logs });
    };
    let Some(run) = &args.run else { return Ok(first) };
    let found = named.iter().find(|figure| figure.run.as_ref() == Some(run));
    found.copied().ok_or_else(|| {
        let near = nearest(run, named.iter().filter_map(|figure| figure.run.as_deref()));
        let figure = name.to_owned();
        Failure::NoRunOfFigure { result: file(), figure, run: run.clone(), near }
    })
}

/// Whether a kind of figures has one for each channel, and this is the name of one.
fn is_of_channel(kind: &str, name: &str) -> bool {
    kind.ends_with('-') && name.starts_with(kind)
}

/// The format that is asked for, or that of the ending.
fn format(args: &PlotArgs) -> Result<PlotFormat, Failure> {
    let known = [PlotFormat::Svg, PlotFormat::Png, PlotFormat::Pdf];
    let found = args.out.as_ref().and_then(|out| out.extension()).and_then(|found| {
        known.into_iter().find(|format| found.eq_ignore_ascii_case(ending(*format)))
    });
    match (args.format, found, &args.out) {
        (Some(format), Some(other), Some(out)) if format != other => {
            let words =
                format!("{}: has another ending than --format {}", out.display(), ending(format));
            Err(Failure::Asked(words, "leave out --format: the ending of --out gives it"))
        }
        (Some(format), ..) | (None, Some(format), _) => Ok(format),
        (None, None, Some(out)) => {
            let words = format!("{}: ends in none of .svg, .png and .pdf", out.display());
            Err(Failure::Asked(words, "give --format svg, png or pdf"))
        }
        (None, None, None) => Ok(PlotFormat::Svg),
    }
}

fn ending(format: PlotFormat) -> &'static str {
    match format {
        PlotFormat::Svg => "svg",
        PlotFormat::Png => "png",
        PlotFormat::Pdf => "pdf",
    }
}

/// Refuses to overwrite an input, and a file that is not an earlier figure.
fn guard(args: &PlotArgs, format: PlotFormat, out: &Path) -> Result<(), Failure> {
    let stored = &args.stored;
    let inputs = [&stored.result].into_iter().chain(&stored.logs).chain(&stored.like);
    let inputs: Vec<&Path> = inputs.map(AsRef::as_ref).collect();
    output_guard::guard_inputs(Some(out), &inputs)?;
    let first = match format {
        PlotFormat::Svg => b'<',
        PlotFormat::Png => 0x89,
        PlotFormat::Pdf => b'%',
    };
    output_guard::guard_first(out, first)
}

/// A name for a file: letters, digits, dots, hyphens and underscores.
fn plain(run: &str) -> String {
    let kept = |c: char| if c.is_alphanumeric() || "._-".contains(c) { c } else { '-' };
    run.chars().map(kept).collect()
}
