"""Logs as files or as tables in memory."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping, Sequence
from datetime import datetime
from typing import TYPE_CHECKING, Any, Protocol, TypeAlias, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._errors import InputError

if TYPE_CHECKING:
    from ._lissom import _Columns as Columns


class Frame(Protocol):
    """A table of pandas, polars or pyarrow."""

    def __arrow_c_stream__(self, requested_schema: object | None = None) -> object:
        """Give the table as a stream of Arrow."""


Path: TypeAlias = str | os.PathLike[str]
#: A log: a path, a table of pandas, polars or pyarrow, or columns by name.
Log: TypeAlias = Path | Frame | Mapping[str, ArrayLike]


def is_path(log: object) -> bool:
    """Whether a log is a file.

    Parameters
    ----------
    log : Log
        A log.

    Returns
    -------
    bool
        Whether it is a path.
    """
    return isinstance(log, (str, os.PathLike))


def columns(log: Log, what: str) -> Columns:
    """Give the columns of a table: float64 arrays, or lists of words.

    Parameters
    ----------
    log : Log
        A table in memory.
    what : str
        What errors call it.

    Returns
    -------
    list of tuple
        Name and values of each column.
    """
    named = list(_series(log, what))
    if not named:
        raise InputError(f"{what}: the table has no columns")
    made = [(name, _values(values, f'{what}: column "{name}"')) for name, values in named]
    lengths = {name: len(values) for name, values in made}
    if len(set(lengths.values())) > 1:
        listed = ", ".join(f'"{name}" {rows}' for name, rows in lengths.items())
        raise InputError(
            f"{what}: columns have different numbers of rows: {listed}",
            "give signals with another clock as a log of their own: Signal(..., file=...)",
        )
    return made


def _series(log: Any, what: str) -> list[tuple[str, Any]]:
    if isinstance(log, Mapping):
        return [(str(name), values) for name, values in log.items()]
    if isinstance(log, np.ndarray):
        if log.dtype.names:
            return [(name, log[name]) for name in log.dtype.names]
        if log.ndim == 2:
            return [(str(k + 1), log[:, k]) for k in range(log.shape[1])]
        raise InputError(f"{what}: an array of a log has two dimensions, not {log.ndim}")
    if hasattr(log, "columns") and hasattr(log, "__getitem__"):
        return _of_frame(log, what)
    if hasattr(log, "__arrow_c_stream__"):
        try:
            import pyarrow  # type: ignore[import-untyped,unused-ignore]
        except ImportError:
            raise InputError(
                f"{what}: a {type(log).__name__} is read with pyarrow, which is not installed",
                "pip install pyarrow, or give a mapping of names to arrays",
            ) from None
        return _of_frame(pyarrow.table(log), what)
    raise InputError(
        f"{what}: a {type(log).__name__} is not a log",
        "give a path, a table of pandas, polars or pyarrow, or a mapping of names to arrays",
    )


def _of_frame(frame: Any, what: str) -> list[tuple[str, Any]]:
    names = getattr(frame, "column_names", None) or list(frame.columns)
    names = [str(name) for name in names]
    twice = {name for name in names if names.count(name) > 1}
    if twice:
        raise InputError(f"{what}: several columns are called {', '.join(sorted(twice))}")
    series = [(name, frame[name]) for name in names] if names else []
    # The index of pandas has the time if it has a name or is one of times.
    index = getattr(frame, "index", None)
    if index is not None and not callable(index):
        is_time = np.asarray(index).dtype.kind in "mM"
        if (getattr(index, "name", None) is not None or is_time) and getattr(index, "nlevels", 1) == 1:
            name = str(index.name) if index.name is not None else "time"
            if name not in names:
                series.insert(0, (name, index))
    return series


def _values(values: Any, what: str) -> NDArray[np.float64] | list[str]:
    """Give numbers as float64 with NaN where a value is missing, times in seconds, or words."""
    if isinstance(values, np.ma.MaskedArray):
        values = np.ma.filled(values.astype(np.float64), np.nan)
    if getattr(getattr(values, "dtype", None), "tz", None) is not None and hasattr(values, "tz_convert"):
        values = values.dt.tz_convert(None) if hasattr(values, "dt") else values.tz_convert(None)
    if hasattr(values, "to_numpy") and not isinstance(values, np.ndarray):
        values = values.to_numpy()
    array = np.asarray(values)
    if array.ndim != 1:
        raise InputError(f"{what} has {array.ndim} dimensions, not one")
    kind = array.dtype.kind
    if kind in "mM":
        return _seconds(array)
    if kind in "fiub":
        return np.ascontiguousarray(array, dtype=np.float64)
    if kind == "c":
        raise InputError(f"{what} is complex", "give a real column")
    if kind == "U" or kind == "T":
        return [str(word) for word in array]
    if kind == "O":
        return _of_objects(array, what)
    raise InputError(f"{what} has the type {array.dtype}, which is no number")


def _seconds(array: NDArray[Any]) -> NDArray[np.float64]:
    """Give times in seconds from the first one, exactly to the nanosecond."""
    fine = array.astype("datetime64[ns]" if array.dtype.kind == "M" else "timedelta64[ns]")
    missing = np.isnat(fine)
    first = fine[~missing][0] if (~missing).any() else fine[:0]
    steps = (fine - first) if fine.dtype.kind == "M" else fine
    seconds = steps.astype(np.int64) * 1e-9
    seconds[missing] = np.nan
    return cast("NDArray[np.float64]", seconds)


def _of_objects(array: NDArray[Any], what: str) -> NDArray[np.float64] | list[str]:
    missing = [_is_missing(value) for value in array]
    there = [value for value, gone in zip(array, missing, strict=True) if not gone]
    if there and all(isinstance(value, str) for value in there):
        return ["" if gone else value for value, gone in zip(array, missing, strict=True)]
    if there and all(isinstance(value, datetime) for value in there):
        since = [
            math.nan if gone else (value - there[0]).total_seconds() for value, gone in zip(array, missing, strict=True)
        ]
        return np.array(since)
    numbers = np.full(len(array), np.nan)
    for row, (value, gone) in enumerate(zip(array, missing, strict=True)):
        if gone:
            continue
        try:
            numbers[row] = float(value)
        except (TypeError, ValueError):
            raise InputError(
                f"{what}, row {row + 1}: {value!r} is no number", "convert the column, or leave it out"
            ) from None
    return numbers


def _is_missing(value: object) -> bool:
    """Whether a value is None, NaN, or the missing value of pandas."""
    return (
        value is None
        or type(value).__name__ in ("NAType", "NaTType")
        or (isinstance(value, float) and math.isnan(value))
    )


def several(runs: Log | Sequence[Log]) -> list[Log]:
    """Give one or several logs as a list.

    Parameters
    ----------
    runs : Log or sequence of Log
        Logs.

    Returns
    -------
    list of Log
        At least one log.
    """
    if isinstance(runs, (list, tuple)):
        if not runs:
            raise InputError("no run is given")
        return list(runs)
    return [cast("Log", runs)]
