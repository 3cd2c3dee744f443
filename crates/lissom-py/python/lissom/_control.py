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
    measured = [name for name in responses if name not in ("motor_raw", "motor_corrected")]
    known = {"ss": ["motor", *measured], "tf": ["motor", *tips], "frd": ["motor", *measured]}
    if kind not in known:
        raise InputError(f"kind is {kind!r}, and not ss, tf or frd")
    if output not in known[kind]:
        raise InputError(f"there is no output {output!r}; the outputs are {', '.join(known[kind])}")
    if kind == "ss":
        return state_space(control, models["state_space"], 0 if output == "motor" else 1 + measured.index(output))
    if kind == "tf":
        model = models["motor"] if output == "motor" else tips[output]
        if model is None:
            raise InputError(f"the result has no model of {output!r}", "its findings give the reason")
        names = {"inputs": "command" if output == "motor" else "motor", "outputs": output}
        return control.TransferFunction(model["num"], model["den"], **names)
    data = responses["motor_corrected" if output == "motor" else output]
    there = np.isfinite(data)
    order = np.argsort(frequency[there], kind="stable")
    omega, first = np.unique(frequency[there][order], return_index=True)
    names = {"inputs": "command" if output == "motor" else "motor", "outputs": output}
    return control.FrequencyResponseData(data[there][order][first], omega, **names)


def state_space(control: Any, space: dict[str, Any] | None, output: int = 0) -> Any:
    """Make a state space of python-control.

    Parameters
    ----------
    control : module
        The module control.
    space : dict or None
        The state space of a file.
    output : int
        Row of the only output, from 0; all outputs that have a model if it is 0.

    Returns
    -------
    control.StateSpace
        The model.
    """
    if space is None:
        raise InputError("the result has no state space", "its findings give the reason")
    c, d = np.atleast_2d(space["c"]), np.atleast_2d(space["d"])
    # A point without a model has a row of zeros.
    modelled = [k for k in range(len(c)) if k == 0 or np.any(c[k]) or np.any(d[k])]
    rows = modelled if output == 0 else [k for k in modelled if k == output]
    if not rows:
        raise InputError("the result has no model of this point", "its findings give the reason")
    outputs = [space["outputs"][k] for k in rows]
    return control.StateSpace(
        space["a"], space["b"], c[rows], d[rows], states=space["states"], inputs=space["inputs"], outputs=outputs
    )
