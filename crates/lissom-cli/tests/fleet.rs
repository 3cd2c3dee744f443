//! `lissom fleet` on simulated logs: rows, summary, stops and what is wrong with logs.
#![cfg(feature = "fleet")]
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use lissom_fleet::{Values, open};

const ARM: &str = r#"
[beam]
rigid = true
[drive]
inertia = "0.002 kg*m^2"
viscous = "0.005 N*m*s/rad"
torque_constant = "0.2 N*m/A"
coulomb = "0.02 N*m"
[rig]
sample_time = "2 ms"
current_limit = "5 A"
motor_sensor = { counts_per_turn = 16384 }
controller = { proportional = "4 A/rad", derivative = "0.15 A*s/rad" }
"#;
const CAMPAIGN: &str = r#"
[signals]
time = { column = "t", unit = "s" }
current = { column = "i", unit = "A", hold = "sampled" }
motor = { column = "theta_m", unit = "rad" }
[drive]
torque_constant = "0.2 N*m/A"
"#;
const MACHINES: usize = 3;
const LOGS: usize = 8;

fn lissom(folder: &Path) -> Command {
    let mut command = Command::new(assert_cmd::cargo::cargo_bin!("lissom"));
    command.current_dir(folder);
    command
}

fn output(command: &mut Command) -> Output {
    command.output().unwrap()
}

fn said(output: &Output) -> String {
    format!(
        "{}{}",
        String::from_utf8_lossy(&output.stdout),
        String::from_utf8_lossy(&output.stderr)
    )
}

/// A folder with logs `logs/MACHINE_DAY.csv` and `campaign.toml`.
fn fleet() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("arm.toml"), ARM).unwrap();
    let days =
        (0..MACHINES).flat_map(|m| (0..LOGS).map(move |k| format!("m{m}_2026-0{}-01", k + 1)));
    let runs: Vec<String> = days
        .map(|name| {
            let sine = r#"sine = { frequency = "1 Hz", amplitude = "0.6 rad" }, record = "4 s""#;
            format!("{{ name = \"{name}\", {sine} }}")
        })
        .collect();
    fs::write(folder.path().join("plan.toml"), format!("runs = [{}]", runs.join(", "))).unwrap();
    let made = output(lissom(folder.path()).args([
        "rig",
        "arm.toml",
        "--campaign",
        "plan.toml",
        "--out",
        "logs",
    ]));
    assert!(made.status.success(), "{}", said(&made));
    fs::write(folder.path().join("campaign.toml"), CAMPAIGN).unwrap();
    folder
}

fn command(folder: &Path) -> Command {
    let mut command = lissom(folder);
    command.args(["fleet", "logs", "--like", "campaign.toml", "--out", "out", "--workers", "2"]);
    command.args(["--pattern", "{machine}_{time}.csv"]);
    command
}

fn names(folder: &Path) -> Vec<String> {
    match open(&folder.join("out")).unwrap().column("log").unwrap() {
        Some(Values::Text(names)) => names.into_iter().flatten().collect(),
        _ => Vec::new(),
    }
}

fn one_row_each(folder: &Path) {
    let mut found = names(folder);
    found.sort();
    found.dedup();
    assert_eq!((found.len(), open(&folder.join("out")).unwrap().rows()), (24, 24));
}

