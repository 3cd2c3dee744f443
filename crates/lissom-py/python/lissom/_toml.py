"""Values as TOML."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence

from ._errors import InputError


def toml(value: object) -> str:
    """Write a value of a campaign.toml.

    Parameters
    ----------
    value : str, bool, int, float, sequence or mapping
        The value.

    Returns
    -------
    str
        Its text.
    """
    if isinstance(value, str):
        try:
            value.encode()
        except UnicodeEncodeError:
            raise InputError(f"a text has characters that no file can contain: {value!r}") from None
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        return repr(float(value))
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{toml_key(str(k))} = {toml(v)}" for k, v in value.items()) + " }"
    if isinstance(value, Sequence):
        return "[" + ", ".join(toml(item) for item in value) + "]"
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
