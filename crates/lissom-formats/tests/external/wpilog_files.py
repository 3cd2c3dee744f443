"""Data logs written by WPILib.

Later versions of robotpy-wpiutil cannot write a log without a robot program: robotpy-wpiutil < 2025 can.
"""

import struct
import time

import numpy as np
from wpiutil.log import DataLog

import expected

# A thread writes the log, and does not tell when.
PAUSE_S = 0.5
SINGLE = {"double": "appendDouble", "float": "appendFloat", "int64": "appendInteger", "boolean": "appendBoolean"}
ARRAYS = {f"{kind}[]": f"{name}Array" for kind, name in SINGLE.items()}


def value(rng, kind):
    return {
        "double": lambda: rng.normal(),
        "float": lambda: float(np.float32(rng.normal())),
        "int64": lambda: int(rng.integers(-(2**52), 2**52)),
        "boolean": lambda: bool(rng.integers(0, 2)),
    }[kind]()


def entry(name, stamps, columns, unit, is_array):
    time_name = f"{name}/time"
    labels = [f"{name}[{k + 1}]" for k in range(len(columns))] if is_array else [name]
    found = [expected.channel(time_name, [stamp / 1e6 for stamp in stamps], "s")]
    return found + [expected.channel(label, c, unit, time_name) for label, c in zip(labels, columns)]


def structs(name, stamps, rows, labels):
    columns = [[row[k] if k < len(row) else np.nan for row in rows] for k in range(len(labels))]
    found = [expected.channel(f"{name}/time", [stamp / 1e6 for stamp in stamps], "s")]
    return found + [expected.channel(label, c, None, f"{name}/time") for label, c in zip(labels, columns)]


def write_log(path, rng, count, restart, extra):
    folder = path.with_suffix(".new")
    folder.mkdir()
    log = DataLog(dir=str(folder), period=0.05, extraHeader=extra)
    time.sleep(PAUSE_S)
    entries = []
    for kind in SINGLE:
        unit = {"double": "A", "float": "rad"}.get(kind)
        metadata = f'{{"unit": "{unit}"}}' if unit else ""
        entries.append((kind, False, f"NT:/{kind}", log.start(f"NT:/{kind}", kind, metadata, 1), unit, [], []))
    for kind in ARRAYS:
        entries.append((kind, True, f"/arrays/{kind}", log.start(f"/arrays/{kind}", kind, "", 1), None, [], []))
    words = log.start("/words", "string", "", 1)
    log.addSchema("struct:Point", "structschema", "double x;double y", 1)
    log.addSchema("struct:Pose", "structschema", "enum {off=0, on=1} int8 mode;Point at[2];char name[3];float angle", 1)
    pose = log.start("/pose", "struct:Pose", "", 1)
    points = log.start("/points", "struct:Point[]", "", 1)
    unknown = log.start("/unknown", "struct:Unknown", "", 1)
    poses, clouds, stamps_of_structs = [], [], []
    stamp = 1_000
    for row in range(count):
        stamp += int(rng.integers(1, 300_000))
        for place, (kind, is_array, name, number, unit, stamps, rows) in enumerate(entries):
            if rng.random() < 0.2:
                continue
            if row == restart:
                log.finish(number, stamp)
                number = log.start(name, kind, "", stamp)
                entries[place] = (kind, is_array, name, number, unit, stamps, rows)
            element = kind.removesuffix("[]")
            if is_array:
                # The length of an array changes.
                values = [value(rng, element) for _ in range(int(rng.integers(1, 5)))]
                getattr(log, ARRAYS[kind])(number, values, stamp + place)
            else:
                values = [value(rng, element)]
                getattr(log, SINGLE[kind])(number, values[0], stamp + place)
            stamps.append(stamp + place)
            rows.append(values)
        log.appendString(words, f"row {row}", stamp)
        at = rng.normal(size=4)
        angle = float(np.float32(rng.normal()))
        log.appendRaw(pose, struct.pack("<b4d3sf", row % 2, *at, b"abc", angle), stamp)
        poses.append([row % 2, *at, angle])
        cloud = list(rng.normal(size=2 * int(rng.integers(1, 4))))
        log.appendRaw(points, struct.pack(f"<{len(cloud)}d", *cloud), stamp)
        clouds.append(cloud)
        stamps_of_structs.append(stamp)
        log.appendRaw(unknown, bytes(24), stamp)
    log.flush()
    time.sleep(PAUSE_S)
    log.stop()
    time.sleep(PAUSE_S)
    (written,) = folder.iterdir()
    written.replace(path)
    folder.rmdir()
    found = []
    for kind, is_array, name, _, unit, stamps, rows in entries:
        width = max((len(row) for row in rows), default=0)
        columns = [[row[k] if k < len(row) else np.nan for row in rows] for k in range(width)]
        if columns:
            found += entry(name, stamps, columns, unit, is_array)
    leaves = ["mode", "at[1]/x", "at[1]/y", "at[2]/x", "at[2]/y", "angle"]
    found += structs("/pose", stamps_of_structs, poses, [f"/pose/{leaf}" for leaf in leaves])
    width = max(len(row) for row in clouds) // 2
    labels = [f"/points[{k + 1}]/{axis}" for k in range(width) for axis in "xy"]
    found += structs("/points", stamps_of_structs, clouds, labels)
    expected.write(path, found, "/unknown (entries of types")


def write_all(folder, rng):
    for count, restart, extra in [(3, -1, ""), (60, 20, "an extra header"), (2000, 700, "")]:
        write_log(folder / f"rows_{count}.wpilog", rng, count, restart, extra)
    return 3
