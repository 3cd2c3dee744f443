//! Logs that bring a worker process to its end, or hang; runs that stop and go on. The worker is a script of the shell that
//! does as the name of a log says.
#![cfg(unix)]
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::fs;
use std::num::NonZeroUsize;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use lissom_fleet::{
    ExistingRows, Failure, FleetError, FleetLog, FleetRun, FleetSettings, LogWorker, Progress,
    VERSION, Values, WorkerProgram, open, run_here,
};

const CAMPAIGN: &str = "signals.time = { column = 't', unit = 's' }
signals.current = { column = 'i', unit = 'A', hold = 'measured' }
signals.motor = { column = 'q', unit = 'rad' }";

/// Answers each log with a row; `kill` in its name ends the process, `hang` lets it wait, `once` ends it the first time.
const SCRIPT: &str = r#"
read settings
echo "{\"ready\":{\"version\":\"VERSION\"}}"
while read log; do
    name=$(echo "$log" | sed 's/.*"log":"\([^"]*\)".*/\1/')
    case "$name" in
        *kill*) echo "out of memory" >&2; kill -9 $$ ;;
        *hang*) exec sleep 1000 ;;
        *once*) if mkdir "FOLDER/once" 2>/dev/null; then kill -9 $$; fi ;;
    esac
    echo "{\"row\":{\"log\":\"$name\",\"machine\":null,\"time_us\":null,\"input_sha256\":null,\"seconds\":0.001,\
\"version\":\"VERSION\",\"outcome\":{\"identified\":{\"effort\":\"quick\",\
\"estimates\":[{\"key\":\"drive.inertia [kg·m²]\",\"value_std\":[2.0,0.1]}],\
\"refusals\":[],\"warnings\":[],\"infos\":[\"command-noise\"],\"json\":null}}}}"
done
"#;

fn worker(folder: &Path, version: &str) -> WorkerProgram {
    let script =
        SCRIPT.replace("VERSION", version).replace("FOLDER", &folder.display().to_string());
    WorkerProgram { program: "/bin/sh".into(), arguments: vec!["-c".into(), script.into()] }
}

fn settings() -> FleetSettings {
    FleetSettings { time_limit_s: 2.0, ..FleetSettings::new("campaign.toml", CAMPAIGN) }
}

fn logs<'a>(names: impl IntoIterator<Item = &'a str>) -> Vec<FleetLog> {
    names.into_iter().map(FleetLog::new).collect()
}

fn many(count: usize) -> Vec<FleetLog> {
    (0..count).map(|k| FleetLog::new(format!("log {k}"))).collect()
}

fn go(folder: &Path, program: &WorkerProgram, logs: Vec<FleetLog>) -> Result<Progress, FleetError> {
    let run = FleetRun::begin(&folder.join("out"), settings(), logs, &ExistingRows::Keep)?;
    run_here(run, NonZeroUsize::new(2).unwrap(), program, &AtomicBool::new(false), |_| ())
}

fn names(folder: &Path, column: &str) -> Vec<String> {
    match open(&folder.join("out")).unwrap().column(column).unwrap() {
        Some(Values::Text(texts)) => texts.into_iter().map(Option::unwrap_or_default).collect(),
        _ => Vec::new(),
    }
}

/// That each log has one row.
fn one_row_each(folder: &Path, logs: &[FleetLog]) {
    let mut found = names(folder, "log");
    found.sort();
    let mut wanted: Vec<String> = logs.iter().map(|log| log.log.clone()).collect();
    wanted.sort();
    assert_eq!(found, wanted);
}

