//! Files with several runs: each can be a log of its own.
#![expect(clippy::unwrap_used, reason = "tests")]

mod client;

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use client::{Client, options};
use lissom::identify::Effort;
use lissom::prelude::*;
use serde_json::{Value, json};
use tempfile::tempdir;

/// The sample as one table with a column of runs.
fn table(folder: &Path) -> String {
    let sample = Client::new(&options(&folder.join("sample")));
    let revision = json!({ "revision": sample.state()["revision"] }).to_string();
    assert_eq!(sample.send("POST", "/api/sample", revision.as_bytes()).status, 200);
    let mut text = String::new();
    for run in 1..=4 {
        let log = folder.join(format!("sample/logs/sample-{run}.csv"));
        let log = fs::read_to_string(log).unwrap();
        let mut lines = log.lines().filter(|line| !line.starts_with('#'));
        let names = lines.next().unwrap();
        if run == 1 {
            writeln!(text, "trial,{names}").unwrap();
        }
        lines.for_each(|line| writeln!(text, "{run},{line}").unwrap());
    }
    text
}

fn names(state: &Value) -> Vec<&str> {
    state["logs"].as_array().unwrap().iter().map(|log| log["name"].as_str().unwrap()).collect()
}

/// Takes the runs of a log apart, or puts them together.
fn put_runs(client: &Client, id: u64, apart: bool) -> Value {
    let body = json!({ "revision": client.state()["revision"], "apart": apart }).to_string();
    let answer = client.send("PUT", &format!("/api/logs/{id}/runs"), body.as_bytes());
    assert_eq!(answer.status, 200, "{}", answer.body);
    assert!(answer.head.contains("application/json"), "{}", answer.head);
    answer.json()
}

#[test]
fn a_run_of_a_file_is_trimmed_or_left_out_alone() {
    let folder = tempdir().unwrap();
    let client = Client::new(&options(&folder.path().join("state")));
    let text = table(folder.path());
    assert_eq!(client.send("PUT", "/api/files/all.csv", text.as_bytes()).status, 200);
    let state = client.state();
    assert_eq!(state["logs"][0]["runs_by"], "trial");
    let state = put_runs(&client, state["logs"][0]["id"].as_u64().unwrap(), true);
    let runs: Vec<String> = (1..=4).map(|run| format!("all.csv::trial={run}")).collect();
    assert_eq!(names(&state), runs);
    let ids: Vec<u64> =
        state["logs"].as_array().unwrap().iter().map(|log| log["id"].as_u64().unwrap()).collect();
    let rows = |log: &Value| log["log"]["channels"][1]["values"].as_u64().unwrap();
    let sum: u64 = state["logs"].as_array().unwrap().iter().map(rows).sum();
    assert_eq!(sum as usize, text.lines().count() - 1);
    let trace = client.send("GET", &format!("/api/logs/{}/trace/3?pixels=300", ids[2]), b"").json();
    assert_eq!(trace["samples"].as_u64(), Some(rows(&state["logs"][2])));

    client.setup(|setup| {
        setup["effort"] = json!("quick");
        setup["left_out"] = json!([ids[3]]);
        setup["trims"] = json!([{ "log": ids[1], "skip": "2 s", "until": "", "leave_out": [] }]);
    });
    let job = client.identify();
    let result = job["result"].as_u64().unwrap_or_else(|| panic!("{job}"));
    let file = |name: &str| client.send("GET", &format!("/api/results/{result}/files/{name}"), b"");
    let campaign = file("campaign.toml").body;
    assert!(campaign.contains("file = \"all.csv::trial=2\"\nskip = \"2 s\""), "{campaign}");
    assert!(!campaign.contains("trial=4"), "{campaign}");
    // The description does the same in the command.
    let described = folder.path().join("state/logs/again.toml");
    fs::write(&described, &campaign).unwrap();
    let again = lissom_io::read_campaign(&described).unwrap().campaign;
    let found = Identify::new(&again).effort(Effort::Quick).run().unwrap();
    let found = lissom_io::ResultFile::of(&again.channels, found.identified(), None);
    assert_eq!(serde_json::to_value(found).unwrap(), file("result.json").json());
    assert_eq!(again.runs.len(), 3);
}

