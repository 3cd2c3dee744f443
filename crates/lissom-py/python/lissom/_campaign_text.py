"""The text of a campaign.toml."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any, cast

from ._tables import Log, is_path, path_text
from ._toml import toml


def campaign_text(
    tables: Mapping[str, Mapping[str, object]], logs: Sequence[tuple[str, Log]], moved: Callable[[str], str] = str
) -> str:
    """Write a campaign.toml.

    Parameters
    ----------
    tables : mapping of str to mapping
        Its tables, except the runs.
    logs : sequence of tuple
        Names and logs of the runs. Tables in memory have the file names of `memory_name`.
    moved : callable, optional
        Gives a path as it is to be written.

    Returns
    -------
    str
        The text.
    """
    lines = []
    for table, content in tables.items():
        lines.append(f"[{table}]")
        lines += [f"{key} = {toml(_with_paths(key, value, moved))}" for key, value in content.items()]
    for place, (name, log) in enumerate(logs):
        path = path_text(log) if is_path(log) else memory_name(place)
        lines += ["[[runs]]", f"file = {toml(moved(path) if is_path(log) else path)}"]
        if name != path:
            lines.append(f"name = {toml(name)}")
    return "\n".join(lines) + "\n"


def with_paths(text: str, moved: Callable[[str], str]) -> str:
    """Give the text of a campaign.toml with other paths of its logs.

    Parameters
    ----------
    text : str
        The text, as `lissom init` writes it.
    moved : callable
        Gives a path as it is to be written.

    Returns
    -------
    str
        The text.
    """

    def written(found: re.Match[str]) -> str:
        path = found[2] if found[1] is None else json.loads(found[1])
        return f"file = {toml(moved(path))}"

    return re.sub(r"""\bfile = (?:("(?:[^"\\]|\\.)*")|'([^']*)')""", written, text)


def with_runs(text: str, logs: Sequence[tuple[str, Log]]) -> str:
    """Give the text of a campaign.toml with other runs.

    Parameters
    ----------
    text : str
        The text, as `lissom init` writes it: the runs are its end.
    logs : sequence of tuple
        Names and logs of the runs.

    Returns
    -------
    str
        The text.
    """
    return text.partition("\n[[runs]]\n")[0] + "\n" + campaign_text({}, logs)


def memory_name(place: int) -> str:
    """Give the file name of a table in memory in the text of a campaign; no file is called so.

    Parameters
    ----------
    place : int
        Place of the run, from 0.

    Returns
    -------
    str
        The name.
    """
    return f"\u2060table {place + 1}"


def columns_of(signals: Mapping[str, Any]) -> set[str | int]:
    """Give the columns that the signals of a campaign name in its logs.

    Parameters
    ----------
    signals : mapping
        The table [signals].

    Returns
    -------
    set of str or int
        Names and numbers of columns.
    """
    entries = [value for value in signals.values() if isinstance(value, dict)] + list(signals.get("tips", []))
    wanted = {entry["column"] for entry in entries if "file" not in entry}
    return wanted | ({signals["run"]} if "run" in signals else set())


def has_own_logs(tables: Mapping[str, Mapping[str, Any]]) -> bool:
    """Whether a signal is in a file of its own, or an arm.toml is compared.

    Parameters
    ----------
    tables : mapping of str to mapping
        Tables of a campaign.toml.

    Returns
    -------
    bool
        Whether a file is read in addition to the logs of the runs; also for a text that is not known.
    """
    signals = tables.get("signals")
    if signals is None or "arm" in tables.get("drive", {}):
        return True
    entries = [value for value in signals.values() if isinstance(value, dict)] + list(signals.get("tips", []))
    return any("file" in entry for entry in entries)


def _with_paths(key: str, value: object, moved: Callable[[str], str]) -> object:
    """Give a value with its paths as they are to be written: those of signals, and of an arm.toml."""
    if isinstance(value, dict):
        return {inner: _with_paths(inner, item, moved) for inner, item in value.items()}
    if isinstance(value, list):
        return [_with_paths(key, item, moved) for item in value]
    return moved(os.fspath(cast("str", value))) if key in ("file", "arm") else value
