//! A small client: requests exactly as a test writes them.

use std::fmt::Write as _;
use std::io::{Read as _, Write as _};
use std::net::TcpStream;
use std::path::Path;
use std::thread;

use lissom_studio::{Studio, StudioOptions};
use serde_json::Value;

pub(crate) struct Client {
    pub(crate) port: u16,
    pub(crate) token: String,
    pub(crate) key: String,
}

pub(crate) struct Answer {
    pub(crate) status: u16,
    pub(crate) head: String,
    pub(crate) body: String,
}

/// Options with a folder.
pub(crate) fn options(folder: &Path) -> StudioOptions {
    let mut options = StudioOptions::default();
    options.folder = Some(folder.to_owned());
    options
}

impl Client {
    /// Starts a server, and does not enter it.
    pub(crate) fn outside(options: &StudioOptions) -> Self {
        let studio = Studio::open(options).unwrap();
        let (before, token) = studio.address().split_once("/#").unwrap();
        let port = before.rsplit(':').next().unwrap().parse().unwrap();
        let token = token.to_owned();
        thread::spawn(move || studio.run());
        Self { port, token, key: String::new() }
    }

    /// Starts a server, and exchanges the token for a key.
    pub(crate) fn new(options: &StudioOptions) -> Self {
        let mut client = Self::outside(options);
        let body = format!("{{\"token\":\"{}\"}}", client.token);
        let json = [("Content-Type", "application/json")];
        let answer = client.raw("POST", "/api/key", &json, body.as_bytes());
        assert_eq!(answer.status, 200, "{}", answer.body);
        answer.json()["key"].as_str().unwrap().clone_into(&mut client.key);
        client
    }

    /// A request with a host and these headers, and no others.
    pub(crate) fn raw(
        &self,
        method: &str,
        path: &str,
        headers: &[(&str, &str)],
        body: &[u8],
    ) -> Answer {
        let mut head = format!("{method} {path} HTTP/1.1\r\nConnection: close\r\n");
        if !headers.iter().any(|(name, _)| *name == "Host") {
            let _ = write!(head, "Host: 127.0.0.1:{}\r\n", self.port);
        }
        for (name, value) in headers {
            let _ = write!(head, "{name}: {value}\r\n");
        }
        let _ = write!(head, "Content-Length: {}\r\n\r\n", body.len());
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        stream.write_all(head.as_bytes()).unwrap();
        // The server may refuse before all has arrived.
        let _early = stream.write_all(body);
        let mut bytes = Vec::new();
        let _end = stream.read_to_end(&mut bytes);
        let text = String::from_utf8_lossy(&bytes);
        let (head, body) = text.split_once("\r\n\r\n").unwrap_or((&text, ""));
        let status = head.split(' ').nth(1).and_then(|code| code.parse().ok()).unwrap_or(0);
        Answer { status, head: head.to_ascii_lowercase(), body: body.to_owned() }
    }

    /// A request with the key.
    pub(crate) fn send(&self, method: &str, path: &str, body: &[u8]) -> Answer {
        let headers = [("X-Lissom-Key", self.key.as_str()), ("Content-Type", "application/json")];
        self.raw(method, path, &headers, body)
    }

    pub(crate) fn state(&self) -> Value {
        self.send("GET", "/api/state", b"").json()
    }

    /// Changes the setup, as one page after the other.
    pub(crate) fn setup(&self, change: impl FnOnce(&mut Value)) -> Answer {
        let mut state = self.state();
        change(&mut state["setup"]);
        let body = serde_json::json!({ "revision": state["revision"], "setup": state["setup"] });
        self.send("PUT", "/api/setup", body.to_string().as_bytes())
    }

    /// Identifies, and waits for the end.
    pub(crate) fn identify(&self) -> Value {
        let body = serde_json::json!({ "revision": self.state()["revision"] }).to_string();
        let answer = self.send("POST", "/api/job", body.as_bytes());
        assert_eq!(answer.status, 200, "{}", answer.body);
        self.finished()
    }

    /// Waits for the end of the job.
    pub(crate) fn finished(&self) -> Value {
        loop {
            let job = self.send("GET", "/api/job", b"").json();
            if job["finished"] == true {
                return job;
            }
            thread::sleep(std::time::Duration::from_millis(50));
        }
    }
}

impl Answer {
    pub(crate) fn json(&self) -> Value {
        serde_json::from_str(&self.body).unwrap_or_else(|_| panic!("{} {}", self.status, self.body))
    }
}
