"""The virtual rig beside hand-written loops: 60 s of the report's arm.

`python evidence/peers/rig.py` prints two tables. Times are the least of some
calls. Every way closes the same loop: 20 000 samples of
3 ms on 0.5 rad and 3 rad/s, an arm that sticks. Errors are of the motor's angle against figures of
50 digits (`crates/lissom-core/tests/rig_reference.rs`). `--no-scipy` leaves the slow one out.
"""

import argparse
import json
import math
import subprocess
import tempfile
import time
from pathlib import Path

import numba
import numpy as np
import scipy.integrate
import scipy.linalg

POUND_FORCE, INCH, POUND = 4.4482216152605, 0.0254, 0.45359237
TORQUE = POUND_FORCE * INCH
J, V, K = 0.005529 * TORQUE, 0.01216 * TORQUE, 2.184 * TORQUE
FRICTION = 0.132 * K
LENGTH, MASS = 7 * INCH, 0.121 * POUND
EI = 30e6 * POUND_FORCE / INCH**2 * math.pi * (0.032 * INCH) ** 4 / 64
OMEGA2 = 3 * EI / (MASS * LENGTH**3)
COUPLING = 3 * EI / LENGTH
AIR = 0.06
T, SAMPLES = 0.003, 20_000
KP, KD, LIMIT = 8.0, 0.2, 4.12
AMPLITUDE, OMEGA = 0.5, 3.0
# Sample and θ_m [rad] in 50 digits.
REFERENCE = [
    (100, 0.36849283479284844),
    (500, -0.478791146100495),
    (1000, 0.22463713848632133),
    (2000, -0.4024212207767286),
    (3999, -0.49098420254056024),
]

# x = [θ_m, θ̇_m, θ_t, θ̇_t].
SLIP = np.array(
    [[0, 1, 0, 0], [-COUPLING / J, -V / J, COUPLING / J, 0], [0, 0, 0, 1], [OMEGA2, 0, -OMEGA2, -AIR]]
)
STICK = SLIP.copy()
STICK[0], STICK[1] = 0, 0


def matrices(rates):
    """Φ and γ over a sample: the state after it is Φ·x + γ·torque."""
    whole = np.zeros((5, 5))
    whole[:4, :4] = rates
    if rates[0, 1]:
        whole[1, 4] = 1 / J
    whole = scipy.linalg.expm(whole * T)
    return np.ascontiguousarray(whole[:4, :4]), np.ascontiguousarray(whole[:4, 4])


PHI, GAMMA = matrices(SLIP)
PHI_STUCK, _ = matrices(STICK)


@numba.njit
def _taylor(x, net, stuck, t, out):
    """The state after t ≤ T by its Taylor series, and the velocity's slope there."""
    a0, a1, a2, a3 = x[0], x[1], x[2], x[3]
    s0, s1, s2, s3 = a0, a1, a2, a3
    for k in range(1, 12):
        f = t / k
        if stuck:
            d0, d1 = 0.0, 0.0
        else:
            d0 = a1
            d1 = (-V * a1 - COUPLING * (a0 - a2) + (net if k == 1 else 0.0)) / J
        d2, d3 = a3, OMEGA2 * (a0 - a2) - AIR * a3
        a0, a1, a2, a3 = d0 * f, d1 * f, d2 * f, d3 * f
        s0, s1, s2, s3 = s0 + a0, s1 + a1, s2 + a2, s3 + a3
    out[0], out[1], out[2], out[3] = s0, s1, s2, s3


@numba.njit
def _sample(x, torque, mode, phi, gamma, phi_stuck, y):
    """One sample; gives the mode after it and how often the joint came to stick.

    Events are looked for where the ends of the sample differ: two within one are missed."""
    left, sticks = T, 0
    while left > 1e-15:
        if mode == 0:
            room = torque - COUPLING * (x[0] - x[2])
            if abs(room) > FRICTION:
                mode = 1 if room > 0 else -1
                continue
            if left == T:
                for i in range(4):
                    y[i] = (
                        phi_stuck[i, 0] * x[0]
                        + phi_stuck[i, 1] * x[1]
                        + phi_stuck[i, 2] * x[2]
                        + phi_stuck[i, 3] * x[3]
                    )
            else:
                _taylor(x, 0.0, True, left, y)
            end = torque - COUPLING * (y[0] - y[2])
            if abs(end) <= FRICTION:
                x[:] = y
                return mode, sticks
            sign = 1.0 if end > 0 else -1.0
            low, high, t = 0.0, left, 0.5 * left
            for _ in range(60):
                _taylor(x, 0.0, True, t, y)
                f = sign * (torque - COUPLING * (y[0] - y[2])) - FRICTION
                if f < 0:
                    low = t
                else:
                    high = t
                step = f / (sign * COUPLING * y[3])
                t_next = t - step
                if not low < t_next < high:
                    t_next = 0.5 * (low + high)
                if abs(t_next - t) < 1e-16:
                    break
                t = t_next
            _taylor(x, 0.0, True, t, y)
            x[:] = y
            left -= t
            mode = 1 if sign > 0 else -1
            _taylor(x, torque - mode * FRICTION, False, left, y)
            x[:] = y
            return mode, sticks
        net = torque - mode * FRICTION
        if left == T:
            for i in range(4):
                y[i] = (
                    phi[i, 0] * x[0]
                    + phi[i, 1] * x[1]
                    + phi[i, 2] * x[2]
                    + phi[i, 3] * x[3]
                    + gamma[i] * net
                )
        else:
            _taylor(x, net, False, left, y)
        if y[1] * mode > 0:
            x[:] = y
            return mode, sticks
        low, high, t = 0.0, left, 0.5 * left
        for _ in range(60):
            _taylor(x, net, False, t, y)
            if y[1] * mode > 0:
                low = t
            else:
                high = t
            slope = (net - V * y[1] - COUPLING * (y[0] - y[2])) / J
            t_next = t - y[1] / slope
            if not low < t_next < high:
                t_next = 0.5 * (low + high)
            if abs(t_next - t) < 1e-16:
                break
            t = t_next
        _taylor(x, net, False, t, y)
        x[:] = y
        x[1] = 0.0
        left -= t
        room = torque - COUPLING * (x[0] - x[2])
        if abs(room) <= FRICTION:
            mode = 0
            sticks += 1
        else:
            mode = 1 if room > 0 else -1
    return mode, sticks


