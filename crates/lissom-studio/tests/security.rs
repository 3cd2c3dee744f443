//! Who may ask, and what can be read.
#![expect(clippy::unwrap_used, reason = "tests")]

mod client;

use std::fs;
use std::io::{Read as _, Write as _};
use std::net::TcpStream;

use client::{Client, options};
use lissom_studio::{Studio, StudioError};
use serde_json::{Value, json};
use tempfile::tempdir;

/// A log of a motor that follows a sine.
fn log() -> String {
    let row = |k: u32| {
        let t = 0.002 * f64::from(k);
        let (q, i) = ((3.0 * t).sin(), 0.1 * (3.0 * t).cos().signum() - 0.5 * (3.0 * t).sin());
        format!("{t},{i},{q}\n")
    };
    "t [s],i [A],q [rad]\n".to_owned() + &(0..4000).map(row).collect::<String>()
}

#[test]
fn only_the_loopback_interface_is_served() {
    let folder = tempdir().unwrap();
    let client = Client::outside(&options(folder.path()));
    assert!(TcpStream::connect(("127.0.0.1", client.port)).is_ok());
    // Addresses of the machine itself that are not 127.0.0.1.
    assert!(TcpStream::connect(("127.0.0.2", client.port)).is_err());
    let own = std::net::UdpSocket::bind("0.0.0.0:0").and_then(|socket| {
        socket.connect("192.0.2.1:9")?;
        socket.local_addr()
    });
    if let Ok(own) = own
        && !own.ip().is_loopback()
    {
        assert!(TcpStream::connect((own.ip(), client.port)).is_err(), "{own}");
    }
}

#[test]
fn the_token_can_be_used_once_and_nothing_is_there_without_a_key() {
    let folder = tempdir().unwrap();
    let mut client = Client::outside(&options(folder.path()));
    let enter = |token: &str| {
        let body = json!({ "token": token }).to_string();
        client.raw("POST", "/api/key", &[("Content-Type", "application/json")], body.as_bytes())
    };
    for wrong in ["", "0", &"0".repeat(64), &client.token[1..]] {
        assert_eq!(enter(wrong).status, 403, "{wrong}");
    }
    let first = enter(&client.token);
    assert_eq!(first.status, 200);
    assert_eq!(enter(&client.token).status, 403);
    let key = first.json()["key"].as_str().unwrap().to_owned();
    assert_ne!(key, client.token);
    let addresses = [
        ("GET", "/api/state"),
        ("PUT", "/api/setup"),
        ("POST", "/api/sample"),
        ("PUT", "/api/files/a.csv"),
        ("DELETE", "/api/logs/1?revision=0"),
        ("GET", "/api/logs/1/trace/1"),
        ("GET", "/api/job"),
        ("POST", "/api/job"),
        ("DELETE", "/api/job"),
        ("DELETE", "/api/results/1"),
        ("GET", "/api/results/1/report"),
        ("GET", "/api/results/1/files/result.json"),
        ("GET", "/api/compare?results=1,2"),
        ("POST", "/api/plan"),
        ("POST", "/api/virtual"),
    ];
    for (method, path) in addresses {
        for headers in [
            vec![],
            vec![("X-Lissom-Key", "0")],
            vec![("X-Lissom-Key", client.token.as_str())],
            vec![("Cookie", key.as_str())],
        ] {
            assert_eq!(client.raw(method, path, &headers, b"").status, 401, "{method} {path}");
        }
    }
    client.key = key;
    assert_eq!(client.send("GET", "/api/state", b"").status, 200);
    // The file opens a further page: its token is a new one, and works.
    let opener = fs::read_to_string(folder.path().join("open.html")).unwrap();
    let token = opener.split("/#").nth(1).unwrap().split('"').next().unwrap();
    let body = json!({ "token": token }).to_string();
    let json = [("Content-Type", "application/json")];
    assert_eq!(client.raw("POST", "/api/key", &json, body.as_bytes()).status, 200);
}

#[test]
fn other_names_and_other_pages_are_refused() {
    let folder = tempdir().unwrap();
    let client = Client::new(&options(folder.path()));
    let get = |more: &[(&str, &str)]| {
        let headers: Vec<_> =
            more.iter().copied().chain([("X-Lissom-Key", client.key.as_str())]).collect();
        client.raw("GET", "/api/state", &headers, b"").status
    };
    for host in ["localhost", "localhost:1", "127.0.0.1:8080", "[::1]", "[::1]:80", "LOCALHOST:9"] {
        assert_eq!(get(&[("Host", host)]), 200, "{host}");
    }
    for host in [
        "example.org",
        "localhost.example.org",
        "127.0.0.1.example.org",
        "127.0.0.2",
        "0.0.0.0",
        "localhost:80:80",
        "localhost:x",
        "localhost@example.org",
        "[::1].example.org",
        "[::2]",
        "",
    ] {
        assert_eq!(get(&[("Host", host)]), 403, "{host}");
    }
    let own = format!("127.0.0.1:{}", client.port);
    let origin = format!("http://{own}");
    assert_eq!(get(&[("Host", &own), ("Origin", &origin)]), 200);
    for origin in
        ["http://example.org", "null", "https://127.0.0.1", "http://127.0.0.1:1", "file://"]
    {
        assert_eq!(get(&[("Host", &own), ("Origin", origin)]), 403, "{origin}");
    }
    for site in ["cross-site", "same-site", "none"] {
        assert_eq!(get(&[("Sec-Fetch-Site", site)]), 403, "{site}");
    }
    assert_eq!(get(&[("Sec-Fetch-Site", "same-origin")]), 200);
}

