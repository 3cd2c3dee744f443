"""Summary of a fleet: distributions, outliers and drift."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime, timedelta, timezone
from typing import Any

from . import _lissom
from ._files import write_whole
from ._tables import Path

_EPOCH = datetime(1970, 1, 1, tzinfo=timezone.utc)


@dataclass(frozen=True)
class Drift:
    """A parameter of a machine that changes over time.

    Parameters
    ----------
    machine : str
        The machine.
    level : float
        Value of the robust line in the middle, in the unit of the parameter.
    change : float
        Change from the first log to the last.
    change_std : float
        Its standard error.
    relative_change : float or None
        The change over the level.
    z : float
        The change over its standard error, compared with the other machines.
    times : tuple of datetime
        Times of its logs.
    values : tuple of float
        Values of its logs.
    stds : tuple of float
        Their standard errors.
    logs : tuple of str
        Names of its logs.
    """

    machine: str
    level: float
    change: float
    change_std: float
    relative_change: float | None
    z: float
    times: tuple[datetime, ...]
    values: tuple[float, ...]
    stds: tuple[float, ...]
    logs: tuple[str, ...]


@dataclass(frozen=True)
class Outlier:
    """A log that differs from the other logs of its machine, or a machine that differs from the others.

    Parameters
    ----------
    name : str
        The log, or the machine.
    machine : str or None
        The machine.
    value : float
        Its value, in the unit of the parameter.
    expected : float
        The value that the others let expect.
    z : float
        The deviation, in scales of the others.
    """

    name: str
    machine: str | None
    value: float
    expected: float
    z: float


@dataclass(frozen=True)
class ParameterSummary:
    """Summary of a parameter.

    Parameters
    ----------
    key : str
        Its key, with its unit.
    distribution : mapping of str to float
        ``logs``, ``refused``, ``median``, ``percent_5``, ``percent_95``, ``spread``, ``typical_std`` and others, in its unit.
    common_change : float or None
        Relative change of what all machines do, from the first log to the last; it is divided out before machines and logs are
        compared. None with less than 20 machines with three or more logs at known times.
    drifts : tuple of Drift
        Machines that drift, the largest changes first.
    outlying_machines : tuple of Outlier
        Machines that differ from the others.
    outlying_logs : tuple of Outlier
        Logs that differ.
    """

    key: str
    distribution: Mapping[str, float]
    common_change: float | None
    drifts: tuple[Drift, ...]
    outlying_machines: tuple[Outlier, ...]
    outlying_logs: tuple[Outlier, ...]


class FleetSummary:
    """Distributions of the parameters of a fleet, logs and machines that differ, and drift.

    Parameters
    ----------
    text : str
        The summary as JSON, as ``lissom fleet summary --json`` writes it.
    title : str
        What its page is called.
    """

    def __init__(self, text: str, title: str = "Fleet") -> None:
        self._text = text
        self._title = title
        self._content: dict[str, Any] = json.loads(text)

    @property
    def rows(self) -> int:
        """Number of logs."""
        return int(self._content["rows"])

    @property
    def identified(self) -> int:
        """Number of logs with a result."""
        return int(self._content["identified"])

    @property
    def machines(self) -> int:
        """Number of machines that are known."""
        return int(self._content["machines"])

    @property
    def failures(self) -> Mapping[str, int]:
        """Number of logs without a result, by the kind of failure."""
        return {entry["failure"]: entry["rows"] for entry in self._content["failures"]}

    @property
    def findings(self) -> Mapping[str, int]:
        """Number of logs with each refusal, warning and other finding, by its code."""
        counts: dict[str, int] = {}
        for entry in self._content["findings"]:
            counts[entry["code"]] = max(counts.get(entry["code"], 0), entry["rows"])
        return counts

    @property
    def parameters(self) -> Mapping[str, ParameterSummary]:
        """The parameters by their keys."""
        return {entry["key"]: _parameter(entry) for entry in self._content["parameters"]}

    def to_dict(self) -> dict[str, Any]:
        """Give the content of the JSON.

        Returns
        -------
        dict
            The content, new each time.
        """
        content: dict[str, Any] = json.loads(self._text)
        return content

    def report(self, path: Path) -> None:
        """Write a self-contained HTML page.

        Parameters
        ----------
        path : path
            The file.
        """
        write_whole(path, _lissom.fleet_page_of(self._title, self._text).encode())

    def __repr__(self) -> str:
        lines = [f"{self.identified} of {self.rows} logs identified, {self.machines} machines"]
        for key, parameter in self.parameters.items():
            spread = parameter.distribution
            line = f"{key}: median {spread['median']:.4g}, spread {spread['spread']:.2g}"
            counts = {
                "drifts": parameter.drifts,
                "outlying machines": parameter.outlying_machines,
                "outlying logs": parameter.outlying_logs,
            }
            line += "".join(f", {len(found)} {what}" for what, found in counts.items() if found)
            lines.append(line)
        return "\n".join(lines)


def _time(microseconds: int) -> datetime:
    return _EPOCH + timedelta(microseconds=microseconds)


def _parameter(entry: dict[str, Any]) -> ParameterSummary:
    distribution = {key: value for key, value in entry["distribution"].items() if key != "histogram"}
    return ParameterSummary(
        entry["key"],
        distribution,
        entry["common_change"],
        tuple(_drift(drift) for drift in entry["drifts"]),
        tuple(
            Outlier(found["machine"], found["machine"], found["value"], found["expected"], found["z"])
            for found in entry["outlying_machines"]
        ),
        tuple(
            Outlier(found["log"], found["machine"], found["value"], found["expected"], found["z"])
            for found in entry["outlying_logs"]
        ),
    )


def _drift(entry: dict[str, Any]) -> Drift:
    values = entry["values"]
    return Drift(
        entry["machine"],
        entry["level"],
        entry["change"],
        entry["change_std"],
        entry["relative_change"],
        entry["z"],
        tuple(_time(value["time_us"]) for value in values),
        tuple(value["value"] for value in values),
        tuple(value["std"] for value in values),
        tuple(value["log"] for value in values),
    )
