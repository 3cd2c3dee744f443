//! `lissom check LOG --limits FILE`.

use std::collections::BTreeMap;
use std::path::Path;

use lissom::DescribedLogs;
use lissom::identify::Effort;
use lissom_io::limits::{CheckFile, Limit, LimitsFile, Outcome};
use lissom_io::write::{self, Batch};
use lissom_io::{CampaignFile, ParameterList, ResultFile, read_campaign_like};

use crate::args::check_args::CheckArgs;
use crate::args::stdout_name::STDOUT;
use crate::shared::exit_codes::ExitCode;
use crate::shared::failure::Failure;
use crate::shared::output_guard;
use crate::tasks::identification::{Asked, identified};
use crate::views::{check_table, printer};

pub(crate) fn run(args: &CheckArgs) -> Result<ExitCode, Failure> {
    let json = args.json.as_deref();
    let json_file = json.filter(|path| *path != Path::new(STDOUT));
    output_guard::guard(json_file, None)?;
    let limits = LimitsFile::read(&args.limits)?;
    let name = args.log.display().to_string();
    let path = match &limits.path {
        None => BTreeMap::new(),
        Some(pattern) => pattern.read(&name).ok_or_else(|| {
            Failure::Asked(
                format!(
                    "{name}: the path does not have the form that {} states",
                    args.limits.display()
                ),
                "give the log with its folders, or correct `path` in the limits",
            )
        })?,
    };
    let file = campaign(args)?;
    let effort = if args.quick { Effort::Quick } else { Effort::default() };
    let id = identified(&args.log, &file, Asked { effort, ..Asked::default() })?;
    let result = ResultFile::of(&file.campaign.channels, &id, None);
    let parameters = ParameterList::of(&result).parameters;
    let unknown = limits.limits.iter().find(|l| !parameters.iter().any(|p| p.key == l.parameter));
    if let Some(limit) = unknown {
        let keys: Vec<&str> = parameters.iter().map(|p| p.key.as_str()).collect();
        return Err(Failure::Asked(
            format!(
                "{}: the result has no parameter \"{}\"; it has {}",
                args.limits.display(),
                limit.parameter,
                keys.join(", ")
            ),
            "name one of these",
        ));
    }
    let same = |l: &Limit| parameters.iter().find(|p| p.key == l.parameter && p.unit != l.unit);
    if let Some((limit, given)) = limits.limits.iter().find_map(|l| Some((l, same(l)?))) {
        return Err(Failure::Asked(
            format!(
                "{}: the limits of {} are in {}, the result is in {}",
                args.limits.display(),
                limit.parameter,
                limit.unit,
                given.unit
            ),
            "give the limits in the unit of the result: without a torque constant friction is in the unit of the command",
        ));
    }
    let check = CheckFile::of(name, path, &parameters, &limits.limits);
    if let Some(path) = json_file {
        let mut batch = Batch::new();
        batch.file(path, write::json_text(path, &check)?.as_bytes())?;
        batch.commit()?;
    }
    if json.is_some() && json_file.is_none() {
        printer::json(&check)?;
    } else {
        check_table::print(&check);
    }
    Ok(match check.outcome {
        Outcome::Pass => ExitCode::SUCCESS,
        Outcome::Undecided => ExitCode::REFUSED,
        Outcome::Fail => ExitCode::OUTSIDE,
    })
}

/// The log, described by another campaign or by options.
fn campaign(args: &CheckArgs) -> Result<CampaignFile, Failure> {
    let Some(like) = &args.like else {
        let logs = std::slice::from_ref(&args.log);
        return Ok(DescribedLogs::new(logs, &args.said.description())?.read()?);
    };
    if !args.said.is_empty() {
        return Err(Failure::Asked(
            "--like describes the log: no option about columns or drive may be given".to_owned(),
            "leave out --like, or the other options",
        ));
    }
    Ok(read_campaign_like(like, &args.log)?)
}
