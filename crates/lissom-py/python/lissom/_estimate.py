"""A number with its uncertainty."""

from __future__ import annotations

from typing import Any


class Estimate(float):
    """An estimate: a float with its standard error.

    It computes and formats as its value; results of arithmetic are plain floats.

    Parameters
    ----------
    value : float
        The value, in `unit`.
    std : float
        The standard error, in `unit`.
    ci95 : tuple of float
        The ends of the 95 % interval, in `unit`.
    unit : str
        The unit; "1" for a number without one.

    Examples
    --------
    >>> coulomb = Estimate(0.1320, std=0.0012, ci95=(0.1296, 0.1344), unit="N·m")
    >>> 2 * coulomb, f"{coulomb:.2f} {coulomb.unit}"
    (0.264, '0.13 N·m')
    """

    __slots__ = ("_ci95", "_std", "_unit")

    _ci95: tuple[float, float]
    _std: float
    _unit: str

    def __new__(cls, value: float, std: float, ci95: tuple[float, float], unit: str = "1") -> Estimate:
        made = super().__new__(cls, value)
        made._std = float(std)
        made._ci95 = (float(ci95[0]), float(ci95[1]))
        made._unit = unit
        return made

    @property
    def std(self) -> float:
        """Standard error, in `unit`."""
        return self._std

    @property
    def ci95(self) -> tuple[float, float]:
        """Ends of the 95 % interval, in `unit`."""
        return self._ci95

    @property
    def unit(self) -> str:
        """Unit; "1" for a number without one."""
        return self._unit

    def __repr__(self) -> str:
        return f"Estimate({float(self)!r}, std={self._std!r}, ci95={self._ci95!r}, unit={self._unit!r})"

    __str__ = float.__repr__

    def __reduce__(self) -> tuple[Any, ...]:
        return (Estimate, (float(self), self._std, self._ci95, self._unit))

    @classmethod
    def _of(cls, entry: Any) -> Estimate | None:
        """Make an estimate of an entry of a result, None of null."""
        if entry is None:
            return None
        low, high = entry["ci95"]
        return cls(entry["value"], entry["std"], (low, high), entry["unit"])


def is_estimate(value: object) -> bool:
    """Whether an entry of a file is an estimate.

    Parameters
    ----------
    value : object
        An entry.

    Returns
    -------
    bool
        Whether it is one.
    """
    return isinstance(value, dict) and {"value", "std", "ci95"} <= set(value)


def estimates(table: dict[str, Any]) -> dict[str, Estimate | None]:
    """Give the estimates in a table of a file.

    Parameters
    ----------
    table : dict
        The table.

    Returns
    -------
    dict
        Estimates by key; None if refused.
    """
    return {key: Estimate._of(value) for key, value in table.items() if value is None or is_estimate(value)}
