"""Holds lissom's rig against scipy and MuJoCo: `python compare.py FOLDER`; called by `cargo xtask external`.

FOLDER is what the example `external` of the crate lissom wrote. Prints a table; ends with 1 where a bound is broken.
"""

import os
import sys
import time
from importlib.metadata import version

# One thread, as lissom has.
for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"

import numpy as np  # noqa: E402

import arm  # noqa: E402
import with_mujoco  # noqa: E402
import with_scipy  # noqa: E402

REPEATS = 3
MS, TENTH = 1e-3, 1e-4

# What each may be apart from lissom by: all angles at all samples [rad], and the current's first and third harmonic
# [1]. scipy is asked for 1e-12 relative and loses no digits in a stable loop. MuJoCo's errors are those of its step:
# proportional to it with implicitfast, near to its square with RK4 (the reversals are met to a step only).
BOUNDS = {
    "scipy": (1e-12, 1e-12),
    ("implicitfast", MS): (2e-3, 5e-3),
    ("implicitfast", TENTH): (2e-4, 5e-4),
    ("RK4", MS): (2e-5, 1e-3),
    ("RK4", TENTH): (2e-7, 1e-5),
}
# A tenth of the step must leave a tenth of implicitfast's error: what it tends to is then lissom's motion, and no other
# within a tenth of that error again.
ORDER_ONE = (8.0, 12.0)


def median(f):
    """Median processor time of a call [s], which other work beside does not lengthen, and what it gives."""
    times, given = [], None
    for _ in range(REPEATS):
        start = time.process_time()
        given = f()
        times.append(time.process_time() - start)
    return sorted(times)[REPEATS // 2], given


class Judge:
    def __init__(self):
        self.broken = []

    def check(self, what, found, least, most):
        if not least <= found <= most:
            self.broken.append(f"{what}: {found:.3g} is not within {least:.3g} to {most:.3g}")


def distances(e, currents, states):
    """Largest distance of angles [rad], and relative distances of the current's harmonics [1]."""
    n = 1 + e.masses
    order = [0, *range(2, 1 + n)]
    angle = float(np.abs(states[:, :n] - e.states[:, order]).max())
    ours, theirs = arm.harmonics(e, e.current), arm.harmonics(e, currents)
    return angle, *(abs(b - a) / abs(a) for a, b in zip(ours, theirs))


def compare(e, judge):
    """Rows of the table: name, time, times lissom's, angles, first and third harmonic."""
    rows = [["lissom", f"{1e3 * e.lissom_s:.2f} ms", "1", "", "", ""]]

    def row(name, key, seconds, given):
        angle, *harmonics = distances(e, *given)
        most_angle, most_harmonic = BOUNDS[key]
        judge.check(f"{e.name}, {name}, angles", angle, 0.0, most_angle)
        for order, found in zip((1, 3), harmonics):
            judge.check(f"{e.name}, {name}, harmonic {order}", found, 0.0, most_harmonic)
        ratio = f"{float(f'{seconds / e.lissom_s:.2g}'):g}"
        parts = [f"{100 * h:.2g} %" for h in harmonics]
        rows.append([name, f"{seconds:.3g} s", ratio, f"{angle:.1e} rad", *parts])
        return angle

    row("scipy, with events", "scipy", *median(lambda: with_scipy.run(e)))
    apart = {}
    for integrator in ("implicitfast", "RK4"):
        for step_s in (MS, TENTH):
            # Python's part, loop and log, is not MuJoCo's to answer for.
            seconds, _ = median(lambda: with_mujoco.step_alone(e, step_s, integrator))
            name = f"MuJoCo {integrator}, {1e3 * step_s:g} ms"
            given = with_mujoco.run(e, step_s, integrator)
            apart[integrator, step_s] = row(name, (integrator, step_s), seconds, given)
    ratio = apart["implicitfast", MS] / apart["implicitfast", TENTH]
    judge.check(f"{e.name}, MuJoCo implicitfast, error per step", ratio, *ORDER_ONE)
    return rows


def table(rows):
    widths = [max(len(row[k]) for row in rows) for k in range(len(rows[0]))]
    for i, row in enumerate(rows):
        print("| " + " | ".join(cell.ljust(w) for cell, w in zip(row, widths)) + " |")
        if i == 0:
            print("|" + "---|" * len(row))


def main(folder):
    judge = Judge()
    print(", ".join(f"{name} {version(name)}" for name in ("mujoco", "scipy", "numpy")))
    head = ["", "time", "ratio", "angles", "current, ω0", "current, 3ω0"]
    for e in arm.load(folder):
        loop = f"{e.samples * e.sample_time_s:g} s, {e.amplitude_rad:g} rad at {e.omega_rad_s:g} rad/s"
        print(f"\n{e.name}: {loop}\n")
        table([head, *compare(e, judge)])
        sys.stdout.flush()
    for line in judge.broken:
        print(f"\nBROKEN: {line}")
    print(f"\n{'every bound holds' if not judge.broken else f'{len(judge.broken)} bounds are broken'}")
    return 1 if judge.broken else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