#[test]
fn a_file_remains_while_a_run_of_it_is_used() {
    let folder = tempdir().unwrap();
    let state_folder = folder.path().join("state");
    let client = Client::new(&options(&state_folder));
    let text = table(folder.path());
    client.send("PUT", "/api/files/all.csv", text.as_bytes());
    let id = client.state()["logs"][0]["id"].as_u64().unwrap();
    let old = json!({ "revision": 0, "apart": true }).to_string();
    assert_eq!(client.send("PUT", &format!("/api/logs/{id}/runs"), old.as_bytes()).status, 409);
    let state = put_runs(&client, id, true);
    let first = state["logs"][0]["id"].as_u64().unwrap();
    let remove = |id: u64| {
        let revision = client.state()["revision"].as_u64().unwrap();
        client.send("DELETE", &format!("/api/logs/{id}?revision={revision}"), b"").json()
    };
    let state = remove(first);
    assert_eq!(names(&state).len(), 3);
    assert!(state["logs"][0]["problem"].is_null(), "{}", state["logs"][0]);
    // They are the file again.
    let state = put_runs(&client, state["logs"][1]["id"].as_u64().unwrap(), false);
    assert_eq!(names(&state), ["all.csv"]);
    remove(state["logs"][0]["id"].as_u64().unwrap());
    assert!(!state_folder.join("logs/all.csv").exists());
}

#[test]
fn what_is_said_about_a_file_holds_for_its_runs() {
    let folder = tempdir().unwrap();
    let client = Client::new(&options(&folder.path().join("state")));
    let text = table(folder.path());
    client.send("PUT", "/api/files/all.csv", text.as_bytes());
    let trim = json!({ "log": 1, "skip": "1 s", "until": "", "leave_out": [] });
    client.setup(|setup| {
        setup["torque_constant"] = json!("0.05 N*m/A");
        setup["left_out"] = json!([1]);
        setup["trims"] = json!([trim]);
    });
    let state = put_runs(&client, 1, true);
    let ids: Vec<&Value> = state["logs"].as_array().unwrap().iter().map(|log| &log["id"]).collect();
    assert_eq!(state["setup"]["left_out"], json!(ids));
    let trims = state["setup"]["trims"].as_array().unwrap();
    assert!(trims.len() == 4 && trims.iter().all(|trim| trim["skip"] == "1 s"), "{trims:?}");
    let state = put_runs(&client, ids[2].as_u64().unwrap(), false);
    let whole = &state["logs"][0]["id"];
    assert_eq!(state["setup"]["left_out"], json!([whole]));
    assert_eq!(state["setup"]["trims"][0]["log"], *whole);
    assert_eq!(state["setup"]["torque_constant"], "0.05 N*m/A");
}

#[test]
fn taking_groups_apart_keeps_what_is_said_about_other_logs() {
    let folder = tempdir().unwrap();
    let client = Client::new(&options(folder.path()));
    let column = |scale: f64| (0..100).map(|k| scale * f64::from(k)).collect::<Vec<f64>>();
    let run = || json!({ "t": column(0.01), "i": column(0.2), "q": column(0.1) });
    let groups = json!({ "a": run(), "b": run() }).to_string();
    assert_eq!(client.send("PUT", "/api/files/groups.json", groups.as_bytes()).status, 200);
    let rows = (0..100).map(|k| format!("{},{},{}\n", 0.01 * f64::from(k), k % 7, k * k));
    let log = format!("t [s],i [A],q [rad]\n{}", rows.collect::<String>());
    assert_eq!(client.send("PUT", "/api/files/log.csv", log.as_bytes()).status, 200);
    client.setup(|setup| {
        setup["left_out"] = json!([1]);
        setup["gear_ratio"] = json!("50");
        setup["trims"] = json!([{ "log": 2, "skip": "0.1 s", "until": "", "leave_out": [] }]);
    });
    let before = client.state()["setup"].clone();
    let state = put_runs(&client, 1, true);
    assert_eq!(names(&state), ["groups.json::a", "groups.json::b", "log.csv"]);
    for key in ["gear_ratio", "trims", "motor", "command"] {
        assert_eq!(state["setup"][key], before[key], "{key}");
    }
    assert_eq!(state["setup"]["left_out"].as_array().unwrap().len(), 2);
}

#[test]
fn what_has_one_run_is_not_taken_apart() {
    let folder = tempdir().unwrap();
    let client = Client::new(&options(folder.path()));
    let row = |k: i32| format!("{},{},{}\n", 0.01 * f64::from(k), k % 2, 0.1 * f64::from(k));
    let log = format!("t [s],i [A],q [rad]\n{}", (0..300).map(row).collect::<String>());
    client.send("PUT", "/api/files/one.csv", log.as_bytes());
    let body = |client: &Client| json!({ "revision": client.state()["revision"], "apart": true });
    let answer = |client: &Client| {
        client.send("PUT", "/api/logs/1/runs", body(client).to_string().as_bytes())
    };
    assert_eq!(answer(&client).status, 422);
    // A column with another value in each row names no runs.
    client.setup(|setup| setup["run"] = json!("q [rad]"));
    let refused = answer(&client);
    assert_eq!(refused.status, 422, "{}", refused.body);
    assert_eq!(refused.json()["error"], "q [rad] of one.csv has 300 values");
    assert_eq!(names(&client.state()), ["one.csv"]);
}
