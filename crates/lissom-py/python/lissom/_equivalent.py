"""The lumped arm that behaves at the measured points as the beam does."""

from __future__ import annotations

import functools
import json
from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ._control import state_space
from ._errors import InputError
from ._estimate import Estimate, estimates
from ._files import write_whole
from ._finding import Finding

if TYPE_CHECKING:
    import control  # type: ignore[import-untyped,unused-ignore]

    from ._tables import Path


class Equivalent:
    """The lumped arm that behaves at the measured points as the beam does.

    The second derivatives of the angles ``theta`` [rad] of its n points are ``a @ theta + b * theta_m`` [rad/s²], with the
    angle of the motor ``theta_m`` [rad].

    Parameters
    ----------
    data : str
        What ``lissom equivalent --json`` writes.
    arm : str or None
        The arm.toml; None if there is none.
    reason : tuple of str or None
        Why there is no arm.toml, and what to do about it.
    """

    def __init__(self, data: str, arm: str | None, reason: tuple[str, str] | None) -> None:
        self._data, self._arm, self._reason = data, arm, reason
        self._root: dict[str, Any] = json.loads(data)
        self._entry: dict[str, Any] = self._root["equivalent"]

    @property
    def points(self) -> tuple[str, ...]:
        """Names of the points of the arm: rows of `a` and `b`."""
        return tuple(self._entry["points"])

    @property
    def modes(self) -> tuple[Mapping[str, Estimate | None], ...]:
        """Modes with the motor clamped, ascending: ``natural_frequency_rad_s``, ``damping_ratio``, share of the coupling."""
        return tuple(MappingProxyType(estimates(mode)) for mode in self._entry["modes"])

    @functools.cached_property
    def a(self) -> NDArray[np.float64]:
        """Angular acceleration of each point per angle of each point, as fitted [1/s²], shape (n, n)."""
        return _values(self._entry["beam"]["a_per_s2"])

    @functools.cached_property
    def b(self) -> NDArray[np.float64]:
        """Angular acceleration of each point per angle of the motor, as fitted [1/s²], shape (n,)."""
        return _values(self._entry["beam"]["b_per_s2"])

    @property
    def torque(self) -> Mapping[str, Estimate | None]:
        """Motor and coupling: ``inertia``, ``viscous`` and others; empty without the motor's response."""
        return MappingProxyType(estimates(self._entry["torque"] or {}))

    @functools.cached_property
    def findings(self) -> tuple[Finding, ...]:
        """What to know about the arm."""
        return tuple(Finding._of(entry) for entry in self._root["findings"])

    @property
    def text(self) -> str:
        """The arm.toml, which `plan` and the command take, and `simulate` with a table [rig]."""
        if self._arm is None:
            reason, hint = self._reason or ("it is not known", "")
            raise InputError(f"there is no arm.toml: {reason}", hint)
        return self._arm

    def save_arm(self, path: Path) -> None:
        """Write the arm.toml, whole or not at all.

        Parameters
        ----------
        path : path
            The file; one that exists is replaced.

        Raises
        ------
        InputError
            If the torque per ampere is unknown, or the modes make no arm.
        """
        write_whole(path, self.text.encode())

    def to_control(self) -> control.StateSpace:
        """Make a state space of python-control, from the command to the angles of motor and points, without friction.

        Returns
        -------
        control.StateSpace
            The model.

        Raises
        ------
        InputError
            If there is no response of the motor, or a point is not an angle.
        """
        import control

        model: control.StateSpace = state_space(control, self._entry["state_space"])
        return model

    def to_dict(self) -> dict[str, Any]:
        """Give everything that ``lissom equivalent --json`` writes.

        Returns
        -------
        dict
            A new one for each call.
        """
        content: dict[str, Any] = json.loads(self._data)
        return content

    def __eq__(self, other: object) -> bool:
        return self._data == other._data if isinstance(other, Equivalent) else NotImplemented

    def __hash__(self) -> int:
        return hash(self._data)

    def __reduce__(self) -> tuple[Any, ...]:
        return (Equivalent, (self._data, self._arm, self._reason))

    def __repr__(self) -> str:
        lines = [f"<Equivalent: {len(self.modes)} modes, points {', '.join(self.points)}>"]
        for number, mode in enumerate(self.modes, start=1):
            frequency = mode["natural_frequency_rad_s"]
            if frequency is not None:
                lines.append(f"mode {number}: {frequency:.6g} ± {frequency.std:.2g} rad/s")
        lines += [
            f"{key}: {found:.6g} ± {found.std:.2g} {found.unit}" for key, found in self.torque.items() if found is not None
        ]
        return "\n".join([*lines, *(str(finding) for finding in self.findings)])


def _values(entries: list[Any]) -> NDArray[np.float64]:
    """Give the values of estimates, of a vector or a matrix."""
    rows = [[e["value"] for e in entry] if isinstance(entry, list) else entry["value"] for entry in entries]
    values = np.array(rows, dtype=np.float64)
    values.flags.writeable = False
    return values
