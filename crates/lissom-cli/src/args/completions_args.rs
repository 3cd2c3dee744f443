//! Arguments of `lissom completions`.

use clap::Args;
use clap_complete::Shell;

/// Prints a script with which a shell completes the subcommands and options of lissom.
#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub(crate) struct CompletionsArgs {
    /// bash, elvish, fish, powershell or zsh
    #[arg(hide_possible_values = true)]
    pub(crate) shell: Shell,
}

const HELP: &str = "\
Examples:
  lissom completions bash > ~/.local/share/bash-completion/completions/lissom
  lissom completions zsh > ~/.zfunc/_lissom       (a folder of your fpath)
  lissom completions fish > ~/.config/fish/completions/lissom.fish";
