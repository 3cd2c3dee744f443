"""Plots of results with matplotlib."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import NDArray

from ._errors import InputError

if TYPE_CHECKING:
    from matplotlib.axes import Axes  # type: ignore[import-not-found,unused-ignore]

    from ._estimate import Estimate

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

    @property
    def friction(self) -> Mapping[str, Estimate | None]:
        """Friction."""

    def to_dict(self) -> dict[str, Any]:
        """Everything else."""


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
        axes = _axes(ax, 2)
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
        unit = "rad per command" if output == "motor" else "1"
        magnitude.set_ylabel(f"magnitude (dB, {unit})")
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
        (axes,) = _axes(ax, 1)
        table = self._result.to_dict()["friction"]
        curve = table["curve"] or []
        speeds, values, bars = [], [], []
        unit = "N·m"
        for point in curve:
            speed = next(value for key, value in point.items() if key.startswith("speed"))
            keys = [key for key in point if key.startswith("friction")]
            estimate = point[keys[-1]]
            unit = {"nm": "N·m", "n": "N", "a": "A", "v": "V"}.get(keys[-1].rsplit("_", 1)[-1], "unit of the command")
            sign = 1 if point["direction"] == "forward" else -1
            speeds.append(sign * abs(speed))
            values.append(sign * abs(estimate["value"]))
            bars.append(1.96 * estimate["std"])
        if speeds:
            style = {"fmt": "o", "color": _CORRECTED, "markersize": 4, "label": "at single speeds, without a law"}
            axes.errorbar(speeds, values, yerr=bars, **style)
        coulomb = next((e for key, e in self._result.friction.items() if key.startswith("coulomb_n") and e), None)
        coulomb = coulomb or next(
            (e for key, e in self._result.friction.items() if key.startswith("coulomb") and e), None
        )
        viscous = next((e for key, e in self._result.friction.items() if key.startswith("viscous_") and e), None)
        if coulomb is not None and viscous is not None:
            most = max((abs(speed) for speed in speeds), default=1.0)
            for sign in (1, -1):
                line = np.array([0.0, sign * most])
                label = "Coulomb and viscous friction" if sign > 0 else None
                axes.plot(line, sign * coulomb + viscous * line, color=_MODEL, linewidth=1, label=label)
        axes.axhline(0.0, color="0.8", linewidth=0.8, zorder=0)
        axes.set_xlabel("speed (rad/s)")
        axes.set_ylabel(f"friction ({unit})")
        axes.legend()
        axes.grid(True, alpha=0.3)
        return axes

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


def _axes(ax: Any, count: int) -> NDArray[Any]:
    """Give the axes to draw into."""
    if ax is not None:
        given = np.atleast_1d(np.asarray(ax, dtype=object)).ravel()
        if len(given) != count:
            raise InputError(f"{count} axes are needed, not {len(given)}")
        return given
    import matplotlib.pyplot as plt

    _, axes = plt.subplots(count, 1, sharex=True, squeeze=False, layout="constrained")
    return np.asarray(axes).ravel()
