//! Logs, identification and results over the server's addresses.
#![expect(clippy::unwrap_used, reason = "tests")]

mod client;

use std::fs;

use client::{Client, options};
use lissom::identify::Effort;
use lissom::prelude::*;
use serde_json::{Value, json};
use tempfile::tempdir;

fn with_sample(folder: &std::path::Path) -> Client {
    let client = Client::new(&options(folder));
    let revision = json!({ "revision": client.state()["revision"] }).to_string();
    let answer = client.send("POST", "/api/sample", revision.as_bytes());
    assert_eq!(answer.status, 200, "{}", answer.body);
    client
}

#[test]
fn the_sample_is_identified_as_the_library_does_it() {
    let folder = tempdir().unwrap();
    let client = with_sample(folder.path());
    client.setup(|setup| setup["effort"] = json!("quick"));
    let job = client.identify();
    let result = job["result"].as_u64().unwrap_or_else(|| panic!("{job}"));
    let file = |name: &str| client.send("GET", &format!("/api/results/{result}/files/{name}"), b"");
    let found: Value = file("result.json").json();
    // The exported campaign.toml with the same logs gives the same numbers.
    let logs = folder.path().join("logs");
    fs::write(logs.join("again.toml"), file("campaign.toml").body).unwrap();
    let campaign = lissom_io::read_campaign(&logs.join("again.toml")).unwrap();
    let again = Identify::new(&campaign.campaign).effort(Effort::Quick).run().unwrap();
    let again = lissom_io::ResultFile::of(&campaign.campaign.channels, again.identified(), None);
    assert_eq!(serde_json::to_value(again).unwrap(), found);
    let state = client.state();
    for name in state["results"][0]["files"].as_array().unwrap() {
        let answer = file(name.as_str().unwrap());
        assert_eq!(answer.status, 200, "{name}: {}", answer.body);
        assert!(answer.head.contains("content-disposition: attachment"), "{}", answer.head);
    }
    let report = client.send("GET", &format!("/api/results/{result}/report"), b"").body;
    assert!(report.starts_with("<h1>sample-1.csv and 3 more</h1>"), "{}", &report[..200]);
    assert!(!report.contains("<html") && report.contains("figure-data"));
}

#[test]
fn a_log_that_cannot_be_one_is_reported_before_the_identification() {
    let folder = tempdir().unwrap();
    let client = with_sample(folder.path());
    let sample = fs::read_to_string(folder.path().join("logs/sample-1.csv")).unwrap();
    // The same file would count as two runs.
    let same = client.send("PUT", "/api/files/copy.csv", sample.as_bytes());
    assert_eq!(same.status, 422, "{}", same.body);
    let error = &same.json()["error"];
    assert_eq!(error, "copy.csv is the same file as sample-1.csv, which is there already");
    // One of another machine has no such channel.
    let other = sample.replacen("tip [rad]", "beam [rad]", 1);
    let added = client.send("PUT", "/api/files/other.csv", other.as_bytes());
    assert_eq!(added.status, 200, "{}", added.body);
    let problems = added.json()["campaign"]["problems"].clone();
    assert_eq!(problems[0]["error"], "other.csv: there is no channel \"tip [rad]\"", "{problems}");
    let id = added.json()["logs"][4]["id"].clone();
    let state = client.setup(|setup| setup["left_out"] = json!([id])).json();
    assert_eq!(state["campaign"]["problems"], json!([]));
    // A session has one description.
    let campaign = state["campaign"]["text"].as_str().unwrap().replace("#:schema", "# ");
    let first = client.send("PUT", "/api/files/campaign.toml", campaign.as_bytes());
    assert_eq!(first.status, 200, "{}", first.body);
    let second = client.send("PUT", "/api/files/again.toml", campaign.as_bytes());
    assert_eq!(second.status, 409, "{}", second.body);
}

#[test]
fn a_session_that_another_program_changed_is_refused() {
    let folder = tempdir().unwrap();
    let client = with_sample(folder.path());
    drop(client);
    let text = fs::read_to_string(folder.path().join("session.json")).unwrap();
    let session: Value = serde_json::from_str(&text).unwrap();
    for (pointer, value) in [
        ("/logs/0/name", json!("../../victim.csv")),
        ("/logs/1/id", session["logs"][0]["id"].clone()),
        ("/next_log", json!(1)),
        ("/revision", json!(u64::MAX)),
    ] {
        let copy = tempdir().unwrap();
        let mut changed = session.clone();
        *changed.pointer_mut(pointer).unwrap() = value;
        fs::write(copy.path().join("lock"), "").unwrap();
        fs::write(copy.path().join("session.json"), changed.to_string()).unwrap();
        let refused = lissom_studio::Studio::open(&options(copy.path()));
        assert!(refused.is_err(), "{pointer}");
    }
}

