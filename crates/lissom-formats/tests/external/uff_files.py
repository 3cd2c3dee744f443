"""Universal files with datasets 58, written by pyuff."""

import numpy as np
import pyuff

import expected

DIRECTIONS = ["X", "Y", "Z", "RX", "RY", "RZ"]


def name(dataset):
    def word(key):
        text = str(dataset.get(key) or "").strip()
        return "" if text == "NONE" else text

    node, direction = int(dataset["rsp_node"]), int(dataset["rsp_dir"])
    axis = ("-" if direction < 0 else "+") + DIRECTIONS[abs(direction) - 1] if direction else ""
    parts = [word("rsp_ent_name")] if word("rsp_ent_name") else []
    if node:
        parts.append(f"{node}{axis}")
    return "/".join(parts) or word("ordinate_axis_lab") or word("id1") or "data"


def of_file(path):
    """The channels of a file, as pyuff reads it, and whether a function is left out."""
    datasets = pyuff.UFF(str(path)).read_sets()
    datasets = datasets if isinstance(datasets, list) else [datasets]
    found, used, left_out = [], {}, False
    for dataset in datasets:
        if dataset["type"] != 58:
            continue
        label = name(dataset)
        used[label] = used.get(label, 0) + 1
        if used[label] > 1:
            label += f"[{used[label]}]"
        is_time = dataset["func_type"] == 1 or (
            dataset["func_type"] == 0 and dataset["abscissa_spec_data_type"] == 17
        )
        is_frequency = dataset["abscissa_spec_data_type"] == 18
        if not is_frequency and (not is_time or np.iscomplexobj(dataset["data"])):
            left_out = True
            continue
        unit = str(dataset["ordinate_axis_units_lab"] or "").strip()
        if is_frequency:
            x, data = dataset["x"][: dataset["num_pts"]], dataset["data"][: dataset["num_pts"]]
            found.append(expected.channel("frequency", x, "Hz"))
            found.append(expected.channel(f"{label}/real", data.real, unit))
            found.append(expected.channel(f"{label}/imag", data.imag, unit))
            continue
        clock = [dataset["abscissa_min"], dataset["abscissa_inc"]]
        data = dataset["data"][: dataset["num_pts"]]
        if not dataset["abscissa_spacing"]:
            clock = f"{label}/time"
            found.append(expected.channel(clock, dataset["x"], "s"))
        found.append(expected.channel(label, data, unit if unit not in ("", "NONE") else None, clock))
    return found, left_out


def dataset(rng, count, number, binary, even):
    x = 0.25 + np.arange(count) * 0.004 if even else np.cumsum(rng.uniform(1e-3, 1e-2, count))
    return {
        "type": 58,
        "binary": binary,
        "func_type": 1,
        "rsp_ent_name": "arm" if number == 1 else "NONE",
        "rsp_node": number,
        "rsp_dir": [3, -4, 0][number % 3],
        "ref_dir": 0,
        "ref_node": 0,
        "data": rng.normal(size=count),
        "x": x,
        "id1": f"response {number}",
        "abscissa_spacing": int(even),
        "abscissa_spec_data_type": 17,
        "ordinate_spec_data_type": 12,
        "ordinate_axis_lab": "acc",
        "ordinate_axis_units_lab": "m/s^2" if number else "NONE",
        "orddenom_spec_data_type": 0,
    }


def write_all(folder, rng):
    paths = []
    for binary in (0, 1):
        for even in (True, False):
            for number_of_file, count in enumerate((2, 3, 4, 5, 401)):
                path = folder / f"{'binary' if binary else 'text'}_{'even' if even else 'uneven'}_{count}.uff"
                path.unlink(missing_ok=True)
                sets = [dataset(rng, count, number, binary, even) for number in (0, 1, 2, 2)]
                response = dataset(rng, count, 9, binary, True)
                sets.insert(2, {**response, "func_type": 4, "data": response["data"] * (1 + 1j)})
                if number_of_file % 2:
                    # Of the frequency, else of neither frequency nor time.
                    sets[2]["abscissa_spec_data_type"] = 18
                pyuff.UFF(str(path)).write_sets(sets, mode="add")
                paths.append(path)
    for path in paths:
        found, left_out = of_file(path)
        expected.write(path, found, "left out: 9" if left_out else None)
    return len(paths)
