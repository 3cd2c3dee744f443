"""MCAP files with messages of ROS 2 and in JSON, written by mcap and mcap-ros2-support."""

import itertools
import json
import math

import numpy as np
from mcap.writer import CompressionType, Writer
from mcap_ros2._dynamic import serialize_dynamic

import expected

TIME = "===\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n"
HEADER = "===\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n"
VECTOR = "===\nMSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z\n"
TYPES = {
    "sensor_msgs/msg/JointState": "# The state of joints.\nstd_msgs/Header header\n\nstring[] name\nfloat64[] position # rad\n"
    "float64[] velocity\nfloat64[] effort\n" + HEADER + TIME,
    "geometry_msgs/msg/WrenchStamped": "std_msgs/Header header\nWrench wrench\n===\nMSG: geometry_msgs/Wrench\n"
    "Vector3 force\nVector3 torque\n" + VECTOR + HEADER + TIME,
    "std_msgs/msg/Float64": "float64 data\n",
    "drive_msgs/msg/State": "uint8 ON=1\nstring NAME=\"a # b\"\nbool on\nint8 a\nfloat32 b 1.5\nuint16[] c\nint64 d\nstring text\n"
    "uint8 e\nfloat64[3] f\nstring[<=4] words\nint16 g\nPart[] parts\nbuiltin_interfaces/Duration age\nfloat64[] long\nuint8 h\n"
    "===\nMSG: drive_msgs/Part\nbyte code\nfloat64 value\nuint32[2] pair\n"
    "===\nMSG: builtin_interfaces/Duration\nint32 sec\nuint32 nanosec\n",
}
MODULE = "================\nIDL: {0}/msg/{1}\n// generated\n#include \"x.idl\"\nmodule {0} {{\n  module msg {{\n{2}\n  }};\n}};\n"
IDL_TIME = MODULE.format("builtin_interfaces", "Time", "struct Time { long sec; unsigned long nanosec; };")
IDL_HEADER = IDL_TIME + MODULE.format(
    "std_msgs", "Header", "struct Header { builtin_interfaces::msg::Time stamp; string frame_id; };"
)
IDL_TYPES = {
    "sensor_msgs/msg/JointState": MODULE.format(
        "sensor_msgs", "JointState",
        "@verbatim (language=\"comment\", text=\"The state (of; joints\" \"and more.\")\nstruct JointState { std_msgs::msg::Header header;"
        "sequence<string> name; @verbatim(language=\"c\", text=\"x\") sequence<double> position; sequence<double> velocity;"
        "sequence<double> effort; };") + IDL_HEADER,
    "geometry_msgs/msg/WrenchStamped": MODULE.format(
        "geometry_msgs", "WrenchStamped", "struct WrenchStamped { std_msgs::msg::Header header; geometry_msgs::msg::Wrench wrench; };")
    + MODULE.format("geometry_msgs", "Wrench", "struct Wrench { Vector3 force; geometry_msgs::msg::Vector3 torque; };")
    + MODULE.format("geometry_msgs", "Vector3", "struct Vector3 { double x; double y; double z; };") + IDL_HEADER,
    "std_msgs/msg/Float64": MODULE.format("std_msgs", "Float64", "struct Float64 { double data; };"),
    "drive_msgs/msg/State": MODULE.format(
        "drive_msgs", "State",
        "typedef double double__3[3]; module State_Constants { const uint8 ON = 1; const string NAME = \"a // b\"; };"
        "struct State { boolean on; int8 a; @default(value=1.5) float b; sequence<uint16> c; long long d; string text; octet e;"
        "double__3 f; sequence<string, 4> words; short g; sequence<drive_msgs::msg::Part> parts;"
        "builtin_interfaces::msg::Duration age; sequence<double> long_; uint8 h; };".replace("long_", "long"))
    + MODULE.format("drive_msgs", "Part", "struct Part { octet code; double value; unsigned long pair[2]; };")
    + MODULE.format("builtin_interfaces", "Duration", "struct Duration { long sec; unsigned long nanosec; };"),
}
START_NS = 1_764_201_600_123_456_789
JOINTS = ["shoulder", "elbow", "wrist"]


