"""HDF5 files written by h5py, and MATLAB files of version 7.3 written by hdf5storage."""

import pathlib

import h5py
import hdf5storage
import numpy as np
import scipy.io

import expected
import matlab_files

KINDS = "i1,i2,i4,i8,u1,u2,u4,u8,f2,f4,f8"


def of_array(name, array):
    """The channels of an array; those of a compound type by field."""
    array = np.asarray(array)
    if array.dtype.names is not None:
        return [c for field in array.dtype.names for c in of_array(f"{name}/{field}", array[field])]
    if array.dtype.kind not in "biufc":
        return []
    return expected.channels(name, array)


def of_group(path, group):
    """The channels of a group: its datasets first, then its groups, both by name."""
    found = []
    for name in sorted(group):
        if isinstance(group[name], h5py.Dataset) and not isinstance(group.get(name, getlink=True), h5py.SoftLink):
            new = of_array(f"{path}{name}", group[name][()])
            for channel in new:
                unit = group[name].attrs.get("units", group[name].attrs.get("unit"))
                channel["unit"] = unit.decode() if isinstance(unit, bytes) else unit
            found += new
    for name in sorted(group):
        if isinstance(group[name], h5py.Group):
            found += of_group(f"{path}{name}/", group[name])
    return found


def fill(file, rng, options):
    t = np.arange(300) * 0.002
    file.create_dataset("t", data=t, **options).attrs["units"] = "s"
    file.create_dataset("text", data="a text")
    for k in range(3):
        group = file.create_group(f"run_{k}")
        group.create_dataset("theta", data=rng.normal(size=300), **options).attrs["unit"] = np.bytes_("rad")
        group.create_dataset("iq", data=rng.normal(size=(300, 2)), **options)
        group.create_dataset("wide", data=rng.normal(size=(3, 200)).astype("f4"), **options)
        deep = group.create_group("deep/er")
        deep.create_dataset("on", data=rng.integers(0, 2, 100).astype(bool), **options)
        deep.create_dataset("one", data=1.5 * k)
    for kind in KINDS.split(","):
        values = rng.normal(size=150) * (1 if kind[0] == "f" else 50)
        for order in "<>":
            name = {"<": "little", ">": "big"}[order]
            file.create_dataset(f"numbers/{name}_{kind}", data=values.astype(order + kind), **options)
    record = np.zeros(80, dtype=[("t", "f8"), ("on", "?"), ("p", "f4", (3,)), ("in", [("i", "i2"), ("name", "S5")])])
    record["t"], record["p"] = rng.normal(size=80), rng.normal(size=(80, 3))
    record["in"]["i"], record["on"] = rng.integers(-99, 99, 80), rng.integers(0, 2, 80)
    file.create_dataset("record", data=record, **options)
    file.create_dataset("z", data=np.exp(1j * t), **options)
    file.create_dataset("mode", data=rng.integers(0, 3, 50), dtype=h5py.enum_dtype({"a": 0, "b": 1, "c": 2}), **options)
    file.create_dataset("words", data=["a", "bc"], dtype=h5py.string_dtype())
    file.create_dataset("empty", data=np.zeros((0, 3)))
    file.attrs["made"] = "a drive"


def write_hdf5(folder, rng):
    variants = {
        "plain": {},
        "gzip": {"chunks": True, "compression": "gzip", "shuffle": True},
        "checked": {"chunks": True, "fletcher32": True},
        "lzf": {"chunks": True, "compression": "lzf"},
        "growing": {"chunks": True, "maxshape": "first"},
    }
    count = 0
    for name, options in variants.items():
        for version in ("earliest", "v110", "v112"):
            path = folder / f"{name}_{version}.h5"
            with h5py.File(path, "w", libver=("earliest", "v108") if version == "earliest" else (version, version)) as file:
                fill(Growing(file) if "maxshape" in options else file, rng, options)
            with h5py.File(path) as file:
                found = of_group("", file)
            expected.write(path, found)
            count += 1
    return count + links(folder, rng)


class Growing:
    """Creates datasets whose first axis is unlimited."""

    def __init__(self, file):
        self.file, self.attrs = file, file.attrs

    def create_group(self, name):
        return Growing(self.file.create_group(name))

    def create_dataset(self, name, data, **options):
        if options.pop("maxshape", None):
            options["maxshape"] = (None, *np.shape(data)[1:])
        return self.file.create_dataset(name, data=data, **options)


def links(folder, rng):
    """Groups that contain themselves, and second names of datasets."""
    path = folder / "links.h5"
    with h5py.File(path, "w") as file:
        file["a"] = rng.normal(size=40)
        file["again"] = file["a"]
        file["soft"] = h5py.SoftLink("/a")
        file["group/b"] = rng.normal(size=40)
        file["group/root"], file["group/self"], file["loop"] = file["/"], file["group"], file["/"]
        found = expected.channels("a", file["a"][()]) + expected.channels("group/b", file["group/b"][()])
    expected.write(path, found, "further names of datasets")
    return 1


def by_name(value):
    """The same value with its fields by name, as version 7.3 has them."""
    if isinstance(value, dict):
        return {key: by_name(value[key]) for key in sorted(value)}
    if isinstance(value, np.ndarray) and value.dtype.names is not None:
        names = sorted(value.dtype.names)
        new = np.zeros(value.shape, dtype=[(name, object) for name in names])
        for place in np.ndindex(value.shape):
            new[place] = tuple(by_name(value[place][name]) for name in names)
        return new
    if isinstance(value, np.ndarray) and value.dtype == object:
        new = np.empty(value.shape, dtype=object)
        for place in np.ndindex(value.shape):
            new[place] = by_name(value[place])
        return new
    return value


def write_matlab(folder, rng):
    count = 0
    for name, variables in matlab_files.contents(rng):
        variables = by_name({k: v for k, v in variables.items() if k not in ("sparse", "lines")})
        earlier = folder / "earlier.mat"
        scipy.io.savemat(earlier, variables, oned_as="column")
        found = matlab_files.of_file(earlier)
        earlier.unlink()
        for suffix, options in [("", {}), ("_gzip", {"compress": True, "compress_size_threshold": 0})]:
            path = folder / f"{name}{suffix}_v73.mat"
            hdf5storage.savemat(
                str(path), variables, format="7.3", oned_as="column", store_python_metadata=False, **options
            )
            expected.write(path, found)
            count += 1
    return count + table(folder, rng)


def table(folder, rng):
    """A variable of the class table, as MATLAB marks it."""
    path = folder / "table_v73.mat"
    theta = rng.normal(size=(30, 1))
    hdf5storage.savemat(str(path), {"theta": theta}, format="7.3", store_python_metadata=False)
    with h5py.File(path, "a") as file:
        variable = file.create_dataset("T", data=np.arange(6, dtype="u4")[None])
        variable.attrs["MATLAB_class"] = np.bytes_("table")
        variable.attrs["MATLAB_object_decode"] = np.int32(3)
    expected.write(path, expected.channels("theta", theta), "T (MATLAB tables)")
    return 1


def write_all(folder, rng):
    return write_hdf5(pathlib.Path(folder), rng) + write_matlab(pathlib.Path(folder), rng)
