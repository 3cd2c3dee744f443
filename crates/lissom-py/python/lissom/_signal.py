"""A signal of a log: its column and its unit."""

from __future__ import annotations

import os
import re
from dataclasses import dataclass
from numbers import Real
from typing import Literal, cast

from ._errors import InputError


@dataclass(frozen=True)
class Signal:
    """A signal: which column of a log it is, and its unit.

    Wherever a signal is expected, the text ``"COLUMN:UNIT"`` stands for ``Signal("COLUMN", "UNIT")``, as in ``"q:deg"``.

    Parameters
    ----------
    column : str or int
        Name of the column, or its number from 1.
    unit : str
        Unit of the values, such as ``"rad"``, ``"deg"``, ``"rpm"``, ``"A"``, ``"mA"``; ``"1"`` for a
        command or tip of unknown unit.
    hold : {'measured', 'sampled', 'unknown'}
        For a command: a sensor's value, constant between samples, or not known, which is taken as measured and reported where it
        matters. Other signals have none.
    scale : float
        The reading is ``scale * value`` in `unit`; negative if the sensor counts the other way. Encoder counts are
        ``Signal("counts", "rad", scale=2 * math.pi / 4096)``.
    offset : float
        Added to the scaled reading, in `unit`.
    radius : str or float or None
        For a tip in metres on a rotary axis: distance to the joint, as ``"250 mm"``, or in metres.
    quantity : {'angle', 'speed', 'deflection', 'acceleration', 'goal'} or None
        What the signal is, if it is not the usual of its role.
    file : path or None
        A log of its own for motor or tip, with a clock of its own.
    time : str or float or None
        The time stamps of this log, as ``"t:ms"``, or its sample time as ``"2 ms"`` or in seconds; as in the log of the run if
        None.
    clock : {'own', 'shared'} or None
        Whether the stamps of this log are those of the clock of the run; its own clock if None, which the motion shows.
    name : str or None
        Name of a tip in results; the column if None.
    """

    column: str | int
    unit: str
    hold: Literal["measured", "sampled", "unknown"] = "unknown"
    scale: float = 1.0
    offset: float = 0.0
    radius: str | float | None = None
    quantity: Literal["angle", "speed", "deflection", "acceleration", "goal"] | None = None
    file: str | os.PathLike[str] | None = None
    time: str | float | None = None
    clock: Literal["own", "shared"] | None = None
    name: str | None = None

    @classmethod
    def of(cls, value: Signal | str) -> Signal:
        """Make a signal of a text ``"COLUMN:UNIT"``.

        Parameters
        ----------
        value : Signal or str
            A signal, or such a text.

        Returns
        -------
        Signal
            The signal.
        """
        if isinstance(value, Signal):
            return value
        if not isinstance(value, str):
            raise InputError(f"a signal is a Signal or a text COLUMN:UNIT, not {value!r}", 'give it as in "q:deg"')
        return cls(*_column_and_unit(value, "rad"))

    def _table(self, role: str) -> dict[str, object]:
        """Give its keys in a campaign.toml."""
        table: dict[str, object] = {"column": self.column, "unit": self.unit}
        if role == "tip":
            table["name"] = self.name if self.name is not None else str(self.column)
        if role == "command":
            table["hold"] = self.hold
        if self.scale != 1.0:
            table["scale"] = float(self.scale)
        if self.offset != 0.0:
            table["offset"] = float(self.offset)
        if self.radius is not None:
            table["radius"] = self.radius if isinstance(self.radius, str) else f"{float(self.radius)!r} m"
        if self.quantity is not None:
            table["quantity"] = self.quantity
        if self.file is not None:
            table["file"] = os.fspath(self.file)
        if self.time is not None:
            table |= time_table(self.time)
        if self.clock is not None:
            table["clock"] = self.clock
        return table


def time_table(time: Signal | str | float) -> dict[str, object]:
    """Give the keys of a campaign.toml for time stamps or a sample time.

    Parameters
    ----------
    time : Signal, str or float
        A column with its unit, as ``"t:ms"``; or a sample time, as ``"2 ms"`` or in seconds.

    Returns
    -------
    dict
        The keys.
    """
    if isinstance(time, Real) and not isinstance(time, bool):
        return {"sample_time": f"{float(time)!r} s"}
    if isinstance(time, str) and ":" not in time and re.match(r"\s*[0-9.]+\s*\D", time):
        return {"sample_time": time}
    if isinstance(time, str):
        time = Signal(*_column_and_unit(time, "s"))
    return {"time": Signal.of(cast("Signal", time))._table("time")}


def _column_and_unit(text: str, unit_of_example: str) -> tuple[str, str]:
    column, colon, unit = text.rpartition(":")
    if not colon or not column or not unit:
        raise InputError(
            f"the signal {text!r} has no unit", f'give it with its unit, as in "{text.strip(":")}:{unit_of_example}"'
        )
    return column, unit
