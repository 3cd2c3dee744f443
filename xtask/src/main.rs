//! The project's recipes, for people and CI alike: `cargo xtask RECIPE`.
//!
//! A recipe is a function and a row of [`RECIPES`]; what it runs goes through [`step`], which
//! prints a title and a time.
#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a program for a terminal")]

mod book;
mod deny;
mod examples;
mod external;
mod fuzz;
mod lines;
mod measured;
mod python_environment;
mod release;
mod step;
mod web;
mod wheel;

use std::{
    env,
    path::{Path, PathBuf},
    process::ExitCode,
    time::Instant,
};

use step::{Failure, ask, cargo, run};

/// What `cargo xtask NAME` does.
struct Recipe {
    name: &'static str,
    about: &'static str,
    takes: Takes,
    run: fn(&Context) -> Result<(), Failure>,
}

/// The arguments of a recipe.
enum Takes {
    /// These flags, each with its description.
    Flags(&'static [(&'static str, &'static str)]),
    /// The arguments of the program that it runs, with a short description.
    Arguments(&'static str),
}

impl Takes {
    fn has(&self, flag: &str) -> bool {
        match self {
            Self::Flags(flags) => flags.iter().any(|(f, _)| *f == flag),
            Self::Arguments(_) => true,
        }
    }
}

/// Every recipe, in the order of the help.
const RECIPES: &[Recipe] = &[
    Recipe {
        name: "test",
        about: "run every test of the workspace, doctests and the Python package included",
        takes: Takes::Flags(&[]),
        run: test,
    },
    Recipe {
        name: "ci",
        about: "run fmt, clippy, rustdoc, cargo deny, book, examples, msrv, package, then `test`",
        takes: Takes::Flags(&[(SKIP_TESTS, "leave `test` out, for example if it has just run")]),
        run: ci,
    },
    Recipe {
        name: "book",
        about: "build docs/book from docs/src and check every link",
        takes: Takes::Flags(&[]),
        run: book,
    },
    Recipe {
        name: "examples",
        about: "run each example of the library",
        takes: Takes::Flags(&[]),
        run: examples,
    },
    Recipe {
        name: "msrv",
        about: "check the workspace with the oldest supported Rust",
        takes: Takes::Flags(&[]),
        run: msrv,
    },
    Recipe {
        name: "package",
        about: "package the crates as for publishing",
        takes: Takes::Flags(&[]),
        run: package,
    },
    Recipe {
        name: "wheel",
        about: "build the wheel of the Python package as it would be published, install it, test it there",
        takes: Takes::Flags(&[]),
        run: wheel,
    },
    Recipe {
        name: "web",
        about: "check the built scripts of report page and studio, and test them in Chromium; needs Node and Chromium",
        takes: Takes::Flags(&[]),
        run: web,
    },
    Recipe {
        name: "static",
        about: "build a static Linux binary in target/release-static; show its size, list its licences",
        takes: Takes::Flags(&[]),
        run: static_binary,
    },
    Recipe {
        name: "fuzz",
        about: "run each fuzz target of the readers of logs for a short time",
        takes: Takes::Arguments("inputs of each target; default 20000"),
        run: fuzz,
    },
    Recipe {
        name: "schemas",
        about: "write the schemas in docs/ from the Rust types of lissom's files",
        takes: Takes::Flags(&[]),
        run: schemas,
    },
    Recipe {
        name: "lines",
        about: "count the lines of code of each crate, without tests, comments and blank lines",
        takes: Takes::Flags(&[]),
        run: lines,
    },
    Recipe {
        name: "external",
        about: "compare the virtual rig and the identification with MuJoCo and scipy, in a Python environment under target; minutes",
        takes: Takes::Flags(&[]),
        run: external,
    },
    Recipe {
        name: "truth",
        about: "simulate random campaigns in Python and identify them, in the same environment; minutes",
        takes: Takes::Arguments("number of campaigns; default 100"),
        run: truth,
    },
    Recipe {
        name: "arms",
        about: "simulate flexible arms that are nobody's rig in Python and identify them, in the same environment; minutes",
        takes: Takes::Arguments(
            "number of arms (default 100), a seed (default 1), then `--quick` and the like of outside_arms.py",
        ),
        run: arms,
    },
    Recipe {
        name: "margins",
        about: "measure how near the comparisons come to their thresholds, in the same environment; half an hour",
        takes: Takes::Arguments("a seed (default 1), then campaign files"),
        run: margins,
    },
    Recipe {
        name: "study",
        about: "measure the accuracy over random arms and campaigns; minutes",
        takes: Takes::Arguments("see `cargo xtask study --help`"),
        run: study,
    },
];

const SKIP_TESTS: &str = "--skip-tests";

/// Where a recipe runs, and with which flags.
struct Context {
    /// The workspace's folder.
    root: PathBuf,
    /// The arguments given, each one that the recipe takes.
    flags: Vec<String>,
}

fn main() -> ExitCode {
    let mut args = env::args().skip(1);
    let name = args.next().unwrap_or_default();
    let flags: Vec<String> = args.collect();
    if matches!(name.as_str(), "help" | "-h" | "--help") {
        print!("{}", help());
        return ExitCode::SUCCESS;
    }
    let Some(recipe) = RECIPES.iter().find(|recipe| recipe.name == name) else {
        if !name.is_empty() {
            eprintln!("xtask: there is no recipe `{name}`");
        }
        eprint!("{}", help());
        return ExitCode::from(2);
    };
    if let Some(flag) = flags.iter().find(|flag| !recipe.takes.has(flag)) {
        eprintln!("xtask: `{name}` does not take `{flag}`");
        eprint!("{}", help());
        return ExitCode::from(2);
    }

    let start = Instant::now();
    let outcome = (recipe.run)(&Context { root: root(), flags });
    let time_s = start.elapsed().as_secs_f64();
    match outcome {
        Ok(()) => {
            println!("\nxtask {name}: done in {time_s:.1} s");
            ExitCode::SUCCESS
        }
        Err(failure) => {
            println!();
            eprintln!("xtask {name}: stopped after {time_s:.1} s: {failure}");
            ExitCode::FAILURE
        }
    }
}

/// Runs every test with plain `cargo test`, so that a new machine needs nothing else, and counts the
/// tests of measured logs among them.
fn test(context: &Context) -> Result<(), Failure> {
    let log = measured::Log::start(&context.root)?;
    let mut command = cargo(&context.root, &["test", "--workspace", "--no-fail-fast"]);
    // Compares the schemas in `docs/` with the types.
    command.args(["--features", "lissom-io/schema"]);
    log.pass_to(&mut command)?;
    let outcome = run("tests and doctests", &mut command);
    println!("{}", log.read()?);
    outcome?;
    // In a build of its own, so that the tests before see the default build.
    let formats = ["test", "--package", "lissom-formats", "--features", "full"];
    run("formats of the full build", &mut cargo(&context.root, &formats))?;
    wheel::test(&context.root, wheel::Build::Tested)
}

/// Builds and tests the Python package.
fn wheel(context: &Context) -> Result<(), Failure> {
    wheel::test(&context.root, wheel::Build::Published)
}

/// Checks the scripts, and tests them in a browser.
fn web(context: &Context) -> Result<(), Failure> {
    web::test(&context.root)
}

/// Writes the schemas in `docs/` from the types; a test fails if they differ.
fn schemas(context: &Context) -> Result<(), Failure> {
    let package = ["run", "--package", "lissom-io", "--features", "schema"];
    let mut command = cargo(&context.root, &package);
    run("schemas", command.args(["--example", "schemas"]))
}

/// Builds the book and checks its links.
fn book(context: &Context) -> Result<(), Failure> {
    book::build(&context.root)
}

/// Runs the library's examples.
fn examples(context: &Context) -> Result<(), Failure> {
    examples::run_all(&context.root)
}

/// Runs `cargo check` with the Rust of `rust-version` in Cargo.toml, which rustup installs if it is missing.
fn msrv(context: &Context) -> Result<(), Failure> {
    let version = env!("CARGO_PKG_RUST_VERSION");
    let install = ["toolchain", "install", version, "--profile", "minimal", "--no-self-update"];
    let (there, output) = ask(std::process::Command::new("rustup").args(install))?;
    if !there {
        println!("\n--- oldest Rust: NOT CHECKED: rustup cannot get Rust {version}");
        println!("    {}", output.lines().last().unwrap_or_default().trim());
        return Ok(());
    }
    let check = [
        "run",
        version,
        "cargo",
        "check",
        "--workspace",
        "--locked",
        "--target-dir",
        "target/msrv",
    ];
    let mut command = std::process::Command::new("rustup");
    run(
        "oldest Rust",
        command
            .args(check)
            .current_dir(&context.root)
            .env_remove("RUSTUP_TOOLCHAIN")
            .env_remove("CARGO"),
    )
}

/// Packages the crates.
fn package(context: &Context) -> Result<(), Failure> {
    release::package(&context.root)
}

/// Builds the static binary.
fn static_binary(context: &Context) -> Result<(), Failure> {
    release::static_binary(&context.root)
}

/// Counts lines of code.
fn lines(context: &Context) -> Result<(), Failure> {
    lines::print(&context.root)
}

/// Runs the fuzz targets.
fn fuzz(context: &Context) -> Result<(), Failure> {
    fuzz::short_run(&context.root, &context.flags)
}

/// All checks that a change must pass, the fast ones first.
fn ci(context: &Context) -> Result<(), Failure> {
    let root = &context.root;
    run("fmt", &mut cargo(root, &["fmt", "--all", "--check"]))?;
    let everything = ["--workspace", "--all-features"];
    let mut clippy = cargo(root, &["clippy", "--all-targets"]);
    run("clippy", clippy.args(everything).args(["--", "--deny", "warnings"]))?;
    let mut rustdoc = cargo(root, &["doc", "--no-deps"]);
    rustdoc.args(everything);
    run("rustdoc", rustdoc.env("RUSTDOCFLAGS", "--deny warnings"))?;
    deny::check(root)?;
    book(context)?;
    examples(context)?;
    msrv(context)?;
    package(context)?;
    if context.flags.iter().any(|flag| flag == SKIP_TESTS) { Ok(()) } else { test(context) }
}

/// Compares the virtual rig with MuJoCo and scipy.
fn external(context: &Context) -> Result<(), Failure> {
    external::compare(&context.root)
}

/// Runs the study with logs of an independent simulator instead of the virtual rig.
fn truth(context: &Context) -> Result<(), Failure> {
    external::truth(&context.root, context.flags.first().map_or("100", String::as_str))
}

/// Identifies flexible arms of an independent simulator.
fn arms(context: &Context) -> Result<(), Failure> {
    let given = |k: usize, default| context.flags.get(k).map_or(default, String::as_str);
    let further = context.flags.get(2..).unwrap_or_default();
    external::arms(&context.root, [given(0, "100"), given(1, "1")], further)
}

/// Measures how near the comparisons come to their thresholds.
fn margins(context: &Context) -> Result<(), Failure> {
    let (seed, campaigns) = match context.flags.as_slice() {
        [] => ("1", &[][..]),
        [seed, campaigns @ ..] => (seed.as_str(), campaigns),
    };
    external::margins(&context.root, seed, campaigns)
}

/// Runs the accuracy study.
fn study(context: &Context) -> Result<(), Failure> {
    let mut command = cargo(&context.root, &["run", "--release", "--package", "lissom-study"]);
    run("study", command.arg("--").args(&context.flags))
}

/// The workspace's folder, from the package's folder that cargo gives at run time.
fn root() -> PathBuf {
    let package = env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from);
    package.as_deref().and_then(Path::parent).map_or_else(|| PathBuf::from("."), Path::to_owned)
}

fn help() -> String {
    let mut lines = vec!["Usage: cargo xtask RECIPE".to_owned(), String::new()];
    for recipe in RECIPES {
        lines.push(format!("  {:<16} {}", recipe.name, recipe.about));
        match recipe.takes {
            Takes::Flags(flags) => {
                lines.extend(flags.iter().map(|(flag, about)| format!("    {flag:<14} {about}")));
            }
            Takes::Arguments(about) => lines.push(format!("    {:<14} {about}", "...")),
        }
    }
    lines.join("\n") + "\n"
}