#[test]
fn the_state_is_there_after_a_restart() {
    let folder = tempdir().unwrap();
    let copy = tempdir().unwrap();
    let client = with_sample(folder.path());
    client.setup(|setup| {
        setup["effort"] = json!("quick");
        setup["left_out"] = json!([2]);
    });
    assert!(client.identify()["result"].is_u64());
    let before = client.state();
    // The first server runs until the tests end: another one starts with a copy of its folder.
    for inner in ["logs", "results", "results/1"] {
        fs::create_dir_all(copy.path().join(inner)).unwrap();
        for file in fs::read_dir(folder.path().join(inner)).unwrap() {
            let file = file.unwrap();
            if file.path().is_file() {
                fs::copy(file.path(), copy.path().join(inner).join(file.file_name())).unwrap();
            }
        }
    }
    fs::copy(folder.path().join("session.json"), copy.path().join("session.json")).unwrap();
    fs::write(copy.path().join("lock"), "").unwrap();
    let after = Client::new(&options(copy.path())).state();
    for key in ["revision", "logs", "setup", "results", "campaign"] {
        assert_eq!(before[key], after[key], "{key}");
    }
}

#[test]
fn a_page_that_knows_an_old_state_changes_nothing() {
    let folder = tempdir().unwrap();
    let client = with_sample(folder.path());
    let old = client.state();
    client.setup(|setup| setup["gravity"] = json!(true));
    let mut stale = old["setup"].clone();
    stale["torque_constant"] = json!("9 N*m/A");
    let body = json!({ "revision": old["revision"], "setup": stale }).to_string();
    assert_eq!(client.send("PUT", "/api/setup", body.as_bytes()).status, 409);
    let path = format!("/api/logs/1?revision={}", old["revision"]);
    assert_eq!(client.send("DELETE", &path, b"").status, 409);
    let body = json!({ "revision": old["revision"] }).to_string();
    assert_eq!(client.send("POST", "/api/job", body.as_bytes()).status, 409);
    let now = client.state();
    assert_eq!(now["setup"]["gravity"], true);
    assert_eq!(now["setup"]["torque_constant"], old["setup"]["torque_constant"]);
    assert_eq!(now["logs"].as_array().unwrap().len(), 4);
}

#[test]
fn a_search_that_is_stopped_keeps_its_best_result() {
    let folder = tempdir().unwrap();
    let client = with_sample(folder.path());
    client.setup(|setup| setup["effort"] = json!("thorough"));
    let body = json!({ "revision": client.state()["revision"] }).to_string();
    assert_eq!(client.send("POST", "/api/job", body.as_bytes()).status, 200);
    let job = loop {
        let job = client.send("GET", "/api/job", b"").json();
        if job["step"] == "output-error method" {
            client.send("DELETE", "/api/job", b"");
        }
        if job["finished"] == true {
            break job;
        }
        std::thread::sleep(std::time::Duration::from_millis(20));
    };
    assert!(job["result"].is_u64(), "{job}");
    assert!(!job["first"].as_array().unwrap().is_empty());
}

#[test]
fn stretches_are_left_out_as_the_setup_says() {
    let folder = tempdir().unwrap();
    let client = with_sample(folder.path());
    client.setup(|setup| {
        setup["effort"] = json!("quick");
        setup["trims"] =
            json!([{ "log": 1, "skip": "1 s", "until": "18 s", "leave_out": [["8 s", "9 s"]] }]);
    });
    let result = client.identify()["result"].as_u64().unwrap();
    let text = client.send("GET", &format!("/api/results/{result}/files/campaign.toml"), b"").body;
    for line in ["skip = \"1 s\"", "until = \"18 s\"", "leave_out = [[\"8 s\", \"9 s\"]]"] {
        assert!(text.contains(line), "{text}");
    }
    let runs = client.state()["results"][0]["runs"].as_u64();
    assert_eq!(runs, Some(5));
}