#[test]
fn every_answer_has_the_headers_and_none_opens_it_to_other_pages() {
    let folder = tempdir().unwrap();
    let client = Client::new(&options(folder.path()));
    let preflight = [("Origin", "http://example.org"), ("Access-Control-Request-Method", "PUT")];
    for (method, path, headers) in [
        ("GET", "/", &[][..]),
        ("GET", "/studio.js", &[]),
        ("GET", "/studio.css", &[]),
        ("GET", "/nothing", &[]),
        ("GET", "/api/state", &[("X-Lissom-Key", client.key.as_str())]),
        ("GET", "/api/state", &[]),
        ("OPTIONS", "/api/setup", &preflight),
    ] {
        let answer = client.raw(method, path, headers, b"");
        assert!(!answer.head.contains("access-control-"), "{path}: {}", answer.head);
        assert!(!answer.head.contains("set-cookie"), "{path}: {}", answer.head);
        for header in [
            "x-content-type-options: nosniff",
            "frame-ancestors 'none'",
            "script-src 'self'",
            "default-src 'none'",
            "x-frame-options: deny",
            "referrer-policy: no-referrer",
            "cache-control: no-store",
            "cross-origin-resource-policy: same-origin",
        ] {
            assert!(
                answer.head.contains(header),
                "{method} {path}: no {header} in {}",
                answer.head
            );
        }
    }
}

#[cfg(unix)]
#[test]
fn the_state_can_be_read_by_the_user_only_and_by_one_process() {
    use std::os::unix::fs::PermissionsExt as _;
    let folder = tempdir().unwrap();
    let state = folder.path().join("state");
    let client = Client::new(&options(&state));
    assert_eq!(client.send("PUT", "/api/files/a.csv", log().as_bytes()).status, 200);
    let mode = |path: &str| fs::metadata(state.join(path)).unwrap().permissions().mode() & 0o777;
    for inner in ["", "logs", "results"] {
        assert_eq!(mode(inner), 0o700, "{inner}");
    }
    for file in ["session.json", "open.html", "lock", "logs/a.csv"] {
        assert_eq!(mode(file), 0o600, "{file}");
    }
    let second = Studio::open(&options(&state)).unwrap_err();
    assert!(matches!(second, StudioError::Locked { .. }), "{second}");
    // A folder with other files is not taken, and keeps its permissions.
    let foreign = tempdir().unwrap();
    fs::write(foreign.path().join("thesis.tex"), "x").unwrap();
    let before = fs::metadata(foreign.path()).unwrap().permissions();
    let refused = Studio::open(&options(foreign.path())).unwrap_err();
    assert!(matches!(refused, StudioError::Foreign { .. }), "{refused}");
    assert_eq!(fs::metadata(foreign.path()).unwrap().permissions(), before);
}

#[test]
fn uploads_stay_in_their_folder_under_plain_names() {
    let folder = tempdir().unwrap();
    let state = folder.path().join("state");
    let client = Client::new(&options(&state));
    for name in
        ["..%2F..%2Fescaped.csv", "%2Fetc%2Fescaped.csv", "..%5Cescaped.csv", ".escaped.csv"]
    {
        // Each is another log: of one file there is one log.
        let log = format!("{}{},0,0\n", log(), 8.0 + 0.002 * name.len() as f64);
        let answer = client.send("PUT", &format!("/api/files/{name}"), log.as_bytes());
        assert_eq!(answer.status, 200, "{name}: {}", answer.body);
    }
    let names: Vec<String> = fs::read_dir(state.join("logs"))
        .unwrap()
        .map(|file| file.unwrap().file_name().into_string().unwrap())
        .collect();
    assert_eq!(names.len(), 4, "{names:?}");
    assert!(names.iter().all(|name| name.starts_with("escaped")), "{names:?}");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    let hidden = client.send("PUT", "/api/files/a%1b%5B31m%07.csv", log().as_bytes());
    assert!(!hidden.body.contains("\\u001b"), "{}", hidden.body);
}

