"""The rows of a fleet."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from pathlib import Path as FilePath
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _lissom
from ._errors import InputError
from ._fleet_summary import FleetSummary
from ._result import Result
from ._tables import Path, path_text

if TYPE_CHECKING:
    import pandas as pd


class Fleet(Mapping[str, Any]):
    """The rows of a fleet, one for each log, in the order in which they were done: a mapping of columns to arrays.

    Columns are ``log``, ``machine``, ``time`` (UTC), ``failure`` and ``message`` (empty if the log was identified), ``effort``,
    ``refusals``, ``warnings`` and ``infos`` (codes of findings), ``seconds``, ``version``, ``input_sha256``, and each estimate
    with its standard error, as ``friction.coulomb [N·m]`` and ``friction.coulomb.std [N·m]``; NaN where it is refused. The
    unit may be left out if all logs have the same.

    Parameters
    ----------
    folder : path
        The folder into which `lissom.fleet`, or the command ``lissom fleet``, wrote. Its rows may become more: a new `Fleet`
        has them.

    Raises
    ------
    InputError
        If the folder is not that of a fleet.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = FilePath(path_text(folder))
        self._manifest: dict[str, Any] = json.loads(_lissom.fleet_manifest(self._folder))
        self._columns: dict[str, Any] | None = None

    @property
    def folder(self) -> FilePath:
        """The folder."""
        return self._folder

    @property
    def rows(self) -> int:
        """Number of rows."""
        return sum(part["rows"] for part in self._manifest["parts"])

    @property
    def failed(self) -> int:
        """Number of rows without a result."""
        return sum(part["failed"] for part in self._manifest["parts"])

    @property
    def files(self) -> tuple[FilePath, ...]:
        """The Parquet files that count: other programs read these."""
        return tuple(self._folder / part["file"] for part in self._manifest["parts"])

    def __getitem__(self, name: str) -> Any:
        columns = self._read()
        if name in columns:
            return columns[name]
        with_unit = [column for column in columns if column.startswith(f"{name} [")]
        if len(with_unit) > 1:
            raise KeyError(f"logs have {name} in several units: {', '.join(with_unit)}")
        return columns[with_unit[0] if with_unit else name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._read())

    def __len__(self) -> int:
        return len(self._read())

    def to_frame(self) -> pd.DataFrame:
        """Give the rows as a table of pandas.

        Returns
        -------
        pandas.DataFrame
            A row for each log.
        """
        import pandas as pd

        frame = pd.DataFrame(dict(self._read()))
        frame["time"] = pd.to_datetime(frame["time"], utc=True)
        return frame

    def summary(self, *, false_share: float = 0.05) -> FleetSummary:
        """Summarise the rows: distributions, logs and machines that differ, and drift over time.

        Parameters
        ----------
        false_share : float
            Share of the drifts, and of the outliers, that may be chance [1].

        Returns
        -------
        FleetSummary
            The summary.
        """
        if not 0 < false_share < 1:
            raise InputError(f"false_share is {false_share}; it must be between 0 and 1")
        return FleetSummary(_lissom.fleet_summary(self._folder, false_share), f"Fleet {self._folder}")

    def result(self, log: str) -> Result:
        """Give the whole result of a log, if the fleet keeps results.

        Parameters
        ----------
        log : str
            Name of the log, as in the column ``log``.

        Returns
        -------
        Result
            The result.

        Raises
        ------
        InputError
            If there is no such log, it has no result, or results were not kept.
        """
        columns = dict(_lissom.fleet_columns(self._folder, ["log", "result", "message"]))
        if "result" not in columns:
            raise InputError("this fleet does not keep results", "identify the log again, or the fleet with keep_results=True")
        names: list[str] = list(columns["log"])
        if log not in names:
            raise InputError(f"{log!r} is not a log of this fleet", "the column `log` has their names")
        row = names.index(log)
        text = columns["result"][row]
        if text is None:
            raise InputError(f"{log} has no result: {columns['message'][row]}")
        return Result(text.encode())

    def _read(self) -> dict[str, Any]:
        if self._columns is None:
            self._columns = {name: _array(values) for name, values in _lissom.fleet_columns(self._folder)}
        return self._columns

    def __repr__(self) -> str:
        return f"<Fleet of {self.rows} logs, {self.failed} without a result, in {str(self._folder)!r}>"


def _array(values: Any) -> Any:
    """Give a column as an array that cannot be changed."""
    if isinstance(values, list):
        array = np.array(["" if text is None else text for text in values], dtype=object)
    elif values.dtype == np.int64:
        array = values.view("datetime64[us]")
    else:
        array = values
    array.flags.writeable = False
    return array
