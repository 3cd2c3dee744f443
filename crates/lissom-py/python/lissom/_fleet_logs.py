"""The logs of a fleet: files, folders, addresses, tables in memory, or a table of logs."""

from __future__ import annotations

import glob
import hashlib
import json
import os
from collections.abc import Iterable, Mapping, Sequence
from datetime import datetime, timezone
from typing import Any

import numpy as np

from . import _lissom
from ._errors import FileError, InputError, LissomError
from ._tables import Log, _array, _is_missing, _kind, _series, columns, is_path, path_text

#: Stands between the protocol and the rest of an address.
_PROTOCOL = "://"
#: Characters that make a path a pattern of paths.
_GLOB = "*?["
#: Columns of a table of logs.
_LOG, _MACHINE, _TIME = "log", "machine", "time"


class FleetLogs:
    """Logs with their machines and times, and those that are tables in memory.

    Parameters
    ----------
    entries : list of dict
        Name, file, machine and time of each log.
    tables : mapping of str to Log
        The logs in memory, by name.
    """

    def __init__(self, entries: list[dict[str, Any]], tables: Mapping[str, Log]) -> None:
        self.entries = entries
        self.tables = tables

    @classmethod
    def of(
        cls,
        logs: Any,
        pattern: str | None,
        except_: Sequence[str],
        options: Mapping[str, Any],
        run_files: list[str] | None = None,
    ) -> FleetLogs:
        """List the logs.

        Parameters
        ----------
        logs : path, table or iterable
            What the user gave.
        pattern : str or None
            What the end of a name says, as ``"{machine}/{time}.csv"``.
        except_ : sequence of str
            Paths that are no logs.
        options : mapping
            Options of the file system for addresses.
        run_files : list of str, optional
            Files of a log that is a folder; each log is a file if absent.

        Returns
        -------
        FleetLogs
            The logs.
        """
        tables: dict[str, Log] = {}
        if _is_table_of_logs(logs):
            entries = _of_table(logs)
        elif isinstance(logs, Mapping):
            for name, log in logs.items():
                if is_path(log) and is_address(path_text(log)):
                    raise InputError(
                        f"{name}: {path_text(log)} is an address, which is its own name",
                        "give a list of addresses, or a table with the columns log and machine",
                    )
            tables = {str(name): log for name, log in logs.items() if not is_path(log)}
            entries = [_entry(str(name), path_text(log) if is_path(log) else None) for name, log in logs.items()]
        else:
            entries = []
            alone = is_path(logs)
            for log in [logs] if alone else _items(logs):
                if is_path(log):
                    entries += _of_path(path_text(log), except_, options, pattern, alone, run_files)
                else:
                    name = f"table {len(entries) + 1} ({_digest(log, len(entries) + 1)})"
                    tables[name] = log
                    entries.append(_entry(name))
        if tables and run_files is not None:
            raise InputError("tables in memory are not in folders", "give folders or addresses, or leave out by_folder")
        if pattern is not None:
            entries = json.loads(_lissom.fleet_pattern(json.dumps(entries), pattern, False))
        names = {entry["log"] for entry in entries}
        if len(names) < len(entries) and tables:
            raise InputError("two logs have the same name", "give each a name of its own: a mapping of names to logs")
        if not entries:
            raise InputError("there are no logs", "give a folder, an address, or a list of logs")
        return cls(entries, tables)


def is_address(name: str) -> bool:
    """Whether a log is not a file of this machine.

    Parameters
    ----------
    name : str
        Its name.

    Returns
    -------
    bool
        Whether it is an address, as ``s3://bucket/log.csv``.
    """
    return _PROTOCOL in name


def file_system(address: str, options: Mapping[str, Any]) -> tuple[Any, str]:
    """Give the file system of an address, and the path in it.

    Parameters
    ----------
    address : str
        The address.
    options : mapping
        Options of the file system.

    Returns
    -------
    tuple
        A file system of fsspec, and a path.
    """
    try:
        import fsspec  # type: ignore[import-untyped,unused-ignore]
    except ImportError:
        raise LissomError(f"{address} is read with fsspec, which is not installed", "pip install fsspec") from None
    try:
        system, path = fsspec.core.url_to_fs(address, **options)
    except (ImportError, ValueError) as error:
        raise LissomError(f"{address}: {error}", "check the protocol, and install its package: s3fs for s3://") from error
    return system, path


def _items(logs: Any) -> Iterable[Any]:
    if not isinstance(logs, Iterable) or hasattr(logs, "__arrow_c_stream__") or isinstance(logs, np.ndarray):
        raise InputError(
            "logs is a path, a list of logs, a mapping of names to logs, or a table with a column `log`",
            "give one log as a list: [log]",
        )
    return logs


def _digest(log: Any, number: int) -> str:
    """Give digits that stand for the values of a table: another table gets another row."""
    digest = hashlib.sha256()
    for name, values in columns(log, f"table {number}"):
        array = np.asarray(values)
        digest.update(name.encode())
        digest.update(repr(array.tolist()).encode() if array.dtype == object else array.tobytes())
    return digest.hexdigest()[:8]


