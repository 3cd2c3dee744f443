"""A run of a campaign."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class Run:
    """A run of a campaign, as it is identified: evenly sampled, in SI units.

    Parameters
    ----------
    name : str
        Its name.
    sample_time_s : float
        Its sample time [s].
    time : array, shape (n,)
        Time of each sample [s].
    command : array, shape (n,)
        Current [A], voltage [V], torque [N·m] or command.
    motor : array, shape (n,)
        Angle of the motor [rad]; position [m] on a linear axis.
    tips : mapping of str to array, shape (n,)
        Each tip by its name, in SI units of its quantity.
    """

    name: str
    sample_time_s: float
    time: NDArray[np.float64]
    command: NDArray[np.float64]
    motor: NDArray[np.float64]
    tips: Mapping[str, NDArray[np.float64]]

    @classmethod
    def _of(cls, entry: dict[str, Any]) -> Run:
        """Make a run of the arrays of the extension module."""
        tips = {key[len("tip ") :]: value for key, value in entry.items() if key.startswith("tip ")}
        return cls(entry["name"], entry["sample_time_s"], entry["time"], entry["command"], entry["motor"], tips)
