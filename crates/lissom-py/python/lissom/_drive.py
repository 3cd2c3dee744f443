"""Constants of a drive, and quantities with units, as a campaign.toml has them."""

from __future__ import annotations

import os
from collections.abc import Mapping
from numbers import Real

#: Keys of the table [drive].
DRIVE = (
    "torque_constant",
    "current_limit",
    "voltage_limit",
    "limit",
    "gear_ratio",
    "gear_efficiency",
    "resistance",
    "back_emf",
    "position_gain",
    "arm",
)


def drive_table(drive: Mapping[str, str | float], role: str, linear: bool) -> dict[str, object]:
    """Give the keys of [drive]: texts as they are, numbers in SI units.

    Parameters
    ----------
    drive : mapping of str to str or float
        The constants.
    role : str
        Role of the input, as ``current``.
    linear : bool
        Whether the axis is linear.

    Returns
    -------
    dict
        The keys.
    """
    return {key: _constant(key, value, role, linear) for key, value in drive.items()}


def with_unit(value: str | float, unit: str) -> str:
    """Give a quantity as text.

    Parameters
    ----------
    value : str or float
        A text, or a number in `unit`.
    unit : str
        The unit.

    Returns
    -------
    str
        The text.
    """
    return value if isinstance(value, str) else f"{float(value)!r} {unit}"


def _constant(key: str, value: str | float, role: str, linear: bool) -> object:
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, Real) and not isinstance(value, bool):
        # A plain number could be per ampere or per volt.
        if key == "torque_constant" and role == "voltage":
            return with_unit(value, "N/V" if linear else "N*m/V")
        return float(value)
    return value
