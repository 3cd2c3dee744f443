"""Measures lissom beside other tools: `python evidence/peers/run.py [--quick]`. See README.md."""

import argparse
import json
import os
import subprocess
import tempfile
import time
from pathlib import Path

# One thread each, as lissom has.
for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS"):
    os.environ[name] = "1"

import numpy as np  # noqa: E402

import beams  # noqa: E402
import peers  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
MODES = 20
# Among the lowest 20 modes of the beams [rad/s].
CHECKED_AT = 3000.0


def median(f, repeats):
    """Median time of a call [s] and what it gives."""
    given, times = None, []
    for _ in range(repeats):
        start = time.perf_counter()
        given = f()
        times.append(time.perf_counter() - start)
    return float(np.median(times)), given


def lissom(cases):
    """lissom's figures for each beam, timed inside its own process."""
    with tempfile.TemporaryDirectory() as folder:
        for key, beam in cases.items():
            for kind, rows in (("beam", np.column_stack(beam.parts)), ("omega", beam.omega)):
                np.savetxt(f"{folder}/{key}.{kind}.csv", rows, fmt="%.17g", delimiter=",")
        command = ["cargo", "bench", "--quiet", "-p", "lissom-core", "--bench", "peers", "--", folder]
        subprocess.run(command, cwd=ROOT, check=True)
        return {key: json.loads(Path(folder, f"{key}.lissom.json").read_text()) for key in cases}


def table(title, head, rows):
    print(f"\n{title}\n")
    widths = [max(len(r[k]) for r in [head, *rows]) for k in range(len(head))]
    for row in [head, ["-" * w for w in widths], *rows]:
        print("| " + " | ".join(c.ljust(w) for c, w in zip(row, widths)) + " |", flush=True)


def duration(seconds):
    for unit, size in (("s", 1.0), ("ms", 1e-3)):
        if seconds >= size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds * 1e6:.3g} µs"


def sweeps(n, few):
    cases, judged = {}, {}
    for make in (beams.uniform, beams.random):
        beam, judged[beam.name] = beams.with_sweep(make(n))
        cases[beam.name] = beam
    ours = lissom(cases)
    for key, beam in cases.items():
        exact, check = beams.reference(beam)
        keep = judged[key]
        time_s = ours[key]["tip_s"]

        def row(name, seconds, found, note="", at=slice(None)):
            wrong = beams.error(found[keep[at]], exact[at][keep[at]])
            return [name, duration(seconds), f"{seconds / time_s:.3g}", f"{wrong:.1e}", note]

        rows = [row("lissom `tip_response`", time_s, np.array(ours[key]["tip"]))]
        for name, make, repeats in (
            ("numba, frequency by frequency", peers.numba_one_by_one, 21),
            ("numba, frequencies side by side", peers.numba_side_by_side, 21),
            ("numba, lissom's form side by side", peers.numba_without_division, 21),
            ("scipy solve_banded", peers.banded, 3),
            ("numpy, sum over all modes", peers.modal_sum, 5),
            ("python-control, 100 modes", lambda b: peers.state_space(b, 100), 1),
        ):
            prepare_s, tip = median(lambda: make(beam), 1)
            tip(beam.omega[:2])
            seconds, found = median(lambda: tip(beam.omega), repeats)
            note = f"after {duration(prepare_s)} for the modes" if "modes" in name else ""
            rows.append(row(name, seconds, found, note))
        tip = peers.state_space(beam, n)
        at = np.linspace(0, beam.omega.size - 1, min(few, beam.omega.size)).astype(int)
        seconds, found = median(lambda: tip(beam.omega[at]), 1)
        note = "" if at.size == beam.omega.size else f"scaled from {at.size} frequencies"
        seconds *= beam.omega.size / at.size
        rows.append(row(f"python-control, all {n} modes", seconds, found, note, at))
        head = ["1000 frequencies of the tip", "time", "times lissom's", "error", "remark"]
        table(f"{key} beam, n = {n} (reference against mpmath: {check:.1e})", head, rows)


def lowest(n):
    beam = beams.uniform(n)
    beam.omega = np.array([1.0])
    ours = lissom({"uniform": beam})["uniform"]
    exact = np.array([beams.frequency(beam, w) for w in ours["modes_rad_s"]])
    rows = []

    def add(name, seconds, found):
        wrong = np.abs(np.asarray(found) / exact - 1).max()
        rows.append([name, duration(seconds), f"{seconds / ours['modes_s']:.3g}", f"{wrong:.1e}"])

    add("lissom `frequencies_rad_s`", ours["modes_s"], ours["modes_rad_s"])
    try:
        add("scipy eigsh, K and M sparse", *median(lambda: peers.eigsh(beam, MODES), 3))
    except (RuntimeError, ValueError) as refusal:  # the factorisation may call K singular
        rows.append(["scipy eigsh, K and M sparse", "-", "-", f"fails: {refusal}"])
    head = [f"lowest {MODES} frequencies", "time", "times lissom's", "relative error"]
    table(f"uniform beam, n = {n}", head, rows)


def check(n):
    rows = []
    for make in (beams.uniform, beams.random, beams.contrast):
        beam = make(n)
        beam.omega = np.array([CHECKED_AT])
        exact, wrong = beams.reference(beam)
        rows.append([beam.name, f"{exact[0]:.6g}", f"{wrong:.1e}"])
    head = ["beam", f"tip's response at {CHECKED_AT:g} rad/s", "difference"]
    table(f"double-double against mpmath's 200 bits, n = {n}", head, rows)


def growth(sizes):
    cases = {}
    for n in sizes:
        beam = beams.uniform(n)
        # About as many steps for every n, and whole blocks of frequencies.
        count = int(min(1000, max(16, 2_000_000 // n)))
        beam.omega = np.geomspace(1.0, 1e4, count)
        cases[f"n{n}"] = beam
    ours = lissom(cases)
    rows = []
    for beam, mine in zip(cases.values(), (ours[key] for key in cases)):
        steps = beam.length.size * beam.omega.size
        peers.numba_side_by_side(beam)(beam.omega[:2])
        row = [f"{beam.length.size}", f"{beam.omega.size}", f"{1e9 * mine['tip_s'] / steps:.2f}"]
        for make in (peers.numba_one_by_one, peers.numba_side_by_side):
            tip = make(beam)
            row.append(f"{1e9 * median(lambda: tip(beam.omega), 7)[0] / steps:.2f}")
        rows.append([*row, duration(mine["build_s"])])
    head = ["n", "frequencies", "lissom", "numba one by one", "numba side by side", "lissom builds in"]
    table("ns per span and frequency, uniform beam", head, rows)


def main():
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument(
        "--quick", action="store_true", help="all modes in python-control at 3 frequencies, not 20"
    )
    quick = options.parse_args().quick
    sweeps(1000, 3 if quick else 20)
    for n in (1000, 100_000):
        lowest(n)
    growth([10**k for k in range(1, 7)])
    check(100_000)


if __name__ == "__main__":
    main()