#[test]
fn rows_summary_page_and_table() {
    let folder = fleet();
    let folder = folder.path();
    let done = output(&mut command(folder));
    assert!(done.status.success(), "{}", said(&done));
    // The campaign.toml of the simulated logs, and others.
    assert!(
        said(&done).contains("files that do not end like the pattern, left out: "),
        "{}",
        said(&done)
    );
    assert!(said(&done).contains("24 rows: 24 identified, 0 failed"), "{}", said(&done));
    one_row_each(folder);
    let shown = output(lissom(folder).args(["fleet", "summary", "out", "--report", "page.html"]));
    assert!(shown.status.success());
    assert!(
        said(&shown)
            .starts_with("24 of 24 logs identified, of 3 machines, from 2026-01-01 to 2026-08-01.")
    );
    let page = fs::read_to_string(folder.join("page.html")).unwrap();
    assert!(page.contains("friction.coulomb") && page.contains("script-src 'sha256-"));
    let json = output(lissom(folder).args(["fleet", "summary", "out", "--json"]));
    let summary: lissom_fleet::FleetSummary = serde_json::from_slice(&json.stdout).unwrap();
    let coulomb = summary.parameters.iter().find(|p| p.key == "friction.coulomb [N·m]").unwrap();
    assert!((coulomb.distribution.median / 0.02 - 1.0).abs() < 0.02);
    let table = output(lissom(folder).args(["fleet", "table", "out", "--out", "rows.csv"]));
    assert!(table.status.success());
    assert_eq!(fs::read_to_string(folder.join("rows.csv")).unwrap().lines().count(), 25);
    let table = output(lissom(folder).args(["fleet", "table", "out", "--out", "rows.parquet"]));
    assert!(table.status.success(), "{}", said(&table));
    assert_eq!(&fs::read(folder.join("rows.parquet")).unwrap()[..4], b"PAR1");
    // Neither a part nor a log is overwritten.
    for other in ["out/part-000001.parquet", "logs/m0_2026-01-01.csv", "campaign.toml"] {
        let before = fs::read(folder.join(other)).unwrap();
        let refused = output(lissom(folder).args(["fleet", "table", "out", "--out", other]));
        assert_eq!(refused.status.code(), Some(1), "{other}: {}", said(&refused));
        assert_eq!(fs::read(folder.join(other)).unwrap(), before);
    }
    // The same command again has nothing to do; other settings belong into another folder.
    assert!(said(&output(&mut command(folder))).contains("24 logs had rows before"));
    let other = output(command(folder).args(["--effort", "normal"]));
    assert_eq!(other.status.code(), Some(1));
    assert!(said(&other).contains("it has results with another effort"), "{}", said(&other));
    assert_eq!(output(command(folder).arg("--new")).status.code(), Some(1));
}

#[test]
fn logs_that_cannot_be_used_are_rows() {
    let folder = fleet();
    let folder = folder.path();
    fs::write(folder.join("logs/m0_2026-09-01.csv"), "t,i,theta_m\n0,x,1\n").unwrap();
    fs::write(folder.join("logs/m0_2026-09-02.csv"), "").unwrap();
    fs::write(folder.join("logs/m0_2026-09-03.csv"), [0u8, 159, 146, 150].repeat(100)).unwrap();
    let done = output(command(folder).arg("--results"));
    assert!(done.status.success(), "{}", said(&done));
    assert!(said(&done).contains("27 rows: 24 identified, 3 failed\n  3 input"), "{}", said(&done));
    let shown = output(lissom(folder).args(["fleet", "summary", "out"]));
    assert!(said(&shown).contains("m0_2026-09-0"), "{}", said(&shown));
    // One of them is mended, and done again.
    fs::copy(folder.join("logs/m0_2026-08-01.csv"), folder.join("logs/m0_2026-09-02.csv")).unwrap();
    let again = output(command(folder).args(["--results", "--again", "input"]));
    assert!(
        said(&again).contains("27 rows: 25 identified, 2 failed\n  2 input"),
        "{}",
        said(&again)
    );
}

#[test]
fn tables_of_logs_and_wrong_input() {
    let folder = fleet();
    let folder = folder.path();
    let table =
        "log,machine,time\nlogs/m0_2026-01-01.csv,a,2026-03-01T08:00:00Z\nlogs/none.csv,b,\n";
    fs::write(folder.join("logs.csv"), table).unwrap();
    let like = ["--like", "campaign.toml", "--out", "of-table"];
    let done = output(lissom(folder).args(["fleet", "--table", "logs.csv"]).args(like));
    assert!(said(&done).contains("2 rows: 1 identified, 1 failed\n  1 missing"), "{}", said(&done));
    for (arguments, problem) in [
        (vec!["fleet", "logs"], "--like and --out are missing"),
        (vec!["fleet", "none", "--like", "campaign.toml", "--out", "x"], "none: cannot be read"),
        (vec!["fleet", "logs", "--like", "none.toml", "--out", "x"], "none.toml: cannot be read"),
        (
            vec!["fleet", "logs", "--like", "campaign.toml", "--out", "x", "--pattern", "{"],
            "pattern \"{\"",
        ),
        (
            vec!["fleet", "--table", "plan.toml", "--like", "campaign.toml", "--out", "x"],
            "there is no column \"log\"",
        ),
        (
            vec![
                "fleet",
                "logs",
                "--like",
                "campaign.toml",
                "--out",
                "x",
                "--refine-on",
                "few-perids",
            ],
            "no finding has the code \"few-perids\"",
        ),
        (vec!["fleet", "summary", "logs"], "there is no manifest.json in it"),
        (vec!["fleet", "table", "of-table", "--out", "no/such/folder.csv"], "cannot be written"),
    ] {
        let failed = output(lissom(folder).args(&arguments));
        assert_eq!(failed.status.code(), Some(1), "{arguments:?}: {}", said(&failed));
        assert!(said(&failed).contains(problem), "{arguments:?}: {}", said(&failed));
        assert!(said(&failed).contains("hint: "), "{arguments:?}");
    }
}

