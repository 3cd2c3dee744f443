"""Parquet files written by pyarrow."""

import decimal
import itertools

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

import expected

START_NS = 1_764_201_600_123_456_789
KINDS = "int8,int16,int32,int64,uint8,uint16,uint32,uint64,float16,float32,float64"
PER_S = {"s": 1, "ms": 10**3, "us": 10**6, "ns": 10**9}


def column(rng, count, kind, gaps):
    """Values of a column, and the numbers that should be found."""
    values = (rng.normal(size=count) * (1 if "float" in kind else 50)).astype(kind)
    if gaps:
        keep = rng.random(count) > 0.2
        return pa.array(values, mask=~keep), [float(v) if k else np.nan for v, k in zip(values, keep)]
    return pa.array(values), [float(v) for v in values]


def stamps(unit, count):
    return [START_NS * PER_S[unit] // 10**9 + k * max(PER_S[unit] // 500, 1) for k in range(count)]


def contents(rng, count):
    for kind, gaps in itertools.product(KINDS.split(","), (False, True)):
        array, numbers = column(rng, count, kind, gaps)
        yield f"{kind}{'_gaps' if gaps else ''}", array, [expected.channel(f"{kind}{'_gaps' if gaps else ''}", numbers)]
    on = rng.integers(0, 2, count).astype(bool)
    yield "on", pa.array(on), [expected.channel("on", on)]
    for unit in PER_S:
        ticks = stamps(unit, count)
        # Parquet has no seconds: pyarrow writes milliseconds.
        numbers = [(tick - ticks[0]) / PER_S[unit] for tick in ticks]
        yield f"at_{unit}", pa.array(ticks, pa.timestamp(unit)), [expected.channel(f"at_{unit}", numbers, "s")]
    ticks = stamps("us", count)
    late = pa.array([None, None] + ticks[2:], pa.timestamp("us", "Europe/Berlin"))
    numbers = [np.nan, np.nan] + [(tick - ticks[2]) / 10**6 for tick in ticks[2:]]
    yield "late", late, [expected.channel("late", numbers, "s")]
    days = pa.array([20_000 + k for k in range(count)], pa.date32())
    yield "day", days, [expected.channel("day", [86_400 * k for k in range(count)], "s")]
    of_day = [k * 1_234_567 for k in range(count)]
    yield "of_day", pa.array(of_day, pa.time64("us")), [expected.channel("of_day", [v / 1e6 for v in of_day], "s")]
    for digits in (5, 12, 30):
        exact = [decimal.Decimal(int(v)) / 1000 for v in rng.integers(-9999, 9999, count)]
        name = f"decimal_{digits}"
        yield name, pa.array(exact, pa.decimal128(digits, 3)), [expected.channel(name, [float(v) for v in exact])]
    words = pa.array([f"word {k % 5}" for k in range(count)])
    # Words are no numbers.
    yield "words", words, [expected.channel("words", [np.nan] * count)]
    yield "kinds", words.dictionary_encode(), [expected.channel("kinds", [np.nan] * count)]
    inner, outer = rng.normal(size=count), [k % 4 for k in range(count)]
    parts = [None if k % 5 == 0 else {"x": None if k % 7 == 0 else inner[k], "sub": {"n": outer[k]}} for k in range(count)]
    yield "part", pa.array(parts, pa.struct([("x", pa.float64()), ("sub", pa.struct([("n", pa.int32())]))])), [
        expected.channel("part/x", [np.nan if p is None or p["x"] is None else p["x"] for p in parts]),
        expected.channel("part/sub/n", [np.nan if p is None else p["sub"]["n"] for p in parts]),
    ]
    yield "list", pa.array([[1.0] * (k % 3) for k in range(count)]), []
    none = pa.array([None] * count, pa.float64())
    yield "none", none, [expected.channel("none", [np.nan] * count)]


def write_all(folder, rng):
    count = 0
    variants = {
        "plain": {"compression": "none", "use_dictionary": False},
        "snappy": {"compression": "snappy"},
        "zstd": {"compression": "zstd", "data_page_version": "2.0", "write_page_checksum": True},
        "gzip": {"compression": "gzip", "row_group_size": 70},
        "lz4": {"compression": "lz4", "data_page_size": 256},
        "old": {"version": "1.0", "use_deprecated_int96_timestamps": True},
        "delta": {"use_dictionary": False, "column_encoding": {k: "DELTA_BINARY_PACKED" for k in ("int32", "int64", "at_ns")}},
        "split": {"use_dictionary": False, "column_encoding": {k: "BYTE_STREAM_SPLIT" for k in ("float32", "float64")}},
    }
    for (name, options), rows in itertools.product(variants.items(), (3, 300, 20_000)):
        columns = list(contents(rng, rows))
        table = pa.table({label: array for label, array, _ in columns})
        path = folder / f"{name}_{rows}.parquet"
        pq.write_table(table, path, **options)
        expected.write(path, [c for _, _, found in columns for c in found], "columns of lists")
        count += 1
    return count
