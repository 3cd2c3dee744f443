"""Measures reading of logs beside polars and pandas: `python evidence/peers/logs.py`. See README.md."""

import argparse
import gzip
import json
import subprocess
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import h5py
import numpy as np
import pandas as pd
import polars as pl
import pyarrow
import pyarrow.parquet
import scipy.io

from run import ROOT, duration, table

FILES, ROWS = 100, 20_000
COLUMNS = ["time_s", "current_A", "motor_rad", "tip_rad"]
BINARY_ROWS = 2_000_000
REPEATS = 5


def motion(rows, random):
    t = 1e-3 * np.arange(rows)
    q = 1.5 * np.sin(2.0 * t)
    i = 0.4 * np.sign(np.cos(2.0 * t)) + 0.02 * random.standard_normal(rows)
    return np.column_stack([t, i, q, q + 0.01 * random.standard_normal(rows)])


def make(folder):
    """100 logs of 0.7 MB as CSV, and one of 64 MB in each binary format, with its values in one stream."""
    random = np.random.default_rng(1)
    for name in ("csv", "binary", "compressed"):
        Path(folder, name).mkdir()
    for index in range(FILES):
        path = f"{folder}/csv/{index:03}.csv"
        rows = motion(ROWS, random)
        np.savetxt(path, rows, fmt=["%.3f", "%.6f", "%.7f", "%.7f"], delimiter=",",
                   header=",".join(COLUMNS), comments="")
    # Rounded, as converters give them: noise to the last bit would leave nothing to expand.
    rows = np.round(motion(BINARY_ROWS, random), 4)
    columns = {name: np.ascontiguousarray(rows[:, k]) for k, name in enumerate(COLUMNS)}
    np.savez_compressed(f"{folder}/binary/log.npz", **columns)
    scipy.io.savemat(f"{folder}/binary/log.mat", columns, do_compression=True)
    with h5py.File(f"{folder}/binary/log.h5", "w") as file:
        for name, values in columns.items():
            file.create_dataset(name, data=values, chunks=(1 << 16,), compression="gzip", compression_opts=6)
    pyarrow.parquet.write_table(pyarrow.table(columns), f"{folder}/binary/log.parquet",
                                compression="gzip", use_dictionary=False)
    stream = gzip.compress(b"".join(v.tobytes() for v in columns.values()), 6)
    for path in Path(folder, "binary").iterdir():
        Path(folder, "compressed", f"{path.name}.gz").write_bytes(stream)
    return columns


def lissom(folder):
    """lissom's times, taken inside its own process."""
    out = f"{folder}/lissom.json"
    command = ["cargo", "bench", "--quiet", "-p", "lissom-io", "--features", "full", "--bench", "read_logs", "--"]
    subprocess.run([*command, folder, out], cwd=ROOT, check=True)
    return json.loads(Path(out).read_text())


def median(call):
    call()
    times = []
    for _ in range(REPEATS):
        start = time.perf_counter()
        found = call()
        times.append(time.perf_counter() - start)
    return float(np.median(times)), found


def by_pandas(files):
    return [pd.read_csv(file, usecols=COLUMNS) for file in files]


def by_pandas_in_threads(files):
    with ThreadPoolExecutor(2) as threads:
        return list(threads.map(lambda file: pd.read_csv(file, usecols=COLUMNS), files))


def by_polars(files):
    return [pl.read_csv(file, columns=COLUMNS) for file in files]


def main():
    argparse.ArgumentParser(description=__doc__).parse_args()
    with tempfile.TemporaryDirectory() as folder:
        columns = make(folder)
        ours = lissom(folder)
        files = sorted(Path(folder, "csv").iterdir())
        size = sum(file.stat().st_size for file in files) / 1e6
        two_s = ours["two_s"]
        rows = [
            ["lissom, two threads", duration(two_s), "1", "0"],
            ["lissom, one thread", duration(ours["one_s"]), f"{ours['one_s'] / two_s:.3g}", "0"],
        ]
        sums = np.array(ours["sums"])
        for name, call in (
            ("polars.read_csv, its own threads", by_polars),
            ("pandas.read_csv", by_pandas),
            ("pandas.read_csv, two threads", by_pandas_in_threads),
        ):
            seconds, frames = median(lambda: call(files))
            theirs = np.array([frame.to_numpy().sum() for frame in frames])
            wrong = np.abs(sums / theirs - 1).max()
            rows.append([name, duration(seconds), f"{seconds / two_s:.3g}", f"{wrong:.1e}"])
        head = [f"{FILES} files of CSV, {size:.0f} MB", "time", "times lissom's", "sums differ by"]
        table("text", head, rows)
        rows = []
        exact = np.array([columns[name].sum() for name in sorted(columns)])
        for name, of in ours["binary"].items():
            wrong = np.abs(np.array(of["sums"]) / exact - 1).max()
            ratio = f"{of['read_s'] / of['alone_s']:.3g}"
            rows.append([name, duration(of["read_s"]), duration(of["alone_s"]), ratio, f"{wrong:.1e}"])
        head = ["64 MB of values", "lissom reads", "decompression alone", "ratio", "sums differ by"]
        table("binary formats, deflate", head, rows)


main()
