//! A page of the documents as steps.

use std::ops::Range;

/// A page, cut into lines, and what it does.
pub(crate) struct Page<'t> {
    pub(crate) lines: Vec<&'t str>,
    pub(crate) steps: Vec<Step>,
}

/// One thing that a page does.
pub(crate) enum Step {
    /// A block with `<!-- file: NAME -->` before it.
    Write { file: String, text: String },
    /// A command of a console block.
    Run {
        /// Number of its line, from 1.
        line: usize,
        command: String,
        /// The lines of its output.
        lines: Range<usize>,
        /// Its exit code.
        exit: i32,
    },
    /// A command that is shown and not run.
    Show { line: usize, command: String },
}

impl<'t> Page<'t> {
    pub(crate) fn of(text: &'t str) -> Self {
        let lines: Vec<&str> = text.lines().collect();
        let mut steps = Vec::new();
        let (mut file, mut exit) = (None, 0);
        let mut at = 0;
        while at < lines.len() {
            let line = lines[at];
            file = comment(line, "file").map(str::to_owned).or(file);
            exit = comment(line, "exit").and_then(|code| code.parse().ok()).unwrap_or(exit);
            let Some(fence) = line.trim_start().strip_prefix("```") else {
                at += 1;
                continue;
            };
            let ticks = "`".repeat(3 + fence.chars().take_while(|c| *c == '`').count());
            let kind = fence.trim_start_matches('`');
            let first = at + 1;
            let closes = |line: &&str| line.trim() == ticks;
            let length = lines[first..].iter().position(closes).unwrap_or(lines.len() - first);
            let block = first..first + length;
            at = block.end + 1;
            if let Some(file) = file.take() {
                steps.push(Step::Write { file, text: lines[block.clone()].join("\n") + "\n" });
            }
            match kind {
                "console" => steps.extend(runs(&lines, block, std::mem::take(&mut exit))),
                "sh" | "bash" | "" => {
                    let commands = lines[block.clone()].iter().zip(block.start + 1..);
                    let commands =
                        commands.filter(|(l, _)| !l.trim().is_empty() && !l.starts_with('#'));
                    steps.extend(
                        commands.map(|(l, line)| Step::Show { line, command: l.to_string() }),
                    );
                }
                _ => {}
            }
        }
        Self { lines, steps }
    }

    /// The page with other lines at some places, in ascending order.
    pub(crate) fn with(&self, changed: &[(Range<usize>, Vec<String>)]) -> String {
        let mut text: Vec<String> = self.lines.iter().map(|&l| l.to_owned()).collect();
        for (lines, new) in changed.iter().rev() {
            text.splice(lines.clone(), new.iter().cloned());
        }
        text.join("\n") + "\n"
    }
}

/// What stands in `<!-- key: ... -->`.
fn comment<'l>(line: &'l str, key: &str) -> Option<&'l str> {
    let inner = line.trim().strip_prefix("<!--")?.strip_suffix("-->")?.trim();
    Some(inner.strip_prefix(key)?.strip_prefix(':')?.trim())
}

/// The commands of a console block; `exit` is the code of the last.
fn runs(lines: &[&str], block: Range<usize>, exit: i32) -> Vec<Step> {
    let starts: Vec<usize> = block.clone().filter(|&k| lines[k].starts_with("$ ")).collect();
    let ends = starts.iter().skip(1).copied().chain([block.end]);
    let of = |(&start, end): (&usize, usize)| {
        let mut command = lines[start][2..].to_owned();
        let mut output = start + 1;
        while command.ends_with('\\') && output < end {
            command.pop();
            command.push_str(lines[output]);
            output += 1;
        }
        let last = end == block.end;
        let blank = |k: &usize| lines[*k].trim().is_empty();
        let shown = (output..end).rev().find(|k| !blank(k)).map_or(output, |k| k + 1);
        let lines = output..shown;
        Step::Run { line: start + 1, command, lines, exit: if last { exit } else { 0 } }
    };
    starts.iter().zip(ends).map(of).collect()
}
