"""How the command is started in a process of its own."""

from __future__ import annotations

import sys
from pathlib import Path

from . import _lissom
from ._errors import LissomError


def own_command() -> list[str]:
    """Give the program and arguments that start the command.

    Returns
    -------
    list of str
        The program, and its arguments before those of the command.
    """
    if not sys.executable:
        raise LissomError("this Python has no program that could be started again", "run this in a Python of its own")
    process = Path(__file__).with_name("_command_process.py")
    return [sys.executable, "-I", "-S", str(process), str(_lissom.__file__)]