def stamp(ns):
    return {"sec": ns // 10**9, "nanosec": ns % 10**9}


def joint_state(rng, ns, k):
    count = 3 if k % 7 else 2
    names = [JOINTS[(j + k // 10) % 3] for j in range(count)]
    numbers = lambda: [float(v) for v in rng.normal(size=count)]
    return {
        "header": {"stamp": stamp(ns), "frame_id": "base" + "x" * (k % 4)},
        "name": names, "position": numbers(), "velocity": numbers(), "effort": [] if k % 3 else numbers(),
    }


def wrench(rng, ns, k):
    vector = lambda: dict(zip("xyz", (float(v) for v in rng.normal(size=3))))
    return {"header": {"stamp": stamp(ns), "frame_id": "tool"}, "wrench": {"force": vector(), "torque": vector()}}


def state(rng, ns, k):
    part = lambda: {"code": int(rng.integers(0, 255)), "value": float(rng.normal()), "pair": [int(v) for v in rng.integers(0, 9, 2)]}
    return {
        "on": bool(k % 2), "a": int(rng.integers(-99, 99)), "b": float(np.float32(rng.normal())),
        "c": [int(v) for v in rng.integers(0, 9, k % 4)], "d": int(rng.integers(-(2**50), 2**50)), "text": "t" * (k % 5),
        "e": k % 256, "f": [float(v) for v in rng.normal(size=3)], "words": ["w"] * (k % 4), "g": -k,
        "parts": [part() for _ in range(k % 3)], "age": {"sec": -k, "nanosec": 5}, "long": [1.5] * (300 if k == 4 else 0), "h": 7,
    }


TOPICS = [
    ("/joint_states", "sensor_msgs/msg/JointState", joint_state),
    ("/wrench", "geometry_msgs/msg/WrenchStamped", wrench),
    ("/command", "std_msgs/msg/Float64", lambda rng, ns, k: {"data": float(rng.normal())}),
    ("/state", "drive_msgs/msg/State", state),
]


def flat(path, value, names=()):
    """Paths and numbers of a message."""
    if isinstance(value, dict):
        names = ()
        for key, inner in value.items():
            if key == "name" or key.endswith("names"):
                names = inner
            if (path, key) not in (("header/", "stamp"), ("", "stamp")):
                yield from flat(f"{path}{key}/", inner, names)
    elif isinstance(value, list):
        if len(value) <= 256:
            labels = names if len(names) == len(value) else range(1, len(value) + 1)
            for label, inner in zip(labels, value):
                yield from flat(f"{path[:-1]}[{label}]/", inner, names)
    elif not isinstance(value, str):
        yield path[:-1], float(value)


def topic_channels(topic, times_s, messages):
    columns = {}
    for row, message in enumerate(messages):
        for path, number in flat("", message):
            columns.setdefault(path, [math.nan] * len(messages))[row] = number
    time = f"{topic}/time"
    return [expected.channel(time, times_s, "s")] + [
        expected.channel(f"{topic}/{path}", values, None, time) for path, values in columns.items()
    ]


def write_file(path, rng, count, encoding, sync, options, cut=None):
    """`sync` is the offset of the stamps to the log times."""
    logs = {topic: [] for topic, _, _ in TOPICS}
    with open(path, "wb") as stream:
        writer = Writer(stream, **options)
        writer.start(profile="ros2", library="test")
        ids = {}
        for topic, kind, _ in TOPICS:
            if encoding == "json":
                schema = writer.register_schema(kind, "jsonschema", b'{"type": "object"}')
            elif encoding == "idl":
                schema = writer.register_schema(kind, "ros2idl", IDL_TYPES[kind].encode())
            else:
                schema = writer.register_schema(kind, "ros2msg", TYPES[kind].encode())
            ids[topic] = writer.register_channel(topic, "json" if encoding == "json" else "cdr", schema)
        other = writer.register_channel("/other", "protobuf", writer.register_schema("x.Y", "protobuf", b"\1\2"))
        encoders = {kind: serialize_dynamic(kind, TYPES[kind])[kind] for _, kind, _ in TOPICS}
        for k in range(count):
            for place, (topic, kind, make) in enumerate(TOPICS):
                ns = START_NS + k * 2_000_000 + place * 1_000 + int(rng.integers(0, 900))
                message = make(rng, ns - sync, k)
                data = json.dumps(message).encode() if encoding == "json" else encoders[kind](message)
                writer.add_message(ids[topic], log_time=ns + 300, publish_time=ns + 300, data=data, sequence=k)
                logs[topic].append((ns + 300, ns - sync, message))
            writer.add_message(other, log_time=START_NS, publish_time=START_NS, data=b"\1\2\3")
        if cut is None:
            writer.finish()
    has_header = {topic: "Header" in TYPES[kind] for topic, kind, _ in TOPICS}
    used = {topic: [row[1 if has_header[topic] else 0] for row in rows] for topic, rows in logs.items()}
    first = min(t[0] for t in used.values())
    firsts = {topic: first for topic in used}
    if sync > 3600 * 10**9:
        for topic in used:
            firsts[topic] = min(used[other][0] for other in used if has_header[other] == has_header[topic])
    found = []
    for topic, rows in logs.items():
        times = [(t - firsts[topic]) / 1e9 for t in used[topic]]
        found += topic_channels(topic, times, [row[2] for row in rows])
    expected.write(path, found, "different clocks" if sync > 3600 * 10**9 else "/other (messages that are neither")


def write_all(folder, rng):
    count = 0
    chunkings = {
        "none": {"compression": CompressionType.NONE, "chunk_size": 4096},
        "lz4": {"compression": CompressionType.LZ4, "chunk_size": 8192},
        "zstd": {"compression": CompressionType.ZSTD},
        "unchunked": {"use_chunking": False, "compression": CompressionType.NONE},
        "plain": {"use_statistics": False, "use_summary_offsets": False, "repeat_channels": False,
                  "repeat_schemas": False, "enable_crcs": False, "enable_data_crcs": True},
    }
    for (name, options), encoding, sync in itertools.product(
        chunkings.items(), ("cdr", "idl", "json"), (0, 20_000_000, 5000 * 10**9)
    ):
        write_file(folder / f"{name}_{encoding}_{sync}.mcap", rng, 150, encoding, sync, options)
        count += 1
    write_file(folder / "no_end.mcap", rng, 150, "cdr", 0, {"use_chunking": False, "compression": CompressionType.NONE}, cut=True)
    return count + 1