#[test]
fn a_log_that_kills_or_hangs_is_a_row_and_the_others_go_on() {
    let folder = tempfile::tempdir().unwrap();
    let program = worker(folder.path(), VERSION);
    let logs = logs(["a", "kill", "b", "hang", "c", "once", "d"]);
    let mut work = LogWorker::new(settings(), program).unwrap();
    let stop = AtomicBool::new(false);
    let rows: Vec<_> = logs.iter().map(|log| work.row(log, &stop).unwrap()).collect();
    let failures: Vec<_> = rows.iter().filter_map(|row| Some((&row.log, row.failure()?))).collect();
    let [(first, (killed, message)), (second, (hung, _))] = failures[..] else {
        panic!("{failures:?}")
    };
    assert_eq!((first.as_str(), killed), ("kill", Failure::ProcessEnded));
    assert_eq!((second.as_str(), hung), ("hang", Failure::TimeLimit));
    assert!(message.contains("3 times") && message.contains("out of memory"), "{message}");
}

#[test]
fn rows_are_kept_and_not_doubled_when_a_run_stops() {
    let folder = tempfile::tempdir().unwrap();
    let program = worker(folder.path(), VERSION);
    let logs = many(300);
    let stop = AtomicBool::new(false);
    let run =
        FleetRun::begin(&folder.path().join("out"), settings(), logs.clone(), &ExistingRows::Keep)
            .unwrap();
    let two = NonZeroUsize::new(2).unwrap();
    let stopped = run_here(run, two, &program, &stop, |progress| {
        stop.store(progress.done > 20, Ordering::Relaxed);
    });
    assert!(matches!(stopped, Err(FleetError::Stopped)));
    let before = names(folder.path(), "log").len();
    assert!((20..300).contains(&before), "{before}");
    let progress = go(folder.path(), &program, logs.clone()).unwrap();
    assert_eq!((progress.before, progress.done), (before, 300 - before));
    one_row_each(folder.path(), &logs);
}

#[test]
fn rows_of_a_batch_that_is_not_complete_are_kept_when_a_run_stops() {
    let folder = tempfile::tempdir().unwrap();
    let program = worker(folder.path(), VERSION);
    let all = logs(["a", "b", "hang", "c", "d", "e", "f", "g", "h", "i"]);
    let stop = AtomicBool::new(false);
    let out = folder.path().join("out");
    let settings = FleetSettings { time_limit_s: 60.0, ..settings() };
    let run = FleetRun::begin(&out, settings, all, &ExistingRows::Keep).unwrap();
    let started = Instant::now();
    let stopped = run_here(run, NonZeroUsize::MIN, &program, &stop, |progress| {
        assert_eq!(progress.done, 0);
        stop.store(started.elapsed() > Duration::from_secs(2), Ordering::Relaxed);
    });
    assert!(matches!(stopped, Err(FleetError::Stopped)));
    assert_eq!(names(folder.path(), "log"), ["a", "b"]);
}

#[test]
fn a_killed_run_loses_at_most_what_the_manifest_does_not_list() {
    let folder = tempfile::tempdir().unwrap();
    let (out, logs) = (folder.path().join("out"), many(40));
    let mut run = FleetRun::begin(&out, settings(), logs.clone(), &ExistingRows::Keep).unwrap();
    let stop = AtomicBool::new(false);
    let mut work = LogWorker::new(settings(), worker(folder.path(), VERSION)).unwrap();
    let [first, second] = [(); 2].map(|()| {
        let batch = run.next_batch(1).unwrap();
        work.rows(&batch, &stop).unwrap()
    });
    run.take(&first).unwrap();
    run.take(&second).unwrap();
    assert!(matches!(run.take(&second), Err(FleetError::NoBatch { .. })), "rows are taken once");
    // As after a kill: a part is there that the manifest does not list yet, and a file that is not complete.
    assert!(out.join("part-000002.parquet").exists());
    assert!(open(&out).unwrap().rows() < first.rows.len() + second.rows.len());
    fs::write(out.join(".part-000003.parquet.1-1.part"), "PAR1").unwrap();
    drop(run);
    go(folder.path(), &worker(folder.path(), VERSION), logs.clone()).unwrap();
    one_row_each(folder.path(), &logs);
    let files = fs::read_dir(&out).unwrap().map(|e| e.unwrap().file_name());
    let parts = files.filter(|name| name.to_string_lossy().contains("part-")).count();
    assert_eq!(parts, open(&out).unwrap().manifest().parts.len());
}

