"""Models of python-control."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._errors import InputError


def to_control(
    models: dict[str, Any],
    frequency: NDArray[np.float64],
    responses: Mapping[str, NDArray[np.complex128]],
    output: str,
    kind: str,
) -> Any:
    """Make a model of python-control.

    Parameters
    ----------
    models : dict
        The linear models of a result.
    frequency : array, shape (n,)
        Frequencies of its responses [rad/s].
    responses : mapping of str to array, shape (n,)
        Its responses.
    output : str
        ``"motor"``, or the name of a tip.
    kind : {'ss', 'tf', 'frd'}
        Which model.

    Returns
    -------
    control.StateSpace, control.TransferFunction or control.FrequencyResponseData
        The model.
    """
    import control  # type: ignore[import-untyped,unused-ignore]

    tips = {tip["name"]: tip for tip in models["tips"]}
    if output != "motor" and output not in tips:
        raise InputError(f"there is no output {output!r}; the outputs are {', '.join(['motor', *tips])}")
    if kind == "ss":
        space = models["state_space"]
        if space is None:
            raise InputError("the result has no state space", "its findings give the reason")
        rows = slice(None)
        outputs = space["outputs"]
        if output != "motor":
            row = [k for k, name in enumerate(outputs) if name.startswith(output)][0]
            rows, outputs = slice(row, row + 1), outputs[row : row + 1]
        c, d = np.atleast_2d(space["c"])[rows], np.atleast_2d(space["d"])[rows]
        return control.StateSpace(
            space["a"], space["b"], c, d, states=space["states"], inputs=space["inputs"], outputs=outputs
        )
    if kind == "tf":
        model = models["motor"] if output == "motor" else tips[output]
        if model is None:
            raise InputError(f"the result has no model of {output!r}", "its findings give the reason")
        return control.TransferFunction(model["num"], model["den"])
    if kind == "frd":
        data = responses["motor_corrected" if output == "motor" else output]
        there = np.isfinite(data)
        order = np.argsort(frequency[there], kind="stable")
        omega, first = np.unique(frequency[there][order], return_index=True)
        return control.FrequencyResponseData(data[there][order][first], omega)
    raise InputError(f"kind is {kind!r}, and not ss, tf or frd")
