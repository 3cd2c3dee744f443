//! Files with several runs: each may be a log of its own, to be drawn, trimmed or left out alone.

use lissom_io::inspect::{InspectedChannel, Inspection};

use crate::app::App;
use crate::problem::Problem;
use crate::session::{LogEntry, Session};
use crate::setup::{Pick, Setup, Trim};

/// Most runs of a file that become logs: the page has a row for each.
const RUNS_MOST: usize = 200;

/// What the runs of a file are known by.
pub(crate) enum RunsBy<'a> {
    /// The values of a channel.
    Channel(&'a InspectedChannel),
    /// Groups of channels.
    Groups(&'a [String]),
}

impl RunsBy<'_> {
    pub(crate) fn name(&self) -> String {
        match self {
            Self::Channel(channel) => channel.label(),
            Self::Groups(_) => "groups of channels".to_owned(),
        }
    }
}

/// What the runs of a log are known by: the channel that the user names, or one that looks like it.
pub(crate) fn runs_by<'a>(
    setup: &Setup,
    log: &LogEntry,
    inspection: &'a Inspection,
) -> Option<RunsBy<'a>> {
    if log.run.is_some() {
        return None;
    }
    let named = Pick { column: setup.run.clone(), ..Pick::default() };
    let found = inspection.labels.as_ref().map(|labels| &inspection.channels[labels.channel]);
    match named.channel(inspection).or(found) {
        Some(channel) => Some(RunsBy::Channel(channel)),
        None if inspection.groups.is_empty() => None,
        None => Some(RunsBy::Groups(&inspection.groups)),
    }
}

/// Replaces a log by one for each of its runs.
pub(crate) fn take_apart(app: &App, revision: u64, id: u64) -> Result<(), Problem> {
    let session = app.known(revision)?;
    let log = session.log(id).ok_or_else(|| Problem::not_found("log"))?;
    let inspection = app.inspection(&session, log)?;
    let by = runs_by(&session.setup, log, &inspection).ok_or_else(|| {
        let hint = "choose the column with the run of each row under \"How logs are read\"";
        Problem::input(format!("{} has one run", log.name), Some(hint.to_owned()))
    })?;
    let runs = names(app, &session, log, &by)?;
    let first_id = app.amend(Session::new_log)?;
    // Channels have other names within a group.
    let guessed = match by {
        RunsBy::Channel(_) => None,
        RunsBy::Groups(_) => {
            let first = LogEntry { id: first_id, run: runs.first().cloned(), ..log.clone() };
            Some(Setup::guessed(&*app.inspection(&session, &first)?))
        }
    };
    app.change(revision, |session| {
        let at = position(session, id)?;
        let whole = session.logs.remove(at);
        let is_used = !session.setup.left_out.contains(&id);
        let is_alone = session.used_logs().next().is_none();
        let trim = session.setup.trims.iter().find(|trim| trim.log == id).cloned();
        for (k, run) in runs.into_iter().enumerate() {
            let id = if k == 0 { first_id } else { session.new_log() };
            session.logs.insert(at + k, LogEntry { id, run: Some(run), ..whole.clone() });
            if !is_used {
                session.setup.left_out.push(id);
            }
            session.setup.trims.extend(trim.clone().map(|trim| Trim { log: id, ..trim }));
        }
        session.setup.forget(|log| log != id);
        if let Some(guessed) = guessed.filter(|_| is_used && is_alone) {
            session.setup.pick_as(guessed);
        }
        Ok(())
    })?;
    app.cache.forget(id);
    Ok(())
}

/// The names of the runs of a log.
fn names(
    app: &App,
    session: &Session,
    log: &LogEntry,
    by: &RunsBy<'_>,
) -> Result<Vec<String>, Problem> {
    let names = match by {
        RunsBy::Groups(groups) => groups.to_vec(),
        RunsBy::Channel(channel) => {
            // A `=` ends the name of a column in an address.
            let name = channel.asked();
            let name = if name.contains('=') { channel.number.to_string() } else { name };
            let values = app.log(session, log)?.names(channel.number - 1).unwrap_or_default();
            values.into_iter().map(|value| format!("{name}={value}")).collect()
        }
    };
    if (2..=RUNS_MOST).contains(&names.len()) {
        return Ok(names);
    }
    let found = match names.len() {
        0 => "more values than runs have names".to_owned(),
        1 => "one value".to_owned(),
        more => format!("{more} values"),
    };
    let error = format!("{} of {} has {found}", by.name(), log.name);
    let hint = format!("choose a column with the number of the run, of 2 to {RUNS_MOST} runs");
    Err(Problem::input(error, Some(hint)))
}

/// Replaces all runs of a file by the file. What all of its runs have in common is kept.
pub(crate) fn put_together(app: &App, revision: u64, id: u64) -> Result<(), Problem> {
    let session = app.known(revision)?;
    let run = session.log(id).ok_or_else(|| Problem::not_found("log"))?;
    let whole = LogEntry { run: None, id: app.amend(Session::new_log)?, ..run.clone() };
    let is_of_groups = app
        .inspection(&session, &whole)?
        .groups
        .iter()
        .any(|group| Some(group) == run.run.as_ref());
    let gone = app.change(revision, |session| {
        let at = position(session, id)?;
        let (runs, others): (Vec<_>, Vec<_>) =
            session.logs.drain(..).partition(|log| log.shares_file(&whole));
        session.logs = others;
        let is_alone = session.used_logs().next().is_none();
        let gone: Vec<u64> = runs.iter().map(|log| log.id).collect();
        let setup = &mut session.setup;
        if gone.iter().all(|id| setup.left_out.contains(id)) {
            setup.left_out.push(whole.id);
        }
        let trim_of = |id: &u64| {
            let trim = setup.trims.iter().find(|trim| trim.log == *id)?;
            Some(Trim { log: whole.id, ..trim.clone() })
        };
        let trims: Vec<Option<Trim>> = gone.iter().map(trim_of).collect();
        if trims.windows(2).all(|pair| pair[0] == pair[1]) {
            setup.trims.extend(trims.into_iter().next().flatten());
        }
        setup.forget(|log| !gone.contains(&log));
        if is_of_groups && is_alone {
            setup.pick_as(Setup::default());
        }
        session.logs.insert(at.min(session.logs.len()), whole);
        Ok(gone)
    })?;
    for id in gone {
        app.cache.forget(id);
    }
    Ok(())
}

fn position(session: &Session, id: u64) -> Result<usize, Problem> {
    let at = session.logs.iter().position(|log| log.id == id);
    at.ok_or_else(|| Problem::not_found("log"))
}