#[test]
fn a_quota_limits_uploads_and_nothing_remains_of_a_part() {
    let folder = tempdir().unwrap();
    let mut limited = options(folder.path());
    limited.quota_bytes = Some(200_000);
    let client = Client::new(&limited);
    let log = log();
    assert!(log.len() < 200_000 && 2 * log.len() > 200_000, "{}", log.len());
    assert_eq!(client.send("PUT", "/api/files/a.csv", log.as_bytes()).status, 200);
    let refused = client.send("PUT", "/api/files/b.csv", log.as_bytes());
    assert_eq!(refused.status, 422, "{}", refused.body);
    // One that says it is long, and ends early.
    let headers = [("X-Lissom-Key", client.key.as_str()), ("Content-Length", "100000")];
    client.raw("PUT", "/api/files/c.csv", &headers, b"t,i,q\n");
    let files = || fs::read_dir(folder.path().join("logs")).unwrap().count();
    for _ in 0..100 {
        if files() == 1 {
            break;
        }
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    assert_eq!(files(), 1);
}

#[test]
fn what_expands_beyond_the_quota_is_refused() {
    let folder = tempdir().unwrap();
    let mut limited = options(folder.path());
    limited.quota_bytes = Some(200_000);
    let client = Client::new(&limited);
    let mut bomb = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::best());
    std::io::copy(&mut std::io::repeat(b'0').take(20_000_000), &mut bomb).unwrap();
    let bomb = bomb.finish().unwrap();
    assert!(bomb.len() < 50_000, "{}", bomb.len());
    let refused = client.send("PUT", "/api/files/a.csv.gz", &bomb);
    assert_eq!(refused.status, 422, "{}", refused.body);
    assert!(refused.body.contains("expands to more than"), "{}", refused.body);
    assert_eq!(fs::read_dir(folder.path().join("logs")).unwrap().count(), 0);
    let mut small = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    small.write_all(log().as_bytes()).unwrap();
    let small = small.finish().unwrap();
    assert_eq!(client.send("PUT", "/api/files/a.csv.gz", &small).status, 200);
}

#[test]
fn names_in_exports_are_only_names() {
    let folder = tempdir().unwrap();
    let client = Client::new(&options(folder.path()));
    let revision = json!({ "revision": client.state()["revision"] }).to_string();
    assert_eq!(client.send("POST", "/api/sample", revision.as_bytes()).status, 200);
    client.setup(|setup| setup["effort"] = json!("quick"));
    let result = client.identify()["result"].as_u64().unwrap();
    // As if the log had a channel of this name.
    let evil = "=1+1\"'); import os #\u{1b}[31m</joint><!--\n*/";
    let path = folder.path().join(format!("results/{result}/result.json"));
    let mut found: Value = serde_json::from_str(&fs::read_to_string(&path).unwrap()).unwrap();
    for part in ["arm", "models"] {
        assert_eq!(found[part]["tips"][0]["name"], "tip [rad]");
        found[part]["tips"][0]["name"] = json!(evil);
    }
    fs::write(&path, found.to_string()).unwrap();
    let mut has_name = 0;
    for name in ["arm.py", "arm.m", "arm.xml", "lissom_feedforward.h", "lissom_feedforward.c"] {
        let file = client.send("GET", &format!("/api/results/{result}/files/{name}"), b"");
        assert_eq!(file.status, 200, "{name}: {}", file.body);
        assert!(file.body.chars().all(|c| c == '\n' || !c.is_control()), "{name}");
        assert!(!file.body.contains("</joint><!--\n"), "{name}");
        for line in file.body.lines().filter(|line| line.contains("import os")) {
            has_name += 1;
            // The name does not end the text that it stands in.
            let [quote, before] = if name == "arm.m" { ["'", "'=1+1"] } else { ["\"", "\"=1+1"] };
            let (_, rest) = line.split_once(before).unwrap_or_else(|| panic!("{name}: {line}"));
            let (inside, _) = rest.split_once(quote).unwrap();
            assert!(inside.contains("import os"), "{name}: {line}");
        }
    }
    assert_eq!(has_name, 2);
}

#[test]
fn what_is_no_json_is_answered_as_every_error_is() {
    let folder = tempdir().unwrap();
    let client = Client::new(&options(folder.path()));
    for path in ["/api/key", "/api/job", "/api/plan"] {
        for body in ["", "[", "{\"token\":7}"] {
            let answer = client.send("POST", path, body.as_bytes());
            assert!((400..500).contains(&answer.status), "{path}: {}", answer.status);
            assert!(answer.json()["error"].is_string(), "{path}: {}", answer.body);
        }
    }
    for path in ["/api/results/one/report", "/api/logs/1/trace/1?from=a", "/api/compare"] {
        let answer = client.send("GET", path, b"");
        assert_eq!(answer.status, 400, "{path}");
        assert!(answer.json()["error"].is_string(), "{path}: {}", answer.body);
    }
}

