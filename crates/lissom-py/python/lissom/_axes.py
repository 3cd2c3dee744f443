"""Axes of matplotlib to draw into."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._errors import InputError


def axes_of(ax: Any, count: int) -> NDArray[Any]:
    """Give the axes to draw into.

    Parameters
    ----------
    ax : matplotlib axes, sequence of them, or None
        The axes of the user; None for those of a new figure, one below the other.
    count : int
        How many are needed.

    Returns
    -------
    array of matplotlib axes, shape (count,)
        The axes.
    """
    if ax is not None:
        given = np.atleast_1d(np.asarray(ax, dtype=object)).ravel()
        if len(given) != count:
            raise InputError(f"{count} axes are needed, not {len(given)}")
        return given
    import matplotlib.pyplot as plt

    height = max(4.8, 2.0 * count)
    _, axes = plt.subplots(count, 1, sharex=True, squeeze=False, layout="constrained", figsize=(6.4, height))
    return np.asarray(axes).ravel()
