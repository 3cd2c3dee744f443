"""Frequency responses as tables or arrays, and the arm that they make."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Literal, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _lissom
from ._campaign import Campaign
from ._equivalent import Equivalent
from ._errors import InputError
from ._functions import identify
from ._process import use
from ._result import NO_LOGS, Result
from ._tables import Path, is_path, path_text

#: Key of the frequencies.
OMEGA = "omega_rad_s"


def equivalent(
    source: Result | Campaign | Path | Sequence[Path] | Mapping[str, ArrayLike],
    *,
    modes: int | None = None,
    torque_constant: str | float | None = None,
    std: Mapping[str, ArrayLike] | None = None,
    effort: Literal["quick", "normal", "thorough"] = "normal",
) -> Equivalent:
    """Find the lumped arm that behaves at the measured points as the beam does: Section 4 of the 1989 report.

    Parameters
    ----------
    source : Result, Campaign, path, sequence of path, or mapping of str to array
        A result of this process, a campaign or a campaign.toml, with as many tips as modes; or frequency responses, as tables
        in files or as arrays by name. Arrays are ``omega_rad_s`` [rad/s], ascending, shape (n,); for each point by its name
        its angle per angle of the motor [1], complex, shape (n,); and if it is measured ``motor``, the angle of the motor per
        command without friction [rad/A], complex, shape (n,).
    modes : int, optional
        Number of the lowest modes to keep; all that are found if absent.
    torque_constant : str or float, optional
        For frequency responses: torque per unit of the command, as ``"0.25 N*m/A"``, or in N·m/A.
    std : mapping of str to array, optional
        For arrays: the standard errors of all responses by the same names, in the same units, shape (n,).
    effort : {'quick', 'normal', 'thorough'}
        For a campaign: effort of the search.

    Returns
    -------
    Equivalent
        The arm, with standard errors and findings.

    Raises
    ------
    InputError
        If the responses make no arm, for example because there are fewer points than modes.
    FileError
        If a file cannot be read.

    Examples
    --------
    >>> import numpy as np
    >>> omega = np.linspace(3.0, 12.0, 60)
    >>> tip = 49.0 / (49.0 - omega**2 + 0.07j * omega)
    >>> arm = equivalent({"omega_rad_s": omega, "tip": tip})
    >>> round(arm.modes[0]["natural_frequency_rad_s"], 4)
    7.0
    """
    use()
    if modes is not None and not 1 <= modes <= 100:
        raise InputError(f"modes is {modes}; it must be from 1 to 100")
    logs = source if isinstance(source, (Result, Campaign)) else None
    if is_path(source) and path_text(source).lower().endswith(".toml"):
        logs = Campaign.load(cast("Path", source))
    if logs is not None:
        if torque_constant is not None or std is not None:
            message = "torque_constant and std are those of frequency responses"
            raise InputError(message, "give the torque constant of the campaign")
        result = identify(logs, effort=effort) if isinstance(logs, Campaign) else logs
        found = result._content.found
        if found is None:
            raise InputError("this result has no logs", NO_LOGS)
        return Equivalent(*found.equivalent(modes))
    constant = f"{float(torque_constant)!r} N*m/A" if isinstance(torque_constant, (int, float)) else torque_constant
    if isinstance(source, Mapping) and not isinstance(source, Result):
        return Equivalent(*_lissom.equivalent_of_arrays(*_arrays(source, std or {}), constant, modes))
    files = [source] if is_path(source) else list(cast("Sequence[Path]", source))
    if std is not None:
        raise InputError("std is for arrays", "give standard errors in a table as a column, as in tip_std")
    if not files or not all(is_path(file) for file in files):
        raise InputError("equivalent takes a Result, a Campaign, files, or a mapping of names to arrays")
    return Equivalent(*_lissom.equivalent_of_files([path_text(file) for file in files], constant, modes))


def _arrays(
    source: Mapping[str, ArrayLike], std: Mapping[str, ArrayLike]
) -> tuple[list[float], list[tuple[str, NDArray[np.complex128], list[float] | None]]]:
    """Check frequencies and responses."""
    if OMEGA not in source or len(source) < 2:
        raise InputError(f'responses are "{OMEGA}" and an array for each point', f"there are {', '.join(source) or 'none'}")
    omega = _numbers(source[OMEGA], OMEGA, np.float64)
    if not (omega > 0).all() or not (np.diff(omega) > 0).all():
        raise InputError(f"{OMEGA} must be positive and ascending")
    unknown = [name for name in std if name not in source or name == OMEGA]
    if unknown:
        raise InputError(f"std has {unknown[0]!r}, which is no response")
    responses = []
    for name, values in source.items():
        if name == OMEGA:
            continue
        response = _numbers(values, name, np.complex128)
        errors = _numbers(std[name], f"std of {name}", np.float64).tolist() if name in std else None
        if len(response) != len(omega) or (errors is not None and len(errors) != len(omega)):
            raise InputError(f"{name} has {len(response)} values at {len(omega)} frequencies")
        if not np.abs(response).all() or (errors is not None and min(errors) <= 0):
            raise InputError(f"{name}: a response is zero, or a standard error is not positive", "leave these frequencies out")
        responses.append((str(name), response, errors))
    return omega.tolist(), responses


def _numbers(values: ArrayLike, name: str, kind: Any) -> NDArray[Any]:
    try:
        array = np.ascontiguousarray(values, dtype=kind)
    except (TypeError, ValueError) as error:
        raise InputError(f"{name}: {error}") from None
    if array.ndim != 1 or not np.isfinite(array).all() or len(array) == 0:
        raise InputError(f"{name} must have one dimension and finite values")
    return array
