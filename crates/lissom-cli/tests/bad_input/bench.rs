//! A folder with a campaign and its log, both good, and the command run in it.

use std::f64::consts::PI;
use std::fmt::Write as _;
use std::path::Path;
use std::process::Output;

use assert_cmd::Command;
use tempfile::TempDir;

/// A campaign of one log `run.csv` with columns t, i, m, p.
pub(crate) const CAMPAIGN: &str = r#"[signals]
time = { column = "t", unit = "s" }
current = { column = "i", unit = "A", hold = "measured" }
motor = { column = "m", unit = "rad" }
tips = [{ name = "tip", column = "p", unit = "rad" }]

[drive]
torque_constant = "0.25 N*m/A"

[[runs]]
file = "run.csv"
"#;

/// Time [s], current [A], motor [rad] and tip [rad] of one sample.
pub(crate) type Row = [f64; 4];

/// A drive of 0.01 kg·m², 0.02 N·m·s/rad and 0.05 N·m moves with an amplitude of 1 rad at
/// `omega_rad_s`; a beam of 40 N·m/rad, clamped at 30 rad/s, follows.
pub(crate) fn motion(omega_rad_s: f64, sample_time_s: f64, seconds: f64) -> Vec<Row> {
    let magnified = 1.0 / (1.0 - (omega_rad_s / 30.0).powi(2));
    let row = |k: u32| {
        let time_s = f64::from(k) * sample_time_s;
        let (sin, cos) = (omega_rad_s * time_s + 0.3).sin_cos();
        let (speed, acceleration) = (omega_rad_s * cos, -omega_rad_s * omega_rad_s * sin);
        let beam = 0.4 * (1.0 - magnified) * sin;
        let torque = 0.01 * acceleration + 0.02 * speed + 0.05 * speed.signum() + beam;
        [time_s, torque / 0.25, sin, magnified * sin]
    };
    (0..u32::MAX).map(row).take_while(|row| row[0] < seconds - 0.5 * sample_time_s).collect()
}

/// The motion that most tests spoil: 4 rad/s, 5 ms, 20 s.
pub(crate) fn good() -> Vec<Row> {
    motion(4.0, 0.005, 20.0)
}

pub(crate) fn csv(rows: &[Row]) -> String {
    let mut text = String::from("t,i,m,p\n");
    for [t, i, m, p] in rows {
        writeln!(text, "{t:.6},{i:.6},{m:.6},{p:.6}").unwrap();
    }
    text
}

pub(crate) struct Bench {
    folder: TempDir,
}

impl Bench {
    pub(crate) fn new() -> Self {
        Self { folder: tempfile::tempdir().unwrap() }
            .file("campaign.toml", CAMPAIGN)
            .file("run.csv", csv(&good()))
    }

    /// The campaign with `from` replaced.
    pub(crate) fn replacing(from: &str, to: &str) -> Self {
        assert!(CAMPAIGN.contains(from), "{from}");
        Self::new().file("campaign.toml", CAMPAIGN.replace(from, to))
    }

    /// The campaign with something added.
    pub(crate) fn adding(text: &str) -> Self {
        Self::new().file("campaign.toml", format!("{CAMPAIGN}{text}"))
    }

    /// Another log.
    pub(crate) fn log(text: impl AsRef<[u8]>) -> Self {
        Self::new().file("run.csv", text)
    }

    /// The good log with one row replaced; the header is row 1.
    pub(crate) fn row(row: usize, text: &str) -> Self {
        let log = csv(&good());
        let mut rows: Vec<&str> = log.lines().collect();
        rows[row - 1] = text;
        Self::log(rows.join("\n"))
    }

    pub(crate) fn file(self, name: &str, text: impl AsRef<[u8]>) -> Self {
        std::fs::write(self.folder.path().join(name), text).unwrap();
        self
    }

    pub(crate) fn path(&self) -> &Path {
        self.folder.path()
    }

    pub(crate) fn identify(&self, arguments: &[&str]) -> Output {
        self.lissom("identify", arguments)
    }

    pub(crate) fn lissom(&self, command: &str, arguments: &[&str]) -> Output {
        let mut lissom = Command::cargo_bin("lissom").unwrap();
        lissom.current_dir(self.path()).arg(command).args(arguments).output().unwrap()
    }

    /// Every output is asked for; the command says `message` alone and leaves nothing.
    #[track_caller]
    pub(crate) fn refuses(&self, message: &str) {
        let outputs = ["--json", "out.json", "--report", "out.html", "--plots", "plots"];
        self.refuses_with(&[&["campaign.toml"][..], &outputs].concat(), 1, message);
    }

    #[track_caller]
    pub(crate) fn refuses_with(&self, arguments: &[&str], code: i32, message: &str) {
        self.lissom_refuses("identify", arguments, code, message);
    }

    #[track_caller]
    pub(crate) fn lissom_refuses(
        &self,
        command: &str,
        arguments: &[&str],
        code: i32,
        message: &str,
    ) {
        let before = names(self.path());
        let output = self.lissom(command, arguments);
        assert_eq!(text(&output.stderr).trim_end(), message);
        assert_eq!(output.status.code(), Some(code));
        assert_eq!(text(&output.stdout), "");
        assert_eq!(names(self.path()), before, "nothing is left behind");
    }

    /// The result, with exit code 0 or 3.
    #[track_caller]
    pub(crate) fn result(&self) -> serde_json::Value {
        let output = self.identify(&["campaign.toml", "--json"]);
        let code = output.status.code().unwrap();
        assert!(code == 0 || code == 3, "{code}: {}", text(&output.stderr));
        serde_json::from_slice(&output.stdout).unwrap()
    }

    /// The findings of one kind as `run: message`, those of the whole campaign as `message`.
    #[track_caller]
    pub(crate) fn findings(&self, code: &str) -> Vec<String> {
        let result = self.result();
        let findings = result["findings"].as_array().unwrap();
        findings
            .iter()
            .filter(|finding| finding["code"] == code)
            .map(|finding| {
                let message = finding["message"].as_str().unwrap();
                finding["run"]
                    .as_str()
                    .map_or(message.to_owned(), |run| format!("{run}: {message}"))
            })
            .collect()
    }
}

pub(crate) fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).unwrap()
}

/// Files and folders in a folder.
fn names(folder: &Path) -> Vec<std::ffi::OsString> {
    let mut names: Vec<_> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    names.sort();
    names
}

/// The good motion, the motor standing for a tenth of the cycle at each reversal.
pub(crate) fn sticking() -> Vec<Row> {
    let cycle = |phase: f64| {
        let (half, sign) = if phase < 0.5 { (phase, 1.0) } else { (phase - 0.5, -1.0) };
        sign * (PI * ((half - 0.05) / 0.45).max(0.0)).cos()
    };
    let mut rows = good();
    for row in &mut rows {
        let phase = (4.0 * row[0] / (2.0 * PI)).fract();
        row[2] = cycle(phase);
        row[3] = 1.02 * row[2];
    }
    rows
}
