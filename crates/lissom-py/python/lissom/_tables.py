"""Logs as files or as tables in memory."""

from __future__ import annotations

import math
import os
from collections.abc import Collection, Mapping, Sequence
from datetime import datetime, timedelta
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


def path_text(log: Any) -> str:
    """Give a path as a text.

    Parameters
    ----------
    log : path
        A path.

    Returns
    -------
    str
        Its text.
    """
    return os.fsdecode(os.fspath(log))


def columns(log: Log, what: str, wanted: Collection[str | int] = ()) -> Columns:
    """Give the columns of a table: float64 arrays, or lists of words.

    Parameters
    ----------
    log : Log
        A table in memory.
    what : str
        What errors call it.
    wanted : collection of str or int
        Names and numbers, from 1, of the columns that are used. The others may be of any kind; all are used if it is empty.

    Returns
    -------
    list of tuple
        Name and values of each column.
    """
    named = _series(log, what)
    if not named:
        raise InputError(f"{what}: the table has no columns")
    names = [name for name, _ in named]
    for name in names:
        text(name)
        if names.count(name) > 1 and (name in wanted or not wanted):
            raise InputError(f"{what}: several columns are called {name}")
    made: list[tuple[str, NDArray[np.float64] | list[str] | None]] = []
    for number, (name, values) in enumerate(named, start=1):
        if not wanted or name in wanted or number in wanted or str(number) in wanted:
            made.append((name, _values(values, f'{what}: column "{name}"')))
        else:
            made.append((name, None))
    lengths = {name: len(values) for name, values in made if values is not None}
    if len(set(lengths.values())) > 1:
        listed = ", ".join(f'"{name}" {rows}' for name, rows in lengths.items())
        raise InputError(
            f"{what}: columns have different numbers of rows: {listed}",
            "give signals with another clock as a log of their own: Signal(..., file=...)",
        )
    # A column that is not used keeps its place, for columns that are given by their number.
    rows = next(iter(lengths.values()), 0)
    return [(name, np.full(rows, np.nan) if values is None else values) for name, values in made]


def is_time(log: Any, column: str | int) -> bool:
    """Whether a column of a table has dates or durations, which are converted to seconds.

    Parameters
    ----------
    log : Log
        A table in memory.
    column : str or int
        Its name, or its number from 1.

    Returns
    -------
    bool
        Whether it has.
    """
    for number, (name, values) in enumerate(_series(log, "table"), start=1):
        if column in (name, number):
            return _kind(_array(values)) in "mMt"
    return False


def text(name: str) -> str:
    """Refuse a name that no file can contain.

    Parameters
    ----------
    name : str
        A name.

    Returns
    -------
    str
        The name.
    """
    try:
        name.encode()
    except UnicodeEncodeError:
        raise InputError(f"a text has characters that no file can contain: {name!r}") from None
    return name


def _series(log: Any, what: str) -> list[tuple[str, Any]]:
    if isinstance(log, Mapping):
        return [(str(name), values) for name, values in log.items()]
    if isinstance(log, np.ndarray):
        if log.dtype.names:
            return [(name, log[name]) for name in log.dtype.names]
        if log.ndim == 2:
            return [(str(k + 1), log[:, k]) for k in range(log.shape[1])]
        raise InputError(f"{what}: an array of a log has two dimensions, not {log.ndim}")
    kind = f"{type(log).__module__}.{type(log).__name__}"
    if hasattr(log, "collect"):
        raise InputError(f"{what}: a {kind} has no values yet", "give what its method collect() gives")
    if hasattr(log, "iloc") and hasattr(log, "columns"):
        return _of_pandas(log)
    if hasattr(log, "column_names") and hasattr(log, "column"):
        return [(str(name), log.column(k)) for k, name in enumerate(log.column_names)]
    if hasattr(log, "columns") and hasattr(log, "get_columns"):
        return [(column.name, column) for column in log.get_columns()]
    if hasattr(log, "__arrow_c_stream__") and not hasattr(log, "to_frame"):
        try:
            import pyarrow  # type: ignore[import-untyped,unused-ignore]
        except ImportError:
            raise InputError(
                f"{what}: a {kind} is read with pyarrow, which is not installed",
                "pip install pyarrow, or give a mapping of names to arrays",
            ) from None
        return _series(pyarrow.table(log), what)
    raise InputError(
        f"{what}: a {type(log).__name__} is not a log",
        "give a path, a table of pandas, polars or pyarrow, or a mapping of names to arrays",
    )


def _of_pandas(frame: Any) -> list[tuple[str, Any]]:
    names = [str(name) for name in frame.columns]
    series = [(name, frame.iloc[:, k]) for k, name in enumerate(names)]
    # The index is a further column, the last one, if it has a name or is one of times.
    index = frame.index
    if getattr(index, "nlevels", 1) == 1:
        times = _kind(_array(index)) in "mMt"
        name = str(index.name) if index.name is not None else "time"
        if (index.name is not None or times) and name not in names:
            series.append((name, index))
    return series


