"""Plots of results with matplotlib."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import NDArray

from ._axes import axes_of
from ._errors import InputError

if TYPE_CHECKING:
    from matplotlib.axes import Axes  # type: ignore[import-not-found,unused-ignore]

    from ._campaign import Campaign
    from ._validation import Validation

_RAW, _CORRECTED, _MODEL = "0.6", "C0", "C3"


class Plotted(Protocol):
    """What is drawn of a result."""

    @property
    def frequency(self) -> NDArray[np.float64]:
        """Frequencies [rad/s]."""

    @property
    def response(self) -> Mapping[str, NDArray[np.complex128]]:
        """Responses by name."""

    @property
    def response_std(self) -> Mapping[str, NDArray[np.float64]]:
        """Their standard errors."""

    @property
    def response_vouched_for(self) -> NDArray[np.bool_]:
        """Whether they are corrected with confidence."""

    def to_dict(self) -> dict[str, Any]:
        """Everything else."""

    def _validation(self, campaign: Campaign | None) -> Validation:
        """Predict the runs of a campaign."""


class ResultPlots:
    """Plots of a result, as ``result.plot.bode()``; they need matplotlib.

    Parameters
    ----------
    result : Result
        The result.
    """

    def __init__(self, result: Plotted) -> None:
        self._result = result

    def bode(self, output: str = "motor", ax: Any = None) -> NDArray[Any]:
        """Draw a frequency response: raw, corrected for friction with 95 % bars, and the identified model.

        Parameters
        ----------
        output : str
            ``"motor"`` (motor per command), or the name of a tip (tip per motor).
        ax : sequence of two matplotlib axes, optional
            For magnitude and phase; a new figure if absent.

        Returns
        -------
        array of matplotlib axes, shape (2,)
            Magnitude [dB] and phase [degrees] over frequency [rad/s].
        """
        result = self._result
        names = ("motor_raw", "motor_corrected") if output == "motor" else (output,)
        found = {name: result.response[name] for name in names if name in result.response}
        if not found:
            raise InputError(f"there is no response of {output!r}", f"there is one of {', '.join(result.response)}")
        axes = axes_of(ax, 2)
        magnitude, phase = axes
        omega, vouched = result.frequency, result.response_vouched_for
        for name, response in found.items():
            raw = name == "motor_raw"
            label = "raw" if raw else "without friction" if output == "motor" else output
            color = _RAW if raw else _CORRECTED
            there = np.isfinite(response) & (np.abs(response) > 0)
            sure = there & (vouched | raw)
            for chosen, marker in ((sure, "o"), (there & ~sure, "x")):
                if not chosen.any():
                    continue
                size = np.abs(response[chosen])
                relative = 1.96 * result.response_std[name][chosen] / size
                bars = np.where(np.isfinite(relative), relative, 0.0)
                shown = label if marker == "o" else f"{label}, doubtful"
                style = {"fmt": marker, "color": color, "markersize": 4, "label": shown, "linewidth": 1}
                decibel = 20 * np.log10(1 + np.minimum(bars, 10.0))
                magnitude.errorbar(omega[chosen], 20 * np.log10(size), yerr=decibel, **style)
                angle = np.degrees(np.angle(response[chosen]))
                phase.errorbar(omega[chosen], angle, yerr=np.degrees(np.minimum(bars, np.pi)), **style)
        self._model(output, axes, omega)
        magnitude.set_xscale("log")
        phase.set_xscale("log")
        magnitude.set_ylabel("magnitude (dB)")
        phase.set_ylabel("phase (°)")
        phase.set_xlabel("frequency (rad/s)")
        phase.set_yticks(np.arange(-180, 181, 90))
        magnitude.legend()
        for one in axes:
            one.grid(True, which="both", alpha=0.3)
        return axes

    def friction(self, ax: Axes | None = None) -> Any:
        """Draw friction over speed: at a few speeds with 95 % bars, and the line of the estimates.

        Parameters
        ----------
        ax : matplotlib axes, optional
            Where; a new figure if absent.

        Returns
        -------
        matplotlib axes
            Friction [N·m, or unit of the command] over speed [rad/s].
        """
        content = self._result.to_dict()
        table, linear = content["friction"], content["axis"] == "linear"
        speeds, values, bars, unit = [], [], [], ""
        for point in table["curve"] or []:
            found, unit = point["friction"], point["friction"]["unit"]
            sign = 1 if point["direction"] == "forward" else -1
            speeds.append(sign * abs(point["speed"]["value"]))
            values.append(sign * found["value"])
            bars.append(1.96 * found["std"])
        law = table.get("law")
        lines = _lines(law or table)
        if not speeds and not lines:
            raise InputError("there is no friction to draw", "the findings give the reason")
        (axes,) = axes_of(ax, 1)
        if speeds:
            style = {"fmt": "o", "color": _CORRECTED, "markersize": 4, "label": "at single speeds, without a law"}
            # A bar that is longer than all values says that nothing is known there, and would hide the others.
            size = 2 * max(abs(value) for value in values)
            axes.errorbar(speeds, values, yerr=np.minimum(bars, size), **style)
        most = max((abs(speed) for speed in speeds), default=1.0)
        for sign, (coulomb, viscous) in lines.items():
            line = np.linspace(0.0, most, 200)
            friction = coulomb + viscous * line + (_further(law, line) if law else 0.0)
            label = "law of friction, without ripples and load" if law else "Coulomb and viscous friction"
            axes.plot(sign * line, sign * friction, color=_MODEL, linewidth=1, label=label)
        axes.axhline(0.0, color="0.8", linewidth=0.8, zorder=0)
        axes.set_xlabel("speed (m/s)" if linear else "speed (rad/s)")
        axes.set_ylabel(f"friction ({unit})" if unit else "friction")
        handles, labels = axes.get_legend_handles_labels()
        first = {label: handle for handle, label in zip(handles, labels, strict=True)}
        axes.legend(first.values(), first.keys())
        axes.grid(True, alpha=0.3)
        return axes

    def residual(self, campaign: Campaign | None = None, channels: Sequence[str] | None = None, ax: Any = None) -> NDArray[Any]:
        """Plot the residuals of torque and motion: measured minus predicted values over time.

        Parameters
        ----------
        campaign : Campaign, optional
            The runs; those from which the result was identified if absent.
        channels : sequence of str, optional
            Of ``"torque"``, ``"motor"`` and the names of tips; all that are predicted if absent.
        ax : matplotlib axes or sequence of them, optional
            One for each channel; a new figure if absent.

        Returns
        -------
        array of matplotlib axes, shape (n,)
            One for each channel.

        Raises
        ------
        InputError
            If no campaign is given and the result was read from a file or unpickled.
        """
        return self._result._validation(campaign).plot.residual(channels, ax)

    def _model(self, output: str, axes: NDArray[Any], omega: NDArray[np.float64]) -> None:
        models = self._result.to_dict()["models"]
        model = models["motor"] if output == "motor" else {tip["name"]: tip for tip in models["tips"]}.get(output)
        if model is None or len(omega) == 0:
            return
        line = np.geomspace(omega.min() / 1.5, omega.max() * 1.5, 600)
        response = np.polyval(model["num"], 1j * line) / np.polyval(model["den"], 1j * line)
        axes[0].plot(line, 20 * np.log10(np.abs(response)), color=_MODEL, linewidth=1, label="model", zorder=0)
        angle = np.degrees(np.angle(response))
        jumps = np.abs(np.diff(angle)) > 180
        angle[1:][jumps] = np.nan
        axes[1].plot(line, angle, color=_MODEL, linewidth=1, zorder=0)


def _lines(friction: dict[str, Any]) -> dict[int, tuple[float, float]]:
    """Give Coulomb and viscous friction by the sign of the speed."""
    lines = {}
    for sign, direction in ((1, "forward"), (-1, "backward")):
        coulomb = friction[direction] or friction["coulomb"]
        viscous = friction.get(f"viscous_{direction}") or friction["viscous"]
        if coulomb is not None and viscous is not None:
            lines[sign] = (coulomb["value"], viscous["value"])
    return lines


def _further(law: dict[str, Any], speed: NDArray[np.float64]) -> NDArray[np.float64]:
    """Give the terms of a law of friction that change with speed, beyond viscous friction."""
    sum_ = np.zeros_like(speed)
    near, root = law.get("near_rest"), law.get("root")
    if near:
        power = 2 if near["falloff"] == "gaussian" else 1
        sum_ += near["amplitude"]["value"] * np.exp(-((speed / near["speed"]["value"]) ** power))
    if root:
        sum_ += root["value"] * np.sqrt(speed)
    return sum_