def _entry(name: str, file: str | None = None) -> dict[str, Any]:
    return {"log": name, "file": file, "machine": None, "time_us": None}


def _of_path(
    path: str,
    except_: Sequence[str],
    options: Mapping[str, Any],
    pattern: str | None,
    alone: bool,
    run_files: list[str] | None,
) -> list[dict[str, Any]]:
    """Give the logs of a path. One in a list that is no folder is a log as it stands: a worker may have it."""
    is_glob = any(character in path for character in _GLOB) and not os.path.exists(path)
    is_folder = os.path.exists(path) or (is_address(path) and path.endswith("/"))
    if not alone and not is_glob and not is_folder:
        return [_entry(path if is_address(path) else os.path.abspath(path))]
    if is_address(path):
        return _among([_entry(address) for address in _of_address(path, options, run_files)], pattern)
    paths = [path]
    if is_glob:
        found = sorted(glob.glob(path, recursive=True))
        if not found:
            raise FileError(f"{path}: no file has this form", "check the folder")
        if run_files is None:
            files = [file for file in found if os.path.isfile(file)]
            return _among([_entry(os.path.abspath(file)) for file in files], pattern)
        paths = [folder for folder in found if os.path.isdir(folder) and not _is_among(folder, except_)]
    elif not os.path.exists(path) and "::" not in path:
        raise FileError(f"{path}: there is no such file or folder", "check the name")
    return list(json.loads(_lissom.fleet_logs(paths, list(except_), pattern, run_files)))


def _is_among(path: str, others: Sequence[str]) -> bool:
    return os.path.realpath(path) in map(os.path.realpath, others)


def _among(entries: list[dict[str, Any]], pattern: str | None) -> list[dict[str, Any]]:
    """Leave out what does not end like the pattern."""
    if pattern is None:
        return entries
    found: list[dict[str, Any]] = json.loads(_lissom.fleet_pattern(json.dumps(entries), pattern, True))
    if not found:
        raise InputError(f"none of {len(entries)} logs ends like {pattern!r}", "correct the pattern")
    return found


def _of_address(address: str, options: Mapping[str, Any], run_files: list[str] | None) -> list[str]:
    system, path = file_system(address, options)
    try:
        if any(character in path for character in _GLOB):
            if run_files is not None:
                # All files in the folders that have this form.
                path = path.rstrip("/") + "/**"
            found = [file for file, kind in system.glob(path, detail=True).items() if kind["type"] == "file"]
        else:
            found = list(system.find(path))
    except Exception as error:
        raise FileError(
            f"{address}: {error or type(error).__name__}", "check the address, the network and your rights"
        ) from error
    if not found:
        raise FileError(f"{address}: there are no logs", "check the address")
    files = [str(system.unstrip_protocol(file)) for file in sorted(found)]
    return files if run_files is None else _lissom.fleet_folders(address, files, run_files)


def _is_table_of_logs(logs: Any) -> bool:
    if isinstance(logs, Mapping):
        return _LOG in logs and not is_path(logs[_LOG]) and not isinstance(logs[_LOG], Mapping)
    names = getattr(logs, "columns", None) if hasattr(logs, "__arrow_c_stream__") or hasattr(logs, "iloc") else None
    return names is not None and _LOG in list(names)


def _of_table(table: Any) -> list[dict[str, Any]]:
    found = dict(_series(table, "table of logs"))
    names = [None if _is_missing(name) else name for name in _array(found[_LOG])]
    rows = len(names)
    machines = _column(found.get(_MACHINE), rows, _MACHINE)
    times = _column(found.get(_TIME), rows, _TIME)
    entries = []
    for row, (name, machine, time) in enumerate(zip(names, machines, times, strict=True), start=1):
        if name is None or not is_path(name):
            raise InputError(f"table of logs, row {row}: {name!r} is no path", "give paths in the column `log`")
        path = path_text(name)
        entry = _entry(path if is_address(path) else os.path.abspath(path))
        # A column of whole numbers in which one is missing has floats.
        whole = isinstance(machine, float) and machine.is_integer()
        entry["machine"] = None if machine is None else str(int(machine) if whole else machine)
        entry["time_us"] = None if time is None else _microseconds(time, row)
        entries.append(entry)
    return entries


def _column(values: Any, rows: int, name: str) -> list[Any]:
    if values is None:
        return [None] * rows
    array = _array(values)
    if _kind(array) == "M":
        array = array.astype("datetime64[us]")
    column = [None if _is_missing(value) else value for value in array]
    if len(column) != rows:
        raise InputError(f"table of logs: `{name}` has {len(column)} rows, and `{_LOG}` {rows}")
    return column


def _microseconds(time: Any, row: int) -> int:
    if isinstance(time, np.datetime64):
        return int(time.astype("datetime64[us]").astype(np.int64))
    if isinstance(time, datetime):
        zoned = time if time.tzinfo is not None else time.replace(tzinfo=timezone.utc)
        return round(zoned.timestamp() * 1e6)
    found = _lissom.fleet_time(str(time))
    if found is None:
        raise InputError(
            f"table of logs, row {row}: {str(time)!r} is not a time", "give dates, or texts as 2026-11-27T08:15:00Z"
        )
    return found
