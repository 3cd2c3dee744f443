"""Units at the ends of keys."""

from __future__ import annotations

_UNITS = {
    "_nm_s_per_rad": "N·m·s/rad",
    "_nm_per_rad": "N·m/rad",
    "_nm_per_a": "N·m/A",
    "_nm_per_v": "N·m/V",
    "_n_s_per_m": "N·s/m",
    "_n_per_m": "N/m",
    "_n_per_a": "N/A",
    "_n_per_v": "N/V",
    "_rad_per_s": "rad/s",
    "_rad_s": "rad/s",
    "_m_per_s": "m/s",
    "_kg_m2": "kg·m²",
    "_per_s": "1/s",
    "_kg": "kg",
    "_nm": "N·m",
    "_n": "N",
    "_rad": "rad",
    "_m": "m",
    "_s": "s",
    "_a": "A",
    "_v": "V",
    "_command": "unit of the command",
}


def unit_of(key: str) -> str:
    """Give the unit that a key of a result ends with.

    Parameters
    ----------
    key : str
        A key, as in ``friction.coulomb_nm``.

    Returns
    -------
    str
        The unit; "1" if the key has none.
    """
    for ending, unit in _UNITS.items():
        if key.endswith(ending):
            return unit
    return "1"