#[test]
fn no_file_but_those_that_were_given_can_be_read() {
    let folder = tempdir().unwrap();
    let secret = folder.path().join("secret.csv");
    fs::write(&secret, log()).unwrap();
    let secret = secret.display();
    let client = Client::new(&options(&folder.path().join("state")));
    assert_eq!(client.send("PUT", "/api/files/a.csv", log().as_bytes()).status, 200);
    // A channel of another file.
    for column in [format!("{secret}::q [rad]"), "../../secret.csv::q [rad]".to_owned()] {
        let answer = client.setup(|setup| {
            setup["tips"] = json!([{ "column": column, "unit": "rad" }]);
        });
        let problems = answer.json()["campaign"]["problems"].to_string();
        assert!(problems.contains("there is no channel"), "{problems}");
    }
    // Text that would end a value of the campaign.toml.
    let answer = client.setup(|setup| {
        setup["tips"] = json!([]);
        setup["torque_constant"] = json!(format!("1\"\narm = \"{secret}"));
    });
    assert_eq!(answer.status, 200);
    let job = client.identify();
    assert!(job["problem"]["error"].as_str().is_some(), "{job}");
    // A campaign that names files elsewhere.
    let campaign = format!(
        "signals.time = {{ column = 't [s]', unit = 's' }}\nsignals.current = {{ column = 'i [A]', unit = 'A', hold = \
         'measured' }}\nsignals.motor = {{ column = 'q [rad]', unit = 'rad' }}\nruns = [{{ file = '{secret}' }}]\n"
    );
    let added = client.send("PUT", "/api/files/campaign.toml", campaign.as_bytes());
    assert_eq!(added.status, 200, "{}", added.body);
    let job = client.identify();
    let error = job["problem"]["error"].as_str().unwrap();
    assert!(error.ends_with("is not inside the folder of the campaign"), "{error}");
}

#[cfg(unix)]
#[test]
fn links_are_not_followed() {
    let folder = tempdir().unwrap();
    let state = folder.path().join("state");
    let client = Client::new(&options(&state));
    assert_eq!(client.send("PUT", "/api/files/a.csv", log().as_bytes()).status, 200);
    let secret = folder.path().join("secret.csv");
    fs::write(&secret, log()).unwrap();
    fs::remove_file(state.join("logs/a.csv")).unwrap();
    std::os::unix::fs::symlink(&secret, state.join("logs/a.csv")).unwrap();
    // Another way of reading, so that the log in memory does not count.
    let answer = client.setup(|setup| setup["skip_rows"] = json!(1));
    assert_eq!(answer.json()["logs"][0]["problem"]["error"], "there is no such log");
}

#[test]
fn a_second_identification_is_refused_while_one_runs() {
    let folder = tempdir().unwrap();
    let client = Client::new(&options(folder.path()));
    let revision = json!({ "revision": client.state()["revision"] }).to_string();
    assert_eq!(client.send("POST", "/api/sample", revision.as_bytes()).status, 200);
    client.setup(|setup| setup["effort"] = json!("thorough"));
    let revision = json!({ "revision": client.state()["revision"] }).to_string();
    let start = || client.send("POST", "/api/job", revision.as_bytes());
    assert_eq!(start().status, 200);
    assert_eq!(start().status, 409);
    assert_eq!(client.send("DELETE", "/api/job", b"").status, 200);
}

#[test]
fn requests_without_sense_are_answered() {
    let folder = tempdir().unwrap();
    let client = Client::new(&options(folder.path()));
    let long = vec![b'x'; 2 << 20];
    for (method, path, body) in [
        ("PUT", "/api/setup", &b"{}"[..]),
        ("PUT", "/api/setup", b"not json"),
        ("PUT", "/api/setup", &long),
        ("PUT", "/api/setup", br#"{"revision":0,"setup":{"unknown":1}}"#),
        ("GET", "/api/logs/99999999999999999999/trace/1", b""),
        ("GET", "/api/logs/1/trace/0", b""),
        ("GET", "/api/results/7/files/..%2F..%2Fsession.json", b""),
        ("GET", "/api/compare?results=1,x", b""),
        ("GET", "/api/%ff", b""),
        ("DELETE", "/api/logs/1", b""),
        ("PUT", "/api/files/empty.csv", b""),
        ("PUT", "/api/files/bytes.csv", &[0xff; 1000]),
    ] {
        let answer = client.send(method, path, body);
        assert!((400..500).contains(&answer.status), "{method} {path}: {}", answer.status);
    }
    assert_eq!(client.send("GET", "/api/state", b"").status, 200);
    assert_eq!(fs::read_dir(folder.path().join("logs")).unwrap().count(), 0);
}
