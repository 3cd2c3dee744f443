"""MATLAB files written by SciPy, and those of MATLAB itself that SciPy is tested with."""

import pathlib
import shutil

import numpy as np
import scipy.io
import scipy.io.matlab as matlab
import scipy.sparse

import expected


def is_numbers(value):
    return isinstance(value, np.ndarray) and value.dtype.kind in "biuf" and value.dtype.names is None


def scalars(name, values):
    """One channel, if there are several values and each is one number."""
    if len(values) > 1 and all(is_numbers(v) and v.size == 1 for v in values):
        return [expected.channel(name, [v.item() for v in values])]
    return None


def flatten(name, value):
    """The channels of a value, as loadmat returns it."""
    if scipy.sparse.issparse(value) or isinstance(value, (matlab.MatlabFunction, matlab.MatlabOpaque)):
        return []
    if not isinstance(value, np.ndarray) or value.dtype.kind in "US":
        return []
    if value.dtype.names is not None:
        elements = [value[place] for place in np.ndindex(value.shape[::-1]) for place in [place[::-1]]]
        return struct(name, value.dtype.names, elements)
    if value.dtype == object:
        cells = list(value.reshape(-1, order="F"))
        found = scalars(name, cells)
        if found is None:
            found = [c for k, cell in enumerate(cells) for c in flatten(f"{name}[{k + 1}]", cell)]
        return found
    return expected.channels(name, value)


def struct(name, fields, elements):
    columns = {field: scalars(f"{name}/{field}", [e[field] for e in elements]) for field in fields}
    found = [c for column in columns.values() if column for c in column]
    for k, element in enumerate(elements):
        path = f"{name}[{k + 1}]" if len(elements) > 1 else name
        new = []
        for field in fields:
            if columns[field] is None:
                new += flatten(f"{path}/{field}", element[field])
        simulink_clock(path, fields, new)
        found += new
    return found


def simulink_clock(path, fields, channels):
    if not {"time", "signals"} <= set(fields):
        return
    time = next((c for c in channels if c["name"] == f"{path}/time"), None)
    for c in channels:
        if time and c["name"].startswith(f"{path}/signals") and len(c["values"]) == len(time["values"]):
            c["clock"] = time["name"]


def of_file(path):
    """The channels of a file, as SciPy reads it."""
    variables = scipy.io.loadmat(path, chars_as_strings=True, verify_compressed_data_integrity=True)
    return [c for k, v in variables.items() if not k.startswith("__") for c in flatten(k, v)]


def contents(rng):
    """Names and variables of files."""
    t = np.arange(300) * 0.002
    numbers = {}
    for kind in "i1,i2,i4,i8,u1,u2,u4,u8,f4,f8".split(","):
        whole = np.dtype(kind).kind != "f"
        numbers[f"column_{kind}"] = (rng.normal(size=(120, 1)) * (50 if whole else 1)).astype(kind)
        numbers[f"matrix_{kind}"] = (rng.normal(size=(3, 80)) * (50 if whole else 1)).astype(kind)
    yield "numbers", numbers
    yield "logical", {"on": rng.integers(0, 2, (200, 1)).astype(bool), "t": t}
    yield "shapes", {
        "row": t,
        "square": rng.normal(size=(6, 6)),
        "wide": rng.normal(size=(2, 5000)),
        "cube": rng.normal(size=(2, 3, 40)),
        "empty": np.zeros((0, 3)),
        "scalar": 4.5,
        "z": np.exp(1j * t),
        "sparse": scipy.sparse.csc_array(np.eye(5)),
        "text": "a text",
        "lines": ["a", "bc"],
    }
    run = np.zeros((1, 3), dtype=[("theta", object), ("rate", object), ("label", object), ("inner", object)])
    for k in range(3):
        run[0, k] = (rng.normal(size=(40 + k, 1)), 10.0 * k, f"run {k}", {"i": rng.normal(size=(40, 2))})
    yield "structs", {"log": {"t": t, "theta": np.sin(t), "sub": {"deep": {"er": t**2}}}, "run": run}
    simulink = {"time": t[:, None], "signals": {"values": rng.normal(size=(300, 2)), "label": "q", "dimensions": 2.0}}
    yield "simulink", {"out": simulink}
    cells = np.empty((2, 2), dtype=object)
    cells[0, 0], cells[1, 0], cells[0, 1], cells[1, 1] = t, "words", rng.normal(size=(5, 4)), {"x": t}
    single = np.empty((1, 3), dtype=object)
    single[0, 0], single[0, 1], single[0, 2] = 1.5, 2.5, 3.5
    yield "cells", {"c": cells, "numbers": single}


def write_all(folder, rng):
    count = 0
    for name, variables in contents(rng):
        for suffix, options in [("v6", {}), ("v7", {"do_compression": True}), ("v4", {"format": "4"})]:
            if suffix == "v4":
                kept = {"f4": 1, "f8": 1, "i4": 1, "i2": 1, "u2": 1, "u1": 1}
                variables = {
                    k: v for k, v in variables.items()
                    if isinstance(v, np.ndarray) and v.ndim <= 2 and v.size and v.dtype.str[1:] in kept
                }
                if not variables:
                    continue
            path = folder / f"{name}_{suffix}.mat"
            scipy.io.savemat(path, variables, oned_as="column", **options)
            expected.write(path, of_file(path))
            count += 1
    data = pathlib.Path(matlab.__file__).parent / "tests" / "data"
    for source in sorted(data.glob("*.mat")):
        if source.name == "nasty_duplicate_fieldnames.mat":
            continue  # SciPy renames such fields.
        try:
            found = of_file(source)
        except Exception as error:
            print(f"SciPy does not read {source.name}: {error}")
            continue
        shutil.copy(source, folder / source.name)
        expected.write(folder / source.name, found)
        count += 1
    return count
