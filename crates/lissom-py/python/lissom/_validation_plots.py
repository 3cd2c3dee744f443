"""Plots of validations with matplotlib."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import NDArray

from ._axes import axes_of
from ._errors import InputError

if TYPE_CHECKING:
    from ._prediction import Prediction

#: Runs are named in a plot up to this number.
NAMED = 8
#: Name of the torque among the channels.
TORQUE = "torque"


class Predicted(Protocol):
    """What is drawn of a validation."""

    @property
    def torque(self) -> tuple[Prediction, ...]:
        """Torque of each run."""

    @property
    def motion(self) -> Mapping[str, tuple[Prediction, ...]]:
        """Motion of each channel and run."""


class ValidationPlots:
    """Plots of a validation, as ``validation.plot.residual()``; they need matplotlib.

    Parameters
    ----------
    validation : Validation
        The validation.
    """

    def __init__(self, validation: Predicted) -> None:
        self._validation = validation

    def residual(self, channels: Sequence[str] | None = None, ax: Any = None) -> NDArray[Any]:
        """Draw measured minus predicted values over time, the runs one after another.

        Parameters
        ----------
        channels : sequence of str, optional
            Of ``"torque"``, ``"motor"`` and the names of tips; all that are predicted if absent.
        ax : matplotlib axes or sequence of them, optional
            One for each channel; a new figure if absent.

        Returns
        -------
        array of matplotlib axes, shape (n,)
            One for each channel. Gaps are times without a prediction: of the torque, while the motor rests.

        Raises
        ------
        InputError
            If a channel is not predicted, or the validation was unpickled and has no series.
        """
        known = dict(self._validation.motion)
        if self._validation.torque:
            known = {TORQUE: self._validation.torque, **known}
        wanted = list(known) if channels is None else [channels] if isinstance(channels, str) else list(channels)
        for name in wanted:
            if name not in known:
                raise InputError(f"there is no prediction of {name!r}", f"there is one of {', '.join(known)}")
        axes = axes_of(ax, len(wanted))
        motor = self._validation.motion["motor"]
        ends = np.cumsum([2 * run.time[-1] - run.time[-2] for run in motor])
        begins = dict(zip((run.run for run in motor), [0.0, *ends[:-1]], strict=True))
        for name, one in zip(wanted, axes, strict=True):
            _residual(name, known[name], begins, one)
        axes[-1].set_xlabel("time (s)")
        return axes


def _residual(name: str, runs: tuple[Prediction, ...], begins: Mapping[str, float], axes: Any) -> None:
    """Draw the residual of one channel, with the runs at their beginnings."""
    squares, counted, logged = 0.0, 0, 0.0
    for number, run in enumerate(runs):
        residual, begin = run.residual, begins[run.run]
        axes.plot(begin + run.time, residual, color=f"C{number % 2}", linewidth=0.8)
        there = np.isfinite(residual)
        squares += float(np.sum(residual[there] ** 2))
        logged += float(np.sum(run.measured[there] ** 2))
        counted += int(there.sum())
        if len(runs) <= NAMED:
            axes.annotate(run.run, (begin, 1.0), xycoords=("data", "axes fraction"), va="bottom", fontsize="small")
        if number > 0:
            axes.axvline(begin, color="0.7", linewidth=0.8, zorder=0)
    axes.axhline(0.0, color="0.6", linewidth=0.8, zorder=0)
    unit = runs[0].unit if runs else ""
    axes.set_ylabel(f"residual of\n{name} ({unit})")
    if counted and logged > 0:
        rms = np.sqrt(squares / counted)
        share = f", {100 * np.sqrt(squares / logged):.2g} % of the torque" if name == TORQUE else ""
        note = {"xycoords": "axes fraction", "ha": "right", "va": "top", "fontsize": "small"}
        frame = {"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 1.5}
        axes.annotate(f"rms {rms:.2g} {unit}{share}", (0.99, 0.97), bbox=frame, **note)
    axes.grid(True, alpha=0.3)