def _array(values: Any) -> NDArray[Any]:
    """Give a column as an array; times with a zone in universal time."""
    if getattr(getattr(values, "dtype", None), "tz", None) is not None and hasattr(values, "tz_convert"):
        values = values.dt.tz_convert(None) if hasattr(values, "dt") else values.tz_convert(None)
    if hasattr(values, "to_numpy") and not isinstance(values, np.ndarray):
        values = values.to_numpy()
    if not isinstance(values, np.ma.MaskedArray):
        try:
            values = np.asarray(values)
        except ValueError:
            values = np.asarray(values, dtype=object)
    return cast("NDArray[Any]", values)


def _kind(array: NDArray[Any]) -> str:
    """Give the kind of the values: that of numpy, ``t`` for objects that are dates or durations."""
    if array.dtype.kind != "O":
        return array.dtype.kind
    there = [value for value in array.ravel() if not _is_missing(value)]
    kinds = (datetime, timedelta, np.datetime64, np.timedelta64)
    return "t" if there and all(isinstance(value, kinds) for value in there) else "O"


def _values(values: Any, what: str) -> NDArray[np.float64] | list[str]:
    """Give numbers as float64 with NaN where a value is missing, times in seconds, or words."""
    array = _array(values)
    if array.ndim != 1:
        raise InputError(f"{what} has {array.ndim} dimensions, not one")
    masked = np.ma.getmaskarray(array) if isinstance(array, np.ma.MaskedArray) else None
    array = np.asarray(array)
    kind = _kind(array)
    if kind in "mM":
        numbers = _seconds(array, masked)
    elif kind == "t":
        numbers = _of_times(array, what)
    elif kind in "fiub":
        numbers = np.ascontiguousarray(array, dtype=np.float64)
    elif kind == "c":
        raise InputError(f"{what} is complex", "give a real column")
    elif kind in "UT":
        words = [str(word) for word in array]
        return words if masked is None else ["" if gone else word for word, gone in zip(words, masked, strict=True)]
    elif kind == "O":
        return _of_objects(array, what)
    else:
        raise InputError(f"{what} has the type {array.dtype}, which is no number")
    return numbers if masked is None else np.where(masked, np.nan, numbers)


def _seconds(array: NDArray[Any], masked: NDArray[np.bool_] | None = None) -> NDArray[np.float64]:
    """Give times in seconds from the first one, exactly to the nanosecond."""
    fine = array.astype("datetime64[ns]" if array.dtype.kind == "M" else "timedelta64[ns]")
    missing = np.isnat(fine) if masked is None else np.isnat(fine) | masked
    if missing.all():
        return np.full(len(fine), np.nan)
    steps = fine - fine[~missing][0] if fine.dtype.kind == "M" else fine
    seconds = steps.astype(np.int64) * 1e-9
    return np.where(missing, np.nan, seconds)


def _of_times(array: NDArray[Any], what: str) -> NDArray[np.float64]:
    """Give objects that are dates or durations in seconds."""
    missing = [_is_missing(value) for value in array]
    there = [value for value, gone in zip(array, missing, strict=True) if not gone]
    if all(isinstance(value, (np.datetime64, np.timedelta64)) for value in there):
        nothing = type(there[0])("NaT")
        return _seconds(np.array([nothing if gone else v for v, gone in zip(array, missing, strict=True)]))
    try:
        first = there[0] if isinstance(there[0], datetime) else timedelta(0)
        since = [math.nan if gone else (value - first).total_seconds() for value, gone in zip(array, missing, strict=True)]
    except TypeError as error:
        raise InputError(f"{what}: {error}", "give all times with a zone, or none") from None
    return np.array(since)


def _of_objects(array: NDArray[Any], what: str) -> NDArray[np.float64] | list[str]:
    missing = [_is_missing(value) for value in array]
    there = [value for value, gone in zip(array, missing, strict=True) if not gone]
    if there and all(isinstance(value, str) for value in there):
        return ["" if gone else value for value, gone in zip(array, missing, strict=True)]
    numbers = np.full(len(array), np.nan)
    for row, (value, gone) in enumerate(zip(array, missing, strict=True)):
        if gone:
            continue
        try:
            numbers[row] = float(value)
        except (TypeError, ValueError, OverflowError):
            raise InputError(f"{what}, row {row + 1}: {value!r} is no number", "convert the column, or leave it out") from None
    return numbers


def _is_missing(value: object) -> bool:
    """Whether a value is None, NaN, NaT, or the missing value of pandas."""
    if value is None or type(value).__name__ in ("NAType", "NaTType", "MaskedConstant"):
        return True
    if isinstance(value, (np.datetime64, np.timedelta64)):
        return bool(np.isnat(value))
    return isinstance(value, float) and math.isnan(value)


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
