//! `cargo xtask study`: the accuracy study from the command line.
#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a program for a terminal")]

use std::path::PathBuf;
use std::process::ExitCode;
use std::{fs, io};

use clap::Parser;
use indicatif::{ProgressBar, ProgressStyle};
use lissom_study::{Law, Study, describe, report, rows, study};

/// Accuracy of identification over random arms and campaigns.
#[derive(Debug, Parser)]
struct Args {
    /// Campaigns of true Coulomb friction, or of the law asked for.
    #[arg(long, default_value_t = 1000)]
    campaigns: usize,
    /// Seed of all draws.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Folder for `accuracy.md` and `campaigns.csv`.
    #[arg(long, default_value = "target/study")]
    out: PathBuf,
    /// Threads; all cores when 0.
    #[arg(long, default_value_t = 0)]
    jobs: usize,
    /// The truth, or `all`: true Coulomb friction, and a tenth as many campaigns of each wrong law.
    #[arg(long, default_value = "none", value_parser = laws)]
    law: Laws,
    /// Run this campaign alone and print everything about it.
    #[arg(long)]
    only: Option<usize>,
}

/// One law or all of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Laws {
    One(Law),
    All,
}

fn laws(text: &str) -> Result<Laws, String> {
    if text == "all" {
        return Ok(Laws::All);
    }
    let law = <Law as clap::ValueEnum>::from_str(text, false)?;
    if law == Law::Lugre && !cfg!(feature = "lugre") {
        return Err("needs a build with `--features lugre`".to_owned());
    }
    Ok(Laws::One(law))
}

fn main() -> ExitCode {
    let args = Args::parse();
    match run(&args) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("lissom-study: {failure}");
            ExitCode::FAILURE
        }
    }
}

fn run(args: &Args) -> Result<(), Box<dyn std::error::Error>> {
    if let Some(index) = args.only {
        let law = match args.law {
            Laws::One(law) => law,
            Laws::All => return Err("--only needs one law".into()),
        };
        let text = describe(args.seed, index, law).ok_or("every draw was rejected")?;
        print!("{text}");
        return Ok(());
    }
    let threads = rayon::ThreadPoolBuilder::new().num_threads(args.jobs).build()?;
    let mut studies = Vec::new();
    for plan in plans(args) {
        let bar = bar(&plan);
        let outcome = threads.install(|| study(&plan, || bar.inc(1)));
        bar.finish_and_clear();
        studies.push((plan, outcome));
    }
    let (text, table) = (report(&studies), rows(&studies));
    print!("{text}");
    written(args, &text, &table)?;
    Ok(())
}

fn plans(args: &Args) -> Vec<Study> {
    let one = |campaigns: usize, law: Law| Study { campaigns, seed: args.seed, law };
    match args.law {
        Laws::One(law) => vec![one(args.campaigns, law)],
        Laws::All => {
            let tenth = args.campaigns.div_ceil(10);
            let wrong = Law::wrong().into_iter().map(|law| one(tenth, law));
            std::iter::once(one(args.campaigns, Law::None)).chain(wrong).collect()
        }
    }
}

fn bar(plan: &Study) -> ProgressBar {
    let bar = ProgressBar::new(plan.campaigns as u64);
    let template = "{msg:22} [{bar:36}] {pos}/{len} {elapsed}, {eta} left";
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style.progress_chars("=> "));
    }
    bar.set_message(plan.law.to_string());
    bar
}

fn written(args: &Args, text: &str, table: &str) -> io::Result<()> {
    fs::create_dir_all(&args.out)?;
    fs::write(args.out.join("accuracy.md"), text)?;
    fs::write(args.out.join("campaigns.csv"), table)?;
    eprintln!("accuracy.md and campaigns.csv are in {}", args.out.display());
    Ok(())
}
