//! A worker process, from outside.

use std::ffi::OsString;
use std::io::{self, BufRead as _, BufReader, Read};
use std::path::PathBuf;
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::thread;
use std::time::{Duration, Instant};

use super::message::{Answer, send};
use crate::fleet_error::FleetError;
use crate::fleet_log::FleetLog;
use crate::row::FleetRow;
use crate::settings::FleetSettings;
use crate::version::VERSION;

/// Time between two looks at whether the work is stopped.
const TICK: Duration = Duration::from_millis(50);
/// Time in which a worker process must start, also on a busy machine.
const START: Duration = Duration::from_secs(60);
/// Bytes of the worker's messages that are kept.
const MESSAGE_MOST: usize = 2000;

/// The program that is a worker process: it calls [`serve`](super::serve) with its standard input and output.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct WorkerProgram {
    /// The program.
    pub program: PathBuf,
    /// Its arguments.
    pub arguments: Vec<OsString>,
}

/// How a worker process treated a log.
pub(super) enum Treated {
    /// It gave a row.
    Row(Box<FleetRow>),
    /// It ended, with what it said last.
    Ended(String),
    /// It took too long.
    TooLong,
}

/// A worker process. It is ended when this is dropped.
pub(super) struct WorkerProcess {
    child: Child,
    input: ChildStdin,
    answers: Receiver<Answer>,
    messages: Receiver<String>,
}

impl WorkerProcess {
    /// Starts a process, and waits until it is ready.
    pub(super) fn start(
        program: &WorkerProgram,
        settings: &FleetSettings,
        stop: &AtomicBool,
    ) -> Result<Self, FleetError> {
        let failed = |source| FleetError::Worker { program: program.program.clone(), source };
        let mut command = Command::new(&program.program);
        // One log uses one core: the others have logs of their own.
        command.args(&program.arguments).env("RAYON_NUM_THREADS", "1");
        let piped = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = piped.spawn().map_err(failed)?;
        let (Some(input), Some(output), Some(errors)) =
            (child.stdin.take(), child.stdout.take(), child.stderr.take())
        else {
            return Err(failed(io::ErrorKind::BrokenPipe.into()));
        };
        let (answers, messages) = (answers(output), last_words(errors));
        let mut process = Self { child, input, answers, messages };
        // If the process has ended already, its answer says so.
        let _ = send(&mut process.input, settings);
        match process.next(START, stop)? {
            Ok(Answer::Ready { version }) if version == VERSION => Ok(process),
            Ok(Answer::Ready { version }) => Err(FleetError::Version { worker: version }),
            Ok(Answer::Row(_)) => Err(failed(io::ErrorKind::InvalidData.into())),
            Err(RecvTimeoutError::Timeout) => Err(failed(io::ErrorKind::TimedOut.into())),
            Err(RecvTimeoutError::Disconnected) => {
                Err(failed(io::Error::other(process.how_it_ended())))
            }
        }
    }

    /// Gives it a log, and waits for the row.
    pub(super) fn treat(
        &mut self,
        log: &FleetLog,
        limit: Duration,
        stop: &AtomicBool,
    ) -> Result<Treated, FleetError> {
        // If the process has ended, its answers end, too.
        let _ = send(&mut self.input, log);
        Ok(match self.next(limit, stop)? {
            Ok(Answer::Row(row)) => Treated::Row(row),
            Ok(Answer::Ready { .. }) | Err(RecvTimeoutError::Disconnected) => {
                Treated::Ended(self.how_it_ended())
            }
            Err(RecvTimeoutError::Timeout) => Treated::TooLong,
        })
    }

    /// The next answer; an error if the work is stopped.
    fn next(
        &self,
        limit: Duration,
        stop: &AtomicBool,
    ) -> Result<Result<Answer, RecvTimeoutError>, FleetError> {
        let started = Instant::now();
        loop {
            if stop.load(Ordering::Relaxed) {
                return Err(FleetError::Stopped);
            }
            let left = limit.saturating_sub(started.elapsed());
            match self.answers.recv_timeout(left.min(TICK)) {
                Err(RecvTimeoutError::Timeout) if !left.is_zero() => {}
                answer => return Ok(answer),
            }
        }
    }

    /// How the process ended, in words.
    fn how_it_ended(&mut self) -> String {
        let _ = self.child.kill();
        let status = self.child.wait().map_or_else(|e| e.to_string(), |status| status.to_string());
        let said = self.messages.recv_timeout(TICK).unwrap_or_default();
        let said = said.trim();
        if said.is_empty() { status } else { format!("{status}: {said}") }
    }
}

impl Drop for WorkerProcess {
    fn drop(&mut self) {
        // It may have ended already.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// The answers of a process, read in a thread of their own.
fn answers(output: impl Read + Send + 'static) -> Receiver<Answer> {
    let (send, answers) = mpsc::channel();
    thread::spawn(move || {
        for line in BufReader::new(output).lines() {
            let Some(answer) = line.ok().and_then(|line| serde_json::from_str(&line).ok()) else {
                return;
            };
            if send.send(answer).is_err() {
                return;
            }
        }
    });
    answers
}

/// The last words of a process on standard error, sent when it ends.
fn last_words(mut errors: impl Read + Send + 'static) -> Receiver<String> {
    let (send, messages) = mpsc::channel();
    thread::spawn(move || {
        let (mut kept, mut chunk) = (Vec::new(), [0; MESSAGE_MOST]);
        while let Ok(count @ 1..) = errors.read(&mut chunk) {
            kept.extend_from_slice(&chunk[..count]);
            let surplus = kept.len().saturating_sub(MESSAGE_MOST);
            kept.drain(..surplus);
        }
        // Nobody may be waiting.
        let _ = send.send(String::from_utf8_lossy(&kept).into_owned());
    });
    messages
}