#[test]
fn a_folder_that_cannot_be_written_stops_the_run_and_loses_no_row() {
    let folder = tempfile::tempdir().unwrap();
    let program = worker(folder.path(), VERSION);
    // More than are done before the progress is shown first.
    let (out, aside, logs) = (folder.path().join("out"), folder.path().join("aside"), many(1000));
    let run = FleetRun::begin(&out, settings(), logs.clone(), &ExistingRows::Keep).unwrap();
    let mut gone = false;
    let stopped = run_here(run, NonZeroUsize::MIN, &program, &AtomicBool::new(false), |progress| {
        if progress.done > 20 && !gone {
            fs::rename(&out, &aside).unwrap();
            gone = true;
        }
    });
    assert!(matches!(stopped, Err(FleetError::Write(_))), "{stopped:?}");
    fs::rename(&aside, &out).unwrap();
    go(folder.path(), &program, logs.clone()).unwrap();
    one_row_each(folder.path(), &logs);
}

#[test]
fn failed_rows_are_done_again_if_that_is_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let (out, program) = (folder.path().join("out"), worker(folder.path(), VERSION));
    let logs = logs(["a", "kill", "b", "hang", "c"]);
    let settings = || FleetSettings { time_limit_s: 1.0, retries: 0, ..settings() };
    let go = |existing: &ExistingRows| {
        let run = FleetRun::begin(&out, settings(), logs.clone(), existing).unwrap();
        run_here(run, NonZeroUsize::MIN, &program, &AtomicBool::new(false), |_| ()).unwrap()
    };
    go(&ExistingRows::Keep);
    one_row_each(folder.path(), &logs);
    assert_eq!(go(&ExistingRows::Keep).done, 0);
    let again = go(&ExistingRows::KeepBut(vec![Failure::TimeLimit, Failure::Missing]));
    assert_eq!((again.before, again.done, again.failed), (4, 1, 1));
    one_row_each(folder.path(), &logs);
    assert_eq!(open(&out).unwrap().manifest().parts.iter().map(|p| p.failed).sum::<usize>(), 2);
}

#[test]
fn workers_of_another_version_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let error = go(folder.path(), &worker(folder.path(), "0.0.9"), many(3)).unwrap_err();
    assert!(error.to_string().contains("has version 0.0.9 of lissom"), "{error}");
    let other = FleetSettings { version: "9.9.9".to_owned(), ..settings() };
    assert!(LogWorker::new(other, worker(folder.path(), VERSION)).is_err());
}

#[test]
fn a_folder_belongs_to_one_run_and_one_campaign() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let begin = |settings: FleetSettings, resume: bool| {
        let existing = if resume { ExistingRows::Keep } else { ExistingRows::Refuse };
        FleetRun::begin(&out, settings, many(2), &existing)
    };
    let run = begin(settings(), true).unwrap();
    assert!(matches!(begin(settings(), true), Err(FleetError::InUse { .. })));
    drop(run);
    let other = FleetSettings { campaign: "[signals]".to_owned(), ..settings() };
    let error = begin(other, true).unwrap_err().to_string();
    assert!(error.starts_with("campaign.toml, line 1: "), "{error}");
    let campaign = CAMPAIGN.replace("'q'", "'angle'");
    let error = begin(FleetSettings { campaign, ..settings() }, true).unwrap_err();
    assert!(error.to_string().ends_with("it has results with another campaign"), "{error}");
    assert!(matches!(begin(settings(), false), Err(FleetError::NotEmpty { .. })));
    let limit = FleetSettings { time_limit_s: 0.0, ..settings() };
    assert!(matches!(begin(limit, true), Err(FleetError::Setting { .. })));
    assert!(matches!(open(folder.path()), Err(FleetError::NoFleet { .. })));
    fs::write(out.join("manifest.json"), "{").unwrap();
    assert!(matches!(open(&out), Err(FleetError::Damaged { .. })));
}

