"""How well a result predicts another log."""

from __future__ import annotations

import functools
import json
from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from ._errors import InputError
from ._finding import Finding
from ._prediction import Prediction
from ._validation_plots import ValidationPlots

if TYPE_CHECKING:
    from . import _lissom


class Validation:
    """How well a result predicts another log.

    Parameters
    ----------
    data : bytes
        What ``lissom validate --json`` writes.
    """

    def __init__(self, data: bytes) -> None:
        self._data = bytes(data)
        self._root: dict[str, Any] = json.loads(self._data)
        self._found: _lissom.Validation | None = None

    @classmethod
    def _of(cls, found: _lissom.Validation) -> Validation:
        """Make a validation with its series."""
        made = cls(found.data())
        made._found = found
        return made

    @property
    def torque_left(self) -> float | None:
        """Root mean square of logged minus predicted torque, relative to the logged one; None if it is not predicted."""
        torque = self._root["torque"]
        return None if torque is None else float(torque["relative_error"])

    @property
    def torque_expected(self) -> float | None:
        """The same as it would be if the result were exactly right; None if unknown."""
        torque = self._root["torque"]
        return None if torque is None else torque["relative_error_expected"]

    @property
    def residuals(self) -> tuple[dict[str, Any], ...]:
        """Residual of each channel, motor first: measured minus predicted motion."""
        return tuple(self.to_dict()["residuals"])

    @functools.cached_property
    def torque(self) -> tuple[Prediction, ...]:
        """Logged and predicted torque of each run, averaged with the same window; empty if it is not predicted."""
        unit, runs = self._series().torque()
        return tuple(Prediction(name, unit, *arrays) for name, *arrays in runs)

    @functools.cached_property
    def motion(self) -> Mapping[str, tuple[Prediction, ...]]:
        """Measured and predicted motion of each run: ``motor`` and the tips by name."""
        channels = self._series().motion()
        return MappingProxyType(
            {channel: tuple(Prediction(name, unit, *arrays) for name, *arrays in runs) for channel, unit, runs in channels}
        )

    @property
    def plot(self) -> ValidationPlots:
        """Plots with matplotlib: ``validation.plot.residual()``."""
        return ValidationPlots(self)

    def _series(self) -> _lissom.Validation:
        if self._found is None:
            raise InputError("this validation has no series: it was unpickled", "validate the result again")
        return self._found

    @functools.cached_property
    def findings(self) -> tuple[Finding, ...]:
        """Findings about the estimates."""
        return tuple(Finding._of(entry) for entry in self._root["findings"])

    @property
    def ok(self) -> bool:
        """Whether no finding refuses the result."""
        return not any(finding.severity == "refusal" for finding in self.findings)

    def to_dict(self) -> dict[str, Any]:
        """Give everything that ``lissom validate --json`` writes.

        Returns
        -------
        dict
            A new one for each call.
        """
        content: dict[str, Any] = json.loads(self._data)
        return content

    def __eq__(self, other: object) -> bool:
        return self._data == other._data if isinstance(other, Validation) else NotImplemented

    def __hash__(self) -> int:
        return hash(self._data)

    def __reduce__(self) -> tuple[Any, ...]:
        return (Validation, (self._data,))

    def __repr__(self) -> str:
        torque = self.torque_left
        shown = "not predicted" if torque is None else f"{100 * torque:.3g} % of the torque is left"
        return "\n".join([f"<Validation: {shown}>", *(str(finding) for finding in self.findings)])
