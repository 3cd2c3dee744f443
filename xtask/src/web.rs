//! The scripts of the report page and of lissom studio: built as they are committed, and tested in a browser.

use std::{env, path::Path, process::Command};

use crate::step::{Failure, cargo, folder, run, target_folder};

/// Checks the committed scripts, and runs the tests in Chromium: `CHROMIUM` names another program than Debian's.
pub(crate) fn test(root: &Path) -> Result<(), Failure> {
    let web = root.join("web");
    let in_web = |program: &str, args: &[&str]| {
        let mut command = Command::new(program);
        command.args(args).current_dir(&web);
        command
    };
    run("packages of the scripts", &mut in_web("npm", &["ci", "--no-audit", "--no-fund"]))?;
    run("types of the scripts", &mut in_web("npm", &["run", "--silent", "check"]))?;
    run("scripts as committed", &mut in_web("node", &["build.mjs", "--check"]))?;

    // The program that the tests of the workspace run, with their features: after these nothing is left to build.
    let program = ["--workspace", "--features", "lissom-io/schema", "--no-run", "--test"];
    run("the program", cargo(root, &["test"]).args(program).arg("command_line"))?;
    let target = target_folder(root);
    let program = target.join("debug").join("lissom").with_extension(env::consts::EXE_EXTENSION);
    let demo = folder(root, "web-demo")?;
    let mut write = Command::new(&program);
    run("a page to test", write.args(["demo", "--out"]).arg(&demo))?;
    let mut tests = in_web("npm", &["test", "--silent"]);
    tests.env("LISSOM", &program).env("LISSOM_PAGE", demo.join("report.html"));
    run("tests in a browser", &mut tests)
}
