"""Measured and predicted values of a run."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class Prediction:
    """A channel of a run, as it was measured and as a result predicts it.

    Parameters
    ----------
    run : str
        Name of the run.
    unit : str
        Unit of the values.
    time : array, shape (n,)
        Time since the first sample of the run [s].
    measured : array, shape (n,)
        What was measured, in `unit`.
    predicted : array, shape (n,)
        What the result predicts, in `unit`; NaN where nothing is predicted.
    """

    run: str
    unit: str
    time: NDArray[np.float64]
    measured: NDArray[np.float64]
    predicted: NDArray[np.float64]

    @property
    def residual(self) -> NDArray[np.float64]:
        """Measured minus predicted values, in `unit`, shape (n,)."""
        residual: NDArray[np.float64] = self.measured - self.predicted
        return residual
