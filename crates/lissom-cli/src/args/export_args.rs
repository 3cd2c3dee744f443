//! Arguments of `lissom export`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

/// Writes an identified arm, or one of known dimensions, for another program. The file says what it cannot carry.
#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub(crate) struct ExportArgs {
    /// A result.json of `lissom identify`, or an arm.toml
    #[arg(value_name = "RESULT|ARM")]
    pub(crate) input: PathBuf,
    /// For which program
    #[arg(long, value_enum, value_name = "TARGET", hide_possible_values = true)]
    pub(crate) to: Target,
    /// File to write (for c: the folder)
    #[arg(long, value_name = "FILE")]
    pub(crate) out: PathBuf,
    /// Your model (MJCF or URDF): a copy of it with the numbers is written
    #[arg(long, value_name = "MODEL", requires = "joint")]
    pub(crate) into: Option<PathBuf>,
    /// Name of this joint
    #[arg(long, value_name = "NAME", requires = "into")]
    pub(crate) joint: Option<String>,
}

/// A program for which a model is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Target {
    Python,
    M,
    Mat,
    Mjcf,
    Urdf,
    C,
}

const HELP: &str = "\
Targets:
  python  a script for python-control: transfer function, state space, friction
  m       the same for MATLAB and Octave (package control)
  mat     a MATLAB file with models and responses
  mjcf    MuJoCo: armature, damping, frictionloss of a joint of --into, or a whole model.
          ARM: the beam is a chain of hinges with sites at its masses. RESULT: its modes
          are inertias on the axis, because a result has no dimensions
  urdf    damping and friction of a joint of --into
  c       header and source of a feed-forward of friction and inertia
Examples:
  lissom export result.json --to python --out arm.py
  lissom export result.json --to mjcf --into robot.xml --joint elbow --out robot-identified.xml
  lissom export result.json --to c --out feedforward";
