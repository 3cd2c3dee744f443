"""Logs of one rigid joint with friction, simulated by neither lissom nor MuJoCo: stick_slip.py's solver with events.

Three cases: a position loop that follows a multisine, moves from point to point with rests between them, and a multisine under an
unbalanced load whose current is measured with noise. `campaign.toml` declares each log to lissom.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numba import njit

import stick_slip

BITS = 16
STEP_RAD = 2 * math.pi / 2**BITS
SAMPLE_S = 2e-3
DURATION_S = 20.0
LIMIT_A = 20.0
# Proportional and derivative gain [A/rad, A·s/rad] and the derivative's filter [s] of the position loop.
PD = np.array([60.0, 2.5, 4e-3])
# A drive that measures its current: the position loop's period [s], and the pieces of it over which the current is held.
FAST_LOOP_S = 0.25e-3
PIECES = 4


@njit(cache=True)
def position_loop(reference, limit, constant, pd, loop_s, decimation, step_rad, lag_s, pieces, turn, arm):
    """Currents at the samples (every `decimation` periods), encoder counts, angles with speeds, and the share of time at rest.

    A drive without lag (lag_s = 0) holds the current that the loop asks for; one with a lag follows it with that time constant.
    """
    samples = reference.size // decimation
    x, y, k = np.zeros(2), np.zeros(2), np.zeros((13, 2))
    currents, counts = np.empty(samples), np.empty(samples)
    states = np.empty((samples, 2))
    way, before, rate, stuck, actual = 0, 0.0, 0.0, 0.0, 0.0
    piece_s = loop_s / pieces
    follow = 1.0 - np.exp(-piece_s / lag_s) if lag_s > 0.0 else 1.0
    for p in range(samples * decimation):
        count = round(x[0] / step_rad)
        error = reference[p] - count * step_rad
        change = pd[1] * (error - before) if p > 0 else 0.0
        before = error
        rate = (pd[2] * rate + change) / (pd[2] + loop_s)
        asked = min(max(pd[0] * error + rate, -limit), limit)
        if lag_s == 0.0:
            actual = asked
        if p % decimation == 0:
            s = p // decimation
            currents[s], counts[s], states[s] = actual, count, x
        for _ in range(pieces):
            # The mean of the current over the piece.
            held = actual
            if lag_s > 0.0:
                held = asked + (actual - asked) * follow * lag_s / piece_s
                actual += follow * (asked - actual)
            way, rested = stick_slip.advance(x, way, constant * held, piece_s, turn, arm, k, y)
            stuck += rested
    return currents, counts, states, stuck / (samples * decimation * loop_s)


@dataclass
class Case:
    name: str
    title: str
    # Of the position, by the loop's period [s].
    reference: Callable[[float], np.ndarray]
    inertia_kg_m2: float = 0.05
    viscous_nm_s_per_rad: float = 0.25
    coulomb_nm: float = 1.5
    # m·g·l [N·m] and the angle φ of m·g·l·sin(θ + φ) [rad].
    gravity_nm: float = 0.0
    gravity_phase_rad: float = 0.0
    torque_constant_nm_per_a: float = 0.5
    # Lag of the current behind what the loop asks for, and noise of the measured current; none: the log has the held command.
    lag_s: float = 0.0
    current_noise_a: float = 0.0
    seed: int = 1
    # What the log shows, and what only the simulator knows.
    current: np.ndarray = field(init=False)
    angle: np.ndarray = field(init=False)
    counts: np.ndarray = field(init=False)
    states: np.ndarray = field(init=False)
    stuck_share: float = field(init=False)

    def __post_init__(self):
        arm = np.zeros((3, 2))
        arm[0, 0], arm[1], arm[2] = self.inertia_kg_m2, self.coulomb_nm, self.gravity_coefficients()
        turn = np.array([[0.0, self.viscous_nm_s_per_rad]])
        loop_s, pieces = (FAST_LOOP_S, PIECES) if self.measured else (SAMPLE_S, 1)
        current, self.counts, self.states, self.stuck_share = position_loop(
            self.reference(loop_s), LIMIT_A, self.torque_constant_nm_per_a, PD, loop_s, round(SAMPLE_S / loop_s), STEP_RAD,
            self.lag_s, pieces, turn, arm,
        )
        noise = np.random.default_rng(self.seed).standard_normal(current.size)
        self.current = current + self.current_noise_a * noise
        self.angle = self.counts * STEP_RAD

    @property
    def measured(self):
        """Whether the current is measured at the samples; else it is a command that is held between them."""
        return self.lag_s > 0.0

    def gravity_coefficients(self):
        m = self.gravity_nm
        return m * math.cos(self.gravity_phase_rad), m * math.sin(self.gravity_phase_rad)

    def truth(self):
        truth = {"inertia": self.inertia_kg_m2, "viscous": self.viscous_nm_s_per_rad, "coulomb": self.coulomb_nm}
        if self.gravity_nm:
            truth["gravity"] = self.gravity_nm
        return truth

    def write(self, folder):
        """campaign.toml and the log, as a user of lissom has them."""
        folder = Path(folder)
        folder.mkdir(parents=True, exist_ok=True)
        rows = zip(self.current.tolist(), self.counts.astype(np.int64).tolist())
        (folder / "run.csv").write_text("".join(f"{i!r},{m}\n" for i, m in rows))
        hold = "measured" if self.measured else "sampled"
        lines = [
            "[signals]",
            f"sample_time = {SAMPLE_S!r}",
            f'current = {{ column = 1, unit = "A", hold = "{hold}" }}',
            f'motor = {{ column = 2, unit = "rad", scale = {STEP_RAD!r} }}',
            "[drive]",
            f"torque_constant = {self.torque_constant_nm_per_a!r}",
            f"current_limit = {LIMIT_A!r}",
        ]
        if self.gravity_nm:
            lines += ["[load]", "gravity = true"]
        lines += ["[[runs]]", 'file = "run.csv"']
        (folder / "campaign.toml").write_text("\n".join(lines) + "\n")
        return folder / "campaign.toml"


def times(loop_s):
    return loop_s * np.arange(round(DURATION_S / loop_s))


def multisine(seed, lines=10, amplitude_rad=1.2, lowest_hz=0.2):
    """Sines at odd multiples of lowest_hz with amplitudes that fall with frequency, from rest."""
    orders = 2 * np.arange(lines) + 1
    phases = np.random.default_rng(seed).uniform(0, 2 * math.pi, lines)

    def reference(loop_s):
        t = times(loop_s)
        sum_ = sum(np.sin(2 * math.pi * lowest_hz * n * t + p) / n**0.8 for n, p in zip(orders, phases))
        fade = np.clip(t / 0.5, 0, 1)
        return amplitude_rad * fade**2 * (3 - 2 * fade) * sum_ / np.abs(sum_).max()

    return reference


def moves(seed, span_rad=1.5, move_s=0.6, rest_s=0.4):
    """Moves by a polynomial of degree five, with rests between them."""

    def reference(loop_s):
        t, stream = times(loop_s), np.random.default_rng(seed)
        angle, at, begin = np.zeros_like(t), 0.0, 0.3
        while begin < t[-1]:
            to = stream.uniform(-span_rad, span_rad)
            last = move_s * (0.5 + stream.uniform())
            u = np.clip((t - begin) / last, 0, 1)
            angle += (to - at) * u**3 * (10 - 15 * u + 6 * u**2)
            at, begin = to, begin + last + rest_s
        return angle

    return reference


def cases():
    return [
        Case("multisine", "position loop, multisine", multisine(1)),
        Case("moves", "moves with rests", moves(2)),
        Case(
            "gravity", "unbalanced load, measured current", multisine(3),
            gravity_nm=2.0, gravity_phase_rad=0.4, lag_s=1e-3, current_noise_a=0.1,
        ),
    ]
