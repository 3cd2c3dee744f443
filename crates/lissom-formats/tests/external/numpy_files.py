"""Arrays written by NumPy."""

import numpy as np

import expected

TYPES = "?,i1,i2,i4,i8,u1,u2,u4,u8,f2,f4,f8".split(",")


def values(rng, kind, shape):
    if kind == "?":
        return rng.integers(0, 2, shape).astype(bool)
    if kind[0] in "iu":
        info = np.iinfo(kind)
        return rng.integers(info.min, info.max, shape, dtype=kind, endpoint=True)
    array = rng.normal(size=shape).astype(kind)
    array.flat[0] = np.inf
    array.flat[-1] = np.nan
    return array


def write_all(folder, rng):
    count = 0

    def save(name, array, found, note=None):
        nonlocal count
        np.save(folder / name, array, allow_pickle=True)
        expected.write(folder / name, found, note)
        count += 1

    for kind in TYPES:
        for order in "<>":
            dtype = np.dtype(kind).newbyteorder(order)
            label = f"{dtype.kind}{dtype.itemsize}_{'little' if order == '<' else 'big'}"
            for shape in [(), (1,), (2500,), (40, 3), (3, 40), (5, 5), (4, 2, 30), (1, 20), (2, 9000)]:
                array = values(rng, kind, shape).astype(dtype)
                size = "x".join(str(length) for length in shape) or "scalar"
                save(f"{label}_{size}.npy", array, expected.channels("data", array))
                if len(shape) > 1:
                    fortran = np.asfortranarray(array)
                    save(f"{label}_{size}_fortran.npy", fortran, expected.channels("data", array))
    inner = np.dtype([("sub", "<i2"), ("wide", ">f8")])
    record = np.dtype([("t", "<f8"), ("q", "<f4", (3,)), ("nested", inner), ("on", "?"), ("when", "<M8[us]")])
    rows = np.zeros(50, dtype=record)
    rows["t"] = np.arange(50) * 1e-3
    rows["q"] = rng.normal(size=(50, 3))
    rows["nested"]["sub"] = rng.integers(-99, 99, 50)
    rows["nested"]["wide"] = rng.normal(size=50)
    rows["on"] = rng.integers(0, 2, 50)
    rows["when"] = np.datetime64("2026-11-01T10:00:00", "us") + (np.arange(50) * 2000).astype("m8[us]")
    def found(prefix):
        return [
            expected.channel(prefix + "t", rows["t"]),
            *expected.channels(prefix + "q", rows["q"]),
            expected.channel(prefix + "nested/sub", rows["nested"]["sub"]),
            expected.channel(prefix + "nested/wide", rows["nested"]["wide"]),
            expected.channel(prefix + "on", rows["on"]),
            expected.channel(prefix + "when", np.arange(50) * 2e-3, "s"),
        ]
    save("record.npy", rows, found(""))
    aligned = np.zeros(20, dtype=np.dtype([("a", "u1"), ("b", "f8")], align=True))
    aligned["a"], aligned["b"] = np.arange(20), rng.normal(size=20)
    save("aligned.npy", aligned, [expected.channel(k, aligned[k]) for k in "ab"])
    arrays = {
        "t": np.arange(100) * 0.01,
        "data": rng.normal(size=(100, 2)),
        "fs": np.float32(100),
        "rows": rows,
        "stamps": np.array(["2026-01-01T00:00:00", "NaT", "2026-01-01T00:00:03"], dtype="M8[ns]"),
        "spans": np.array([1500, 2500], dtype="m8[ms]"),
        "z": np.array([1 + 2j, 3]),
    }
    listed = [
        expected.channel("t", arrays["t"]),
        *expected.channels("data", arrays["data"]),
        expected.channel("fs", [100.0]),
        *found("rows/"),
        expected.channel("stamps", [0.0, np.nan, 3.0], "s"),
        expected.channel("spans", [1.5, 2.5], "s"),
        *expected.channels("z", arrays["z"]),
    ]
    left = {"objects": np.array([1, "a", None], dtype=object), "text": np.array(["a"])}
    for name, write in [("stored", np.savez), ("deflated", np.savez_compressed)]:
        write(folder / f"{name}.npz", **arrays)
        expected.write(folder / f"{name}.npz", listed)
        write(folder / f"{name}_left.npz", **arrays, **left)
        expected.write(folder / f"{name}_left.npz", listed, "objects (pickled Python objects")
        count += 2
    return count