#[test]
fn the_next_experiment_is_planned_and_tried_with_the_arm_that_was_found() {
    let folder = tempdir().unwrap();
    let client = with_sample(folder.path());
    client.setup(|setup| setup["effort"] = json!("quick"));
    let result = client.identify()["result"].as_u64().unwrap();
    let arm = client.send("GET", &format!("/api/results/{result}/files/arm.toml"), b"");
    assert_eq!(arm.status, 200, "{}", arm.body);
    assert_eq!(client.send("POST", "/api/virtual", b"").status, 404);
    let body = json!({ "arm": arm.body, "precision": "2%", "within": "5 min" }).to_string();
    let plan = client.send("POST", "/api/plan", body.as_bytes()).json();
    assert!(plan["text"].as_str().is_some_and(|text| text.contains("[[runs]]")), "{plan}");
    let expected = plan["expected"].as_array().unwrap();
    assert!(expected.iter().any(|row| row["reached"] == true), "{plan}");
    assert_eq!(client.send("POST", "/api/virtual", b"").status, 200);
    let job = client.finished();
    let tried = job["result"].as_u64().unwrap_or_else(|| panic!("{job}"));
    let file =
        |id: u64| client.send("GET", &format!("/api/results/{id}/files/result.json"), b"").json();
    let inertia = |id: u64| file(id)["drive"]["inertia"]["value"].as_f64().unwrap();
    assert!(
        (inertia(tried) / inertia(result) - 1.0).abs() < 0.05,
        "{} {}",
        inertia(tried),
        inertia(result)
    );
    let report = client.send("GET", &format!("/api/results/{tried}/report"), b"").body;
    assert!(report.contains("truth"), "no true values on the page");
    let files = client.state()["results"][1]["files"].to_string();
    assert!(files.contains("plan.toml") && !files.contains("campaign.toml"), "{files}");
    let path = format!("/api/results/{tried}/files/plan.toml");
    assert_eq!(client.send("GET", &path, b"").body, plan["text"].as_str().unwrap());
    let wrong = json!({ "arm": "[beam]\nrigid = 1", "precision": "", "within": "" }).to_string();
    let refused = client.send("POST", "/api/plan", wrong.as_bytes());
    assert!(refused.status == 422 && refused.body.contains("arm.toml"), "{}", refused.body);
}

#[test]
fn what_cannot_be_read_is_refused_and_what_is_wrong_is_named_at_once() {
    let folder = tempdir().unwrap();
    let client = with_sample(folder.path());
    let before = client.state();
    let refused = client.setup(|setup| setup["header_row"] = json!(999_999));
    assert_eq!(refused.status, 422, "{}", refused.body);
    assert_eq!(client.state(), before);
    let problem = |change: &dyn Fn(&mut Value)| {
        let state = client.setup(|setup| change(setup)).json();
        state["campaign"]["problems"][0]["error"].as_str().unwrap_or_default().to_owned()
    };
    let unit = problem(&|setup| {
        setup["motor"] = json!({ "column": "motor [rad]", "unit": "bananas" });
    });
    assert!(unit.contains("signals.motor.unit"), "{unit}");
    let gear = problem(&|setup| {
        setup["motor"] = json!(null);
        setup["gear_ratio"] = json!("50:1");
    });
    assert!(gear.contains("drive.gear_ratio"), "{gear}");
    let none = problem(&|setup| {
        setup["gear_ratio"] = json!("");
        setup["sample_time"] = json!("5 ms");
    });
    assert_eq!(none, "");
    let state = client.state();
    let text = state["campaign"]["text"].as_str().unwrap();
    assert!(
        text.contains("in place of the time stamps of time [s], whose usual step is 3.000e-3 s"),
        "{text}"
    );
    assert_eq!(state["logs"][0]["stamp_s"], 0.005);
}

#[test]
fn a_bad_log_is_refused_with_its_place_and_leaves_nothing() {
    let folder = tempdir().unwrap();
    let client = with_sample(folder.path());
    let before = client.state();
    for (name, text) in [("empty.csv", ""), ("words.csv", "these are words\nand more of them\n")] {
        let answer = client.send("PUT", &format!("/api/files/{name}"), text.as_bytes());
        assert_eq!(answer.status, 422, "{}", answer.body);
        let error = answer.json()["error"].as_str().unwrap().to_owned();
        assert!(error.starts_with(name), "{error}");
    }
    assert_eq!(client.state()["logs"], before["logs"]);
    assert_eq!(fs::read_dir(folder.path().join("logs")).unwrap().count(), 4);
}

#[test]
fn ten_million_samples_are_sent_as_four_points_for_each_pixel() {
    let folder = tempdir().unwrap();
    let client = Client::new(&options(folder.path()));
    // An npy file of 10⁷ float32 rows of three columns.
    let rows = 10_000_000_usize;
    let header = format!(
        "{{'descr': [('t', '<f4'), ('i', '<f4'), ('q', '<f4')], 'fortran_order': False, 'shape': ({rows},), }}"
    );
    let length = (header.len() + 1 + 10).div_ceil(64) * 64 - 10;
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend(u16::try_from(length).unwrap().to_le_bytes());
    bytes.extend(format!("{header:<width$}\n", width = length - 1).as_bytes());
    for k in 0..rows {
        let spike = if k == 7_654_321 { 50.0 } else { (k as f64 * 1e-4).sin() };
        for value in [k as f64 * 1e-3, 0.5, spike] {
            bytes.extend((value as f32).to_le_bytes());
        }
    }
    let answer = client.send("PUT", "/api/files/long.npy", &bytes);
    assert_eq!(answer.status, 200, "{}", answer.body);
    let trace = client.send("GET", "/api/logs/1/trace/3?pixels=1000", b"").json();
    let shown: Vec<f64> = trace["y"].as_array().unwrap().iter().filter_map(Value::as_f64).collect();
    assert!(shown.len() <= 4000, "{}", shown.len());
    assert_eq!(trace["samples"], rows);
    assert!(shown.iter().any(|value| *value > 49.0));
}