#[test]
fn runs_of_folders_are_files_in_them() {
    let folder = tempfile::tempdir().unwrap();
    let begin = |runs: &str, by_folder: bool| {
        let campaign = format!("{CAMPAIGN}\n{runs}");
        let settings = FleetSettings { campaign, by_folder, ..settings() };
        FleetRun::begin(&folder.path().join("out"), settings, many(2), &ExistingRows::Keep)
    };
    for (runs, problem) in [
        ("", "campaign.toml has no `runs`"),
        ("runs = []", "`runs`"),
        ("runs = [{ file = '../a.csv' }]", "the file \"../a.csv\" is not in the folder of a log"),
        ("runs = [{ file = 'b/../a.csv' }]", "\"b/../a.csv\" is not in the folder"),
        ("runs = [{ file = '/logs/a.csv' }]", "\"/logs/a.csv\" is not in the folder"),
        ("runs = [{ file = '.' }]", "\".\" is not in the folder"),
    ] {
        let error = begin(runs, true).unwrap_err();
        assert!(error.to_string().contains(problem), "{error}");
        assert!(error.hint().is_some_and(|hint| hint.contains("file = ")), "{error}");
    }
    let runs = "runs = [{ file = './b/a.csv' }, { file = 'b/a.csv::1' }, { file = 'c.csv' }]";
    let run = begin(runs, true).unwrap();
    assert_eq!(run.settings().run_files().unwrap().unwrap(), ["b/a.csv", "c.csv"]);
    drop(run);
    let error = begin(runs, false).unwrap_err().to_string();
    assert!(error.ends_with("another choice of files or folders as logs"), "{error}");
}

#[test]
fn a_program_that_is_no_worker_is_an_error() {
    let folder = tempfile::tempdir().unwrap();
    let started = Instant::now();
    for (program, arguments) in [("/no/such/program", vec![]), ("/bin/sh", vec!["-c", "exit 3"])] {
        let arguments = arguments.into_iter().map(Into::into).collect();
        let program = WorkerProgram { program: program.into(), arguments };
        let error = go(folder.path(), &program, many(3)).unwrap_err();
        assert!(error.to_string().contains("cannot be started"), "{error}");
    }
    assert!(started.elapsed().as_secs() < 30);
}

#[test]
fn rows_take_machines_and_times_that_are_known_later() {
    let folder = tempfile::tempdir().unwrap();
    let program = worker(folder.path(), VERSION);
    go(folder.path(), &program, many(20)).unwrap();
    let mut known = many(20);
    for (k, log) in known.iter_mut().enumerate() {
        log.machine = (k != 3).then(|| format!("m{}", k % 2));
        log.time_us = Some(1_000_000);
    }
    let progress = go(folder.path(), &program, known).unwrap();
    assert_eq!((progress.before, progress.done), (20, 0));
    one_row_each(folder.path(), &many(20));
    let (logs, machines) = (names(folder.path(), "log"), names(folder.path(), "machine"));
    let at = |name: &str| machines[logs.iter().position(|log| log == name).unwrap()].as_str();
    assert_eq!((at("log 2"), at("log 3"), at("log 5")), ("m0", "", "m1"));
    // Logs about which nothing is known keep what was known.
    go(folder.path(), &program, many(20)).unwrap();
    assert_eq!(names(folder.path(), "machine"), machines);
}

#[test]
fn parts_that_are_not_as_they_were_written_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let program = worker(folder.path(), VERSION);
    go(folder.path(), &program, many(20)).unwrap();
    let out = folder.path().join("out");
    let part = out.join(&open(&out).unwrap().manifest().parts[0].file);
    let mut bytes = fs::read(&part).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    fs::write(&part, bytes).unwrap();
    assert!(matches!(open(&out), Err(FleetError::Damaged { .. })));
    assert!(matches!(go(folder.path(), &program, many(20)), Err(FleetError::Damaged { .. })));
    // Without its manifest a part says nothing, and is not overwritten.
    fs::remove_file(out.join("manifest.json")).unwrap();
    assert!(matches!(go(folder.path(), &program, many(20)), Err(FleetError::NoManifest { .. })));
    assert!(part.is_file());
}