@numba.njit
def closed_loop(phi, gamma, phi_stuck):
    x, y, angle = np.zeros(4), np.zeros(4), np.empty(SAMPLES)
    mode, before = 0, 0.0
    for k in range(SAMPLES):
        angle[k] = x[0]
        error = AMPLITUDE * math.sin(OMEGA * k * T) - x[0]
        current = min(max(KP * error + KD / T * (error - before), -LIMIT), LIMIT)
        before = error
        mode, _ = _sample(x, K * current, mode, phi, gamma, phi_stuck, y)
    return angle


def by_scipy(rtol=1e-9, atol=1e-12):
    """The same loop by an adaptive Runge-Kutta of order 8 with events."""
    x, mode, before, angle = np.zeros(4), 0, 0.0, np.empty(SAMPLES)

    def stops(net, coupled):
        def event(_, x):
            return x[1]

        def loose(_, x):
            return FRICTION - abs(net - COUPLING * (x[0] - x[2]))

        found = loose if coupled else event
        found.terminal = True
        found.direction = -1 if coupled else -mode
        return found

    for k in range(SAMPLES):
        angle[k] = x[0]
        error = AMPLITUDE * math.sin(OMEGA * k * T) - x[0]
        torque = K * min(max(KP * error + KD / T * (error - before), -LIMIT), LIMIT)
        before = error
        at = 0.0
        while T - at > 1e-14:
            room = torque - COUPLING * (x[0] - x[2])
            if mode == 0 and abs(room) > FRICTION:
                mode = 1 if room > 0 else -1
            rates = SLIP if mode else STICK
            push = np.array([0, (torque - mode * FRICTION) / J if mode else 0, 0, 0])
            found = scipy.integrate.solve_ivp(
                lambda _, x: rates @ x + push, (at, T), x, "DOP853", rtol=rtol, atol=atol,
                events=stops(torque, mode == 0),
            )
            at, x = found.t[-1], found.y[:, -1].copy()
            if found.status == 1:
                if mode:
                    x[1] = 0.0
                    mode = 0
                else:
                    mode = 1 if torque - COUPLING * (x[0] - x[2]) > 0 else -1
    return angle


def least(f, count=5, most_s=0.5):
    """Least time [s] of some calls, as other work may run beside; and what it gave."""
    times, begin = [], time.perf_counter()
    while len(times) < count or time.perf_counter() - begin < most_s:
        start = time.perf_counter()
        given = f()
        times.append(time.perf_counter() - start)
    return min(times), given


def lissom():
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "rig.json"
        command = ["cargo", "bench", "--quiet", "-p", "lissom-core", "--bench", "rig_peers", "--", str(file)]
        subprocess.run(command, check=True, cwd=Path(__file__).resolve().parents[2])
        return json.loads(file.read_text())


def worst(angle):
    return max(abs(angle[k] - exact) for k, exact in REFERENCE)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--no-scipy", action="store_true")
    given = parser.parse_args()
    own = lissom()
    dense = (PHI, GAMMA, PHI_STUCK)
    closed_loop(*dense)
    loop_s, angle = least(lambda: closed_loop(*dense))
    print("| 60 s, one mass | time | ratio | error [rad] |\n|---|---|---|---|")

    def row(name, seconds, angle):
        ratio = seconds / own["loop_s"]
        print(f"| {name} | {seconds * 1e3:.3g} ms | {ratio:.3g} | {worst(angle):.1e} |")

    row("lissom, modes", own["loop_s"], own["angle_rad"])
    row("numba, hand-written", loop_s, angle)
    if not given.no_scipy:
        start = time.perf_counter()
        angle = by_scipy()
        row("scipy DOP853 with events, rtol 1e-9", time.perf_counter() - start, angle)

    print("\n| masses | 60 s | per mode | preparation |\n|---|---|---|---|")
    for row in own["growth"]:
        n, loop = row["masses"], row["loop_s"]
        print(f"| {n} | {loop * 1e3:.3g} ms | {loop / n * 1e3:.3g} ms | {row['prepare_s'] * 1e3:.2g} ms |")


if __name__ == "__main__":
    main()
