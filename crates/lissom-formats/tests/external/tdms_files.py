"""TDMS files written by npTDMS, and those that npTDMS is tested with.

The latter need pytest, because their module imports it.
"""

import numpy as np
from nptdms import ChannelObject, GroupObject, RootObject, TdmsFile, TdmsWriter, types
from nptdms.test import scenarios, test_daqmx
from nptdms.test.util import GeneratedFile

import expected

TYPES = "i1,i2,i4,i8,u1,u2,u4,u8,f4,f8".split(",")


def values(channel):
    """The values of a channel as numbers; None if they are texts or complex, or have several scalers."""
    scalers = channel.raw_scaler_data
    if len(scalers) > 1:
        return None
    data = channel[:] if "NI_Number_Of_Scales" in channel.properties or not scalers else scalers[0]
    if np.asarray(data).dtype.kind == "M":
        stamps = channel.raw_data
        return (stamps - stamps[0]) / np.timedelta64(1, "s")
    return np.asarray(data).astype(float) if np.asarray(data).dtype.kind in "biuf" else None


def of_file(path):
    """The channels of a file, as npTDMS reads it."""
    found = []
    for group in TdmsFile.read(path).groups():
        for channel in group.channels():
            data = values(channel)
            if data is None or len(data) == 0:
                continue
            properties = channel.properties
            unit = properties.get("unit_string") or properties.get("NI_UnitDescription")
            if unit is None and channel.dtype is not None and channel.dtype.kind == "M":
                unit = "s"
            step = properties.get("wf_increment")
            clock = [float(properties.get("wf_start_offset", 0.0)), float(step)] if step else None
            found.append(expected.channel(f"{group.name}/{channel.name}", data, unit or None, clock))
    return found


def objects(rng, count):
    for kind in TYPES:
        waveform = {"wf_increment": 0.002, "wf_start_offset": 0.5, "wf_samples": count, "unit_string": "A"}
        data = (rng.normal(size=count) * 50).astype(kind)
        yield ChannelObject("number's", f"of {kind}", data, waveform if kind in ("f4", "i2") else {})
    yield ChannelObject("other", "on", np.array(rng.integers(0, 2, count), dtype=bool), {"NI_UnitDescription": "1"})
    stamps = np.datetime64("2026-11-01T10:00:00", "us") + (np.arange(count) * 2000).astype("m8[us]")
    yield ChannelObject("other", "when", stamps)
    yield ChannelObject("other", "words", [f"row {k}" for k in range(count)])
    yield ChannelObject("other", "z", rng.normal(size=count) + 1j)
    linear = {
        "NI_Scaling_Status": "unscaled",
        "NI_Number_Of_Scales": 2,
        "NI_Scale[0]_Scale_Type": "Linear",
        "NI_Scale[0]_Linear_Slope": 0.25,
        "NI_Scale[0]_Linear_Y_Intercept": -1.0,
        "NI_Scale[0]_Linear_Input_Source": types.Uint32(0xFFFFFFFF),
        "NI_Scale[1]_Scale_Type": "Polynomial",
        "NI_Scale[1]_Polynomial_Coefficients_Size": 3,
        "NI_Scale[1]_Polynomial_Coefficients[0]": 1.0,
        "NI_Scale[1]_Polynomial_Coefficients[1]": 2.0,
        "NI_Scale[1]_Polynomial_Coefficients[2]": 0.5,
        "NI_Scale[1]_Polynomial_Input_Source": types.Uint32(0),
    }
    yield ChannelObject("other", "scaled", rng.integers(-99, 99, count).astype("i2"), linear)


def daqmx_files(folder):
    """The files with raw data of NI-DAQmx that the tests of npTDMS make."""
    paths = []

    def load(file):
        path = folder / f"{name}.tdms"
        path.write_bytes(contents(file))
        paths.append(path)
        raise StopIteration

    original, GeneratedFile.load = GeneratedFile.load, load
    for name, test in vars(test_daqmx).items():
        # One has time stamps of a device, which are left out.
        if not name.startswith("test_") or name == "test_daqmx_metadata_without_daqmx_raw_data":
            continue
        try:
            test()
        except Exception:
            pass
    GeneratedFile.load = original
    return [path for path in paths if is_read(path)]


def is_read(path):
    """Whether npTDMS reads the file: some of its tests are about errors."""
    try:
        of_file(path)
    except Exception:
        path.unlink()
        return False
    return True


def write_all(folder, rng):
    paths = []
    groups = [GroupObject("number's"), GroupObject("other", {"note": 1})]
    for version in (4712, 4713):
        for segments in (1, 2, 5):
            path = folder / f"segments_{segments}_{version}.tdms"
            with TdmsWriter(path, version=version) as writer:
                for number in range(segments):
                    # Later segments leave out channels, and have other lengths.
                    kept = [o for o in objects(rng, 40 + 7 * number) if number == 0 or rng.random() < 0.7]
                    writer.write_segment([RootObject({"title": "t"}), *groups, *kept])
            paths.append(path)
    for scenario in scenarios.get_scenarios():
        file, _ = scenario.values
        path = folder / f"{scenario.id}.tdms"
        path.write_bytes(contents(file))
        paths.append(path)
    paths += daqmx_files(folder)
    for path in paths:
        expected.write(path, of_file(path))
    return len(paths)


def contents(file):
    with file.get_tempfile() as temporary:
        return temporary.file.read()