#[test]
fn folders_are_logs() {
    const DAYS: [&str; 3] = ["m0/2026-01-01", "m0/2026-02-01", "m1/2026-01-01"];
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let campaign = format!(
        "{CAMPAIGN}[[runs]]\nfile = \"slow.csv\"\n[[runs]]\nfile = \"fast.csv\"\nskip = \"0.5 s\"\n"
    );
    fs::write(folder.join("campaign.toml"), &campaign).unwrap();
    fs::write(folder.join("arm.toml"), ARM).unwrap();
    for (seed, day) in DAYS.iter().enumerate() {
        let sine = |name, f| {
            format!(
                "{{ name = \"{name}\", sine = {{ frequency = \"{f} Hz\", amplitude = \"0.4 rad\" }}, periods = 6 }}"
            )
        };
        let plan = format!("seed = {seed}\nruns = [{}, {}]", sine("slow", 0.5), sine("fast", 1.5));
        fs::write(folder.join("plan.toml"), plan).unwrap();
        let out = format!("logs/{day}");
        let made = ["rig", "arm.toml", "--campaign", "plan.toml", "--out", &out];
        assert!(output(lissom(folder).args(made)).status.success());
        fs::write(folder.join(&out).join("campaign.toml"), &campaign).unwrap();
    }
    fs::remove_file(folder.join("logs/m1/2026-01-01/fast.csv")).unwrap();
    fs::create_dir(folder.join("logs/notes")).unwrap();
    fs::write(folder.join("logs/notes/note.csv"), "").unwrap();
    let like = ["--like", "campaign.toml", "--by-folder", "--results", "--refine", "none"];
    let pattern = ["--pattern", "{machine}/{time}"];
    let done =
        output(lissom(folder).args(["fleet", "logs", "--out", "out"]).args(like).args(pattern));
    let said_done = said(&done);
    assert!(said_done.contains("3 rows: 2 identified, 1 failed\n  1 missing"), "{said_done}");
    let table = open(&folder.join("out")).unwrap();
    let texts = |column: &str| match table.column(column).unwrap() {
        Some(Values::Text(texts)) => texts.into_iter().map(Option::unwrap_or_default).collect(),
        _ => Vec::new(),
    };
    let (logs, machines) = (texts("log"), texts("machine"));
    let (messages, results, hashes) = (texts("message"), texts("result"), texts("input_sha256"));
    for (row, log) in logs.iter().enumerate() {
        let day = DAYS.iter().find(|day| log.ends_with(*day)).unwrap();
        assert_eq!(machines[row], day[..2]);
        if day.starts_with("m1") {
            assert!(
                messages[row].contains("2026-01-01/fast.csv: cannot be opened"),
                "{messages:?}"
            );
            continue;
        }
        let alone = Path::new(log).join("campaign.toml");
        let alone =
            output(lissom(folder).args(["identify", "--effort", "quick"]).arg(alone).arg("--json"));
        let parameters = |json: &[u8]| {
            let value: serde_json::Value = serde_json::from_slice(json).unwrap();
            value["verdict"].clone()
        };
        assert_eq!(parameters(results[row].as_bytes()), parameters(&alone.stdout));
        assert_eq!(hashes[row].len(), 64);
    }
    // Rows are in the order in which they were done.
    let hash_of = |day: &str| &hashes[logs.iter().position(|log| log.ends_with(day)).unwrap()];
    assert!(hash_of(DAYS[0]) != hash_of(DAYS[2]), "a file is missing: {hashes:?}");
    // Folders of a table; one without any file is a row.
    fs::write(folder.join("logs.csv"), "log\nlogs/m0/2026-01-01\nlogs/notes\n").unwrap();
    let done =
        output(lissom(folder).args(["fleet", "--table", "logs.csv", "--out", "table"]).args(like));
    assert!(said(&done).contains("2 rows: 1 identified, 1 failed\n  1 missing"), "{}", said(&done));
    fs::write(folder.join("no-runs.toml"), CAMPAIGN).unwrap();
    fs::write(folder.join("up.toml"), campaign.replace("slow", "../slow")).unwrap();
    for (arguments, problem) in [
        (
            ["logs/notes", "campaign.toml", "x"],
            "logs/notes: no folder has files of the runs: slow.csv, fast.csv",
        ),
        (["logs", "no-runs.toml", "x"], "no-runs.toml has no `runs`"),
        (
            ["logs", "up.toml", "x"],
            "up.toml: the file \"../slow.csv\" is not in the folder of a log",
        ),
        (["plan.toml", "campaign.toml", "x"], "plan.toml: cannot be read"),
        (
            ["logs", "campaign.toml", "./logs"],
            "logs: the rows cannot be written into a folder with logs",
        ),
    ] {
        let [logs, like, out] = arguments;
        let arguments = ["fleet", logs, "--like", like, "--out", out, "--by-folder"];
        let failed = output(lissom(folder).args(arguments));
        assert_eq!(failed.status.code(), Some(1), "{arguments:?}: {}", said(&failed));
        assert!(said(&failed).contains(problem), "{arguments:?}: {}", said(&failed));
        assert!(said(&failed).contains("hint: "), "{arguments:?}");
        assert!(!folder.join("x").exists());
    }
}

