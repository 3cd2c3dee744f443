//! `lissom studio [LOG...]`.

use lissom_studio::{Studio, StudioOptions};

use crate::args::studio_args::StudioArgs;
use crate::shared::exit_codes::ExitCode;
use crate::shared::failure::Failure;
use crate::views::printer;

pub(crate) fn run(args: &StudioArgs) -> Result<ExitCode, Failure> {
    let mut options = StudioOptions::default();
    options.logs.clone_from(&args.logs);
    options.folder.clone_from(&args.folder);
    options.port = args.port;
    let studio = Studio::open(&options)?;
    let opened = !args.no_browser && studio.open_browser().is_ok();
    if opened {
        let file = studio.opener().display();
        printer::line(&format!("lissom studio is in your browser; if it is not, open {file}"));
    } else {
        let file = studio.opener().display();
        printer::line(&format!("lissom studio: open {}", studio.address()));
        printer::line(&format!("it works once; for one more page open {file}"));
    }
    printer::line("Ctrl-C ends it; the state is kept");
    studio.run()?;
    Ok(ExitCode::SUCCESS)
}
