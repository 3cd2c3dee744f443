"""What a reader of log files should find in an array, written independently of that reader."""

import itertools
import json
import math
import pathlib

import numpy as np


def channels(name, array):
    """Channels of an array: the longest axis counts the samples, the first of two equal ones."""
    array = np.asarray(array)
    if array.size == 0:
        return []
    if array.dtype.kind == "c":
        parts = (("real", array.real), ("imag", array.imag))
        return [{**c, "name": f"{c['name']}/{part}"} for part, values in parts for c in channels(name, values)]
    array = array.reshape([length for length in array.shape if length > 1])
    if array.ndim <= 1:
        return [channel(name, array.reshape(-1))]
    samples = int(np.argmax(array.shape))
    array = np.moveaxis(array, samples, -1)
    places = itertools.product(*(range(length) for length in array.shape[:-1]))
    return [channel(f"{name}[{','.join(str(k + 1) for k in place)}]", array[place]) for place in places]


def channel(name, values, unit=None, clock=None):
    """A channel; `clock` is the name of a time channel, or a pair: start and step."""
    return {
        "name": name,
        "unit": unit,
        "values": [number(float(value)) for value in np.asarray(values)],
        "clock": clock,
    }


def number(value):
    return value if math.isfinite(value) else str(value)


def write(path, found, note=None):
    """Writes what is expected beside a file; `note` is a part of a note, if there should be one."""
    path = pathlib.Path(path)
    text = json.dumps({"channels": found, "note": note}, allow_nan=False)
    path.with_name(path.name + ".json").write_text(text, encoding="utf-8")
