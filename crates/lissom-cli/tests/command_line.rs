//! The command's own pages: help, version, completions, manual.
#![expect(clippy::unwrap_used, reason = "tests")]

use std::process::Command;

/// Lines of a screen that help may take.
const SCREEN: usize = 60;

const SUBCOMMANDS: [&str; 17] = [
    "check",
    "export",
    "inspect",
    "init",
    "identify",
    "validate",
    "compare",
    "equivalent",
    "payload",
    "model",
    "plan",
    "rig",
    "figures",
    "thresholds",
    "demo",
    "completions",
    "man",
];

fn lissom(arguments: &[&str]) -> (Option<i32>, String, String) {
    let mut command = Command::new(assert_cmd::cargo::cargo_bin!("lissom"));
    let output = command.args(arguments).env("NO_COLOR", "1").output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

#[test]
fn each_help_fits_a_screen_and_has_an_example() {
    for subcommand in SUBCOMMANDS {
        let (code, help, _) = lissom(&[subcommand, "--help"]);
        assert_eq!(code, Some(0));
        let lines = help.lines().count();
        assert!(lines <= SCREEN, "lissom {subcommand} --help has {lines} lines");
        let example = format!("  lissom {subcommand} ");
        let alone = format!("  lissom {subcommand}\n");
        assert!(
            help.contains(&example) || help.contains(&alone) || help.ends_with(alone.trim_end()),
            "lissom {subcommand} --help shows no example:\n{help}"
        );
        for line in help.lines() {
            assert!(line.chars().count() <= 100, "lissom {subcommand} --help: {line}");
        }
    }
}

#[test]
fn the_list_of_subcommands_is_whole() {
    let (_, help, _) = lissom(&["--help"]);
    for subcommand in SUBCOMMANDS {
        assert!(help.contains(&format!("\n  {subcommand}  ")), "{subcommand} is not in\n{help}");
    }
    for code in ["0", "1", "2", "3", "4", "5", "130"] {
        assert!(help.contains(&format!("  {code} ")), "exit code {code} is not in\n{help}");
    }
}

#[test]
fn the_version_is_that_of_the_package() {
    let (code, version, _) = lissom(&["--version"]);
    assert_eq!(code, Some(0));
    assert!(version.starts_with(concat!("lissom ", env!("CARGO_PKG_VERSION"))), "{version}");
}

#[test]
fn every_shell_has_completions_of_every_subcommand() {
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let (code, script, _) = lissom(&["completions", shell]);
        assert_eq!(code, Some(0));
        for subcommand in SUBCOMMANDS {
            assert!(script.contains(subcommand), "{shell} does not complete {subcommand}");
        }
    }
}

#[test]
fn every_subcommand_has_a_manual_page() {
    let place = tempfile::tempdir().unwrap();
    let folder = place.path().join("man1"); // made where it is missing
    let (code, ..) = lissom(&["man", folder.to_str().unwrap()]);
    assert_eq!(code, Some(0));
    for subcommand in SUBCOMMANDS {
        let page = folder.join(format!("lissom-{subcommand}.1"));
        let text = std::fs::read_to_string(&page).unwrap();
        assert!(text.contains(".SH SYNOPSIS"), "{}", page.display());
    }
    assert!(folder.join("lissom.1").exists());
}

#[test]
fn without_a_terminal_or_with_no_color_nothing_is_coloured() {
    for arguments in
        [&["--help"][..], &["identify"], &["no-such"], &["identify", "no/campaign.toml"]]
    {
        let (_, out, err) = lissom(arguments);
        assert!(!out.contains('\u{1b}') && !err.contains('\u{1b}'), "{arguments:?}: {out}{err}");
    }
}
