//! Exit codes of the command.

use std::process;

/// How a subcommand ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct ExitCode(u8);

impl ExitCode {
    /// Done.
    pub(crate) const SUCCESS: Self = Self(0);
    /// The input cannot be used.
    pub(crate) const FAILURE: Self = Self(1);
    /// Done, but a requested parameter could not be identified, or the torque of a log could not be predicted.
    pub(crate) const REFUSED: Self = Self(3);
    /// Stopped by Ctrl-C or a time limit; the output is the best result so far.
    pub(crate) const INTERRUPTED: Self = Self(4);
    /// A parameter is outside its limits.
    pub(crate) const OUTSIDE: Self = Self(5);
    /// Stopped by a second Ctrl-C, without a result.
    pub(crate) const KILLED: Self = Self(130);

    /// The number that the program returns.
    pub(crate) fn number(self) -> u8 {
        self.0
    }

    /// Ends the program with this code.
    pub(crate) fn exit(self) -> ! {
        process::exit(i32::from(self.0))
    }
}
