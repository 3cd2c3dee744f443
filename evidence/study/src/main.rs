//! The program behind `cargo xtask study`.
#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a program for a terminal")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;
use indicatif::{ProgressBar, ProgressStyle};
use lissom_study::{
    DriveCampaign, DriveStudy, DriveStudyPlan, Kept, Law, Scored, Study, describe, describe_drive,
    draw_campaign, drive_report, drive_rows, drive_study, export, external_report, independent,
    report, rows, simulated, study, write_logs,
};

/// Measure the accuracy of identification over random arms and campaigns.
#[derive(Debug, Parser)]
struct Args {
    /// Number of campaigns of each law
    #[arg(long, default_value_t = 1000)]
    campaigns: usize,
    /// Seed of all random draws
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Folder for the tables (.md) and a row for each campaign (.csv)
    #[arg(long, default_value = "target/study")]
    out: PathBuf,
    /// Number of threads; 0: one for each core
    #[arg(long, default_value_t = 0)]
    jobs: usize,
    /// Law of the simulated friction: none (Coulomb), stribeck, direction, viscous-direction, ripple, sublinear, lugre,
    /// beam-damping; or wrong (each of them)
    #[arg(long, default_value = "none", value_parser = laws)]
    law: Laws,
    /// Only write the definitions of the campaigns to this folder, for another simulator
    #[arg(long, conflicts_with_all = ["only", "external"])]
    export: Option<PathBuf>,
    /// Identify the logs that another simulator wrote to this folder
    #[arg(long)]
    external: Option<PathBuf>,
    /// Drives instead of arms: with most effects of real logs at once, or with one of them at a time
    #[arg(long, conflicts_with_all = ["law", "export", "external", "resume"])]
    drives: Option<DriveStudy>,
    /// Only write the logs of the drives to this folder, each with campaign.toml and truth.json
    #[arg(long, requires = "drives")]
    logs: Option<PathBuf>,
    /// Continue a study that was stopped, with the campaigns that it has identified already
    #[arg(long, conflicts_with_all = ["only", "export", "external"])]
    resume: bool,
    /// Identify without the output-error method, as `lissom identify --quick`
    #[arg(long)]
    quick: bool,
    /// Identify only the campaign with this index and print all details
    #[arg(long)]
    only: Option<usize>,
}

/// An error, printed on the terminal.
type Failure = Box<dyn std::error::Error + Send + Sync>;

/// One law, or all of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Laws {
    One(Law),
    Wrong,
}

