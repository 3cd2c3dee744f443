"""Logs with the names of their runs."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ._errors import InputError
from ._tables import Log, is_path, path_text, several


def named(runs: Any) -> list[tuple[str, Log]]:
    """Give the logs with their names. A mapping of names to arrays is one log, one to logs are several.

    Parameters
    ----------
    runs : Log, sequence of Log, or mapping of str to Log
        The logs.

    Returns
    -------
    list of tuple
        Name and log of each run.
    """
    if isinstance(runs, Mapping):
        values = list(runs.values())
        if values and all(is_path(log) or isinstance(log, Mapping) or hasattr(log, "columns") for log in values):
            names = [str(name) for name in runs]
            twice = next((name for name in names if names.count(name) > 1), None)
            if twice is not None:
                raise InputError(f"two runs are called {twice!r}")
            return list(zip(names, values, strict=True))
    logs = several(runs)
    tables = sum(not is_path(log) for log in logs)
    names, count = [], 0
    for log in logs:
        if is_path(log):
            names.append(path_text(log))
        else:
            count += 1
            names.append("table" if tables == 1 else f"table {count}")
    return list(zip(names, logs, strict=True))
