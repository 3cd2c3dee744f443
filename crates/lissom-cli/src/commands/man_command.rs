//! `lissom man DIR`.

use clap::CommandFactory as _;
use clap_mangen::Man;
use lissom_io::write::{self, Batch};

use crate::args::command_line::Cli;
use crate::args::man_args::ManArgs;
use crate::shared::exit_codes::ExitCode;
use crate::shared::failure::Failure;

pub(crate) fn run(args: &ManArgs) -> Result<ExitCode, Failure> {
    let mut command = Cli::command();
    command.build();
    write::create_folder(&args.folder)?;
    let mut batch = Batch::new();
    let subcommands = command.get_subcommands().filter(|s| s.get_name() != "help");
    for described in std::iter::once(&command).chain(subcommands) {
        let page = Man::new(described.clone());
        let path = args.folder.join(page.get_filename());
        let mut text = Vec::new();
        page.render(&mut text).map_err(|source| Failure::Page { path: path.clone(), source })?;
        batch.file(&path, &text)?;
    }
    batch.commit()?;
    Ok(ExitCode::SUCCESS)
}
