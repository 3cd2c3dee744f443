//! The program `lissom`.

use std::process::ExitCode;

fn main() -> ExitCode {
    // Without its path no worker process can be started, which the command then says.
    let own: Vec<_> = std::env::current_exe().into_iter().map(Into::into).collect();
    ExitCode::from(lissom_cli::run(std::env::args_os(), &own))
}