/// Starts the command, waits until it has rows, and does something to it.
#[cfg(unix)]
fn interrupted(folder: &Path, signal: &str) -> Child {
    let mut child = command(folder).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let started = Instant::now();
    let rows = || open(&folder.join("out")).map_or(0, |table| table.rows());
    while rows() == 0
        && started.elapsed() < Duration::from_secs(120)
        && child.try_wait().unwrap().is_none()
    {
        thread::sleep(Duration::from_millis(2));
    }
    let id = child.id().to_string();
    assert!(Command::new("kill").args([signal, &id]).status().unwrap().success());
    child
}

#[test]
#[cfg(unix)]
fn a_stopped_or_killed_run_goes_on() {
    for signal in ["-INT", "-KILL"] {
        let folder = fleet();
        let folder = folder.path();
        let stopped = interrupted(folder, signal).wait_with_output().unwrap();
        if signal == "-INT" {
            // It may have come to its end before.
            assert!([Some(4), Some(0)].contains(&stopped.status.code()), "{}", said(&stopped));
        }
        let done = output(&mut command(folder));
        assert!(done.status.success(), "{}", said(&done));
        one_row_each(folder);
    }
}

#[test]
#[cfg(unix)]
fn a_full_disk_ends_the_run_and_loses_no_row() {
    let folder = fleet();
    let folder = folder.path();
    // A limit of the size of files has the manifest fit, and not the parts: a write fails as on a full disk.
    let script = "ulimit -f 6; trap '' XFSZ; exec \"$@\"";
    let limited = command(folder);
    let mut limit = Command::new("sh");
    limit.current_dir(folder).args(["-c", script, "sh"]).arg(limited.get_program());
    let full = output(limit.args(limited.get_args()));
    assert_eq!(full.status.code(), Some(1), "{}", said(&full));
    assert!(said(&full).contains("part-000001.parquet: cannot be written"), "{}", said(&full));
    assert_eq!(open(&folder.join("out")).unwrap().rows(), 0);
    let done = output(&mut command(folder));
    assert!(done.status.success(), "{}", said(&done));
    one_row_each(folder);
}

#[test]
fn a_damaged_part_is_done_again_if_it_is_deleted() {
    let folder = fleet();
    let folder = folder.path();
    assert!(output(&mut command(folder)).status.success());
    let part = folder.join("out/part-000001.parquet");
    fs::write(&part, "PAR1").unwrap();
    let mut summary = lissom(folder);
    summary.args(["fleet", "summary", "out"]);
    for mut broken in [command(folder), summary] {
        let broken = output(&mut broken);
        assert_eq!(broken.status.code(), Some(1), "{}", said(&broken));
        assert!(said(&broken).contains("hint: delete this file"), "{}", said(&broken));
    }
    fs::remove_file(&part).unwrap();
    assert!(output(&mut command(folder)).status.success());
    one_row_each(folder);
}
