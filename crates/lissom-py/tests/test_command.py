"""The command is in the package."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import lissom


def run(*arguments: str, folder: Path | None = None) -> subprocess.CompletedProcess[str]:
    """Runs the command."""
    command = [sys.executable, "-m", "lissom", *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False, cwd=folder)


def test_the_command_runs() -> None:
    assert lissom.__version__ in run("--version").stdout
    assert run("identify", "missing.toml").returncode == 1
    assert run("--nothing").returncode == 2
