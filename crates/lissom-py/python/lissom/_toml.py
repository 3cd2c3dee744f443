"""Values as TOML."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Mapping, Sequence
from numbers import Integral, Real

import numpy as np

from ._errors import InputError
from ._tables import text

#: Most mappings in each other.
DEEPEST = 20


def toml(value: object, depth: int = 0) -> str:
    """Write a value of a campaign.toml.

    Parameters
    ----------
    value : str, bool, int, float, sequence or mapping
        The value.
    depth : int
        Number of mappings around it.

    Returns
    -------
    str
        Its text.
    """
    if isinstance(value, str):
        return json.dumps(text(value), ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, os.PathLike):
        return toml(os.fspath(value))
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, Integral):
        return str(int(value))
    if isinstance(value, Real):
        return repr(float(value))
    if depth > DEEPEST:
        raise InputError("a mapping or list contains itself, or is nested too deeply")
    if isinstance(value, np.ndarray):
        return toml(value.tolist(), depth)
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{toml_key(str(k))} = {toml(v, depth + 1)}" for k, v in value.items()) + " }"
    if isinstance(value, Sequence):
        return "[" + ", ".join(toml(item, depth + 1) for item in value) + "]"
    raise InputError(f"a {type(value).__name__} is not a text, a number or a list: {value!r}")


def toml_key(key: str) -> str:
    """Write a key.

    Parameters
    ----------
    key : str
        The key.

    Returns
    -------
    str
        Its text, in quotes if it needs them.
    """
    return key if re.fullmatch(r"[A-Za-z0-9_-]+", key) else toml(key)