fn laws(text: &str) -> Result<Laws, String> {
    if text == "wrong" {
        return Ok(Laws::Wrong);
    }
    <Law as clap::ValueEnum>::from_str(text, false).map(Laws::One)
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

fn run(args: &Args) -> Result<(), Failure> {
    if let Some(study) = args.drives {
        return drives(args, study);
    }
    if let Some(index) = args.only {
        let law = match args.law {
            Laws::One(law) => law,
            Laws::Wrong => {
                return Err("--only needs one law: give --law a name other than wrong".into());
            }
        };
        let drawn = draw_campaign(args.seed, index, law)
            .ok_or("every draw of this campaign was rejected")?;
        let campaign = match &args.external {
            Some(folder) => simulated(drawn, folder)?,
            None => drawn,
        };
        print!("{}", describe(&campaign, args.seed, args.quick));
        return Ok(());
    }
    if let Some(folder) = &args.export {
        return export_all(args, folder);
    }
    let threads = rayon::ThreadPoolBuilder::new().num_threads(args.jobs).build()?;
    if let Some(folder) = &args.external {
        return threads.install(|| score_external(args, folder));
    }
    let name = if args.law == Laws::One(Law::None) { "accuracy" } else { "wrong-laws" };
    fs::create_dir_all(&args.out)?;
    let path = args.out.join(format!("{name}.cbor"));
    let kept = if args.resume { Kept::resume(&path)? } else { Kept::create(&path)? };
    let mut studies = Vec::new();
    for plan in plans(args) {
        let bar = bar(&plan);
        let known = |index| kept.known(&plan, index).inspect(|_| bar.inc(1));
        let done = |index, scored: Option<&Scored>| {
            bar.inc(1);
            kept.keep(&plan, index, scored)
        };
        let outcome = threads.install(|| study(&plan, known, done))?;
        bar.finish_and_clear();
        studies.push((plan, outcome));
    }
    written(args, name, &report(&studies), &rows(&studies))
}

/// The study of drives.
fn drives(args: &Args, study: DriveStudy) -> Result<(), Failure> {
    let plan =
        DriveStudyPlan { study, campaigns: args.campaigns, seed: args.seed, quick: args.quick };
    if let Some(folder) = &args.logs {
        let indices = args.only.map_or(0..plan.campaigns, |index| index..index + 1);
        let bar = bar_of(indices.len(), study.to_string());
        for index in indices {
            if let Some(campaign) = DriveCampaign::draw(study, plan.seed, index) {
                write_logs(&campaign, folder)?;
            }
            bar.inc(1);
        }
        bar.finish_and_clear();
        return Ok(());
    }
    if let Some(index) = args.only {
        let campaign = DriveCampaign::draw(study, plan.seed, index);
        let campaign = campaign.ok_or("every draw of this campaign was rejected")?;
        print!("{}", describe_drive(&campaign, args.quick));
        return Ok(());
    }
    let threads = rayon::ThreadPoolBuilder::new().num_threads(args.jobs).build()?;
    let bar = bar_of(plan.campaigns, study.to_string());
    let outcomes = threads.install(|| drive_study(&plan, || bar.inc(1)));
    bar.finish_and_clear();
    let name = format!("drives-{study}");
    written(args, &name, &drive_report(&plan, &outcomes), &drive_rows(&plan, &outcomes))
}

fn written(args: &Args, name: &str, text: &str, rows: &str) -> Result<(), Failure> {
    print!("{text}");
    fs::create_dir_all(&args.out)?;
    fs::write(args.out.join(format!("{name}.md")), text)?;
    fs::write(args.out.join(format!("{name}.csv")), rows)?;
    eprintln!("wrote {name}.md and {name}.csv to {}", args.out.display());
    Ok(())
}

/// The study of Coulomb friction, the only one for which there is another simulator.
fn external_plan(args: &Args) -> Result<Study, Failure> {
    if args.law != Laws::One(Law::None) {
        return Err("--export and --external need Coulomb friction: leave out --law".into());
    }
    Ok(Study { campaigns: args.campaigns, seed: args.seed, law: Law::None, quick: args.quick })
}

fn export_all(args: &Args, folder: &Path) -> Result<(), Failure> {
    let plan = external_plan(args)?;
    let bar = bar(&plan);
    for index in 0..plan.campaigns {
        if let Some(campaign) = draw_campaign(plan.seed, index, plan.law) {
            export(&campaign, plan.seed, folder)?;
        }
        bar.inc(1);
    }
    bar.finish_and_clear();
    Ok(())
}

fn score_external(args: &Args, folder: &Path) -> Result<(), Failure> {
    let plan = external_plan(args)?;
    let bar = bar(&plan);
    let found = independent(&plan, folder, || bar.inc(1))?;
    bar.finish_and_clear();
    let text = external_report(&plan, &found);
    written(args, "independent-truth", &text, &rows(&[(plan, found.outcome)]))
}

fn plans(args: &Args) -> Vec<Study> {
    let laws = match args.law {
        Laws::One(law) => vec![law],
        Laws::Wrong => std::iter::once(Law::None).chain(Law::wrong()).collect(),
    };
    let (campaigns, seed, quick) = (args.campaigns, args.seed, args.quick);
    laws.into_iter().map(|law| Study { campaigns, seed, law, quick }).collect()
}

fn bar(plan: &Study) -> ProgressBar {
    bar_of(plan.campaigns, plan.law.to_string())
}

fn bar_of(campaigns: usize, message: String) -> ProgressBar {
    let bar = ProgressBar::new(campaigns as u64);
    let template = "{msg:22} [{bar:36}] {pos}/{len} {elapsed}, {eta} left";
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style.progress_chars("=> "));
    }
    bar.set_message(message);
    bar
}
