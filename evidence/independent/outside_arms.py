"""Flexible arms that are nobody's rig: `python outside_arms.py FOLDER COUNT SEED [LISSOM] [OPTIONS]`; `cargo xtask arms`.

A beam of finite elements (Euler-Bernoulli, cubic shape functions) with mass along it and at its end is clamped to a hub with dry
friction. Its modes move with stick_slip.py's events under a sampled position loop; the current is measured with noise. Each arm
is written as a user's logs: FOLDER/NNNN/campaign.toml, its logs, truth.json. With LISSOM (the program) they are identified and
compared with the truth. Options: --quick, --first=INDEX, and --kind=, --motion=, --late_ms= (to whole periods of the loop, not
of an accelerometer) for all arms alike; --same makes the arm of FIRST again and again with other noise, and --noise= (of the
current, as a share of its rms) and --steps (the same as steps of its sensor in place of white noise) set what the current has.

What parameters mean where the estimate has n modes and the beam has more: a mode above them follows the hub as if it were rigid.
Inertia is that of the hub and of those modes, J + Σ_{k>n} h_k², and viscous friction that of the hub and of their damping against
the frame, V + Σ_{k>n} 2·ζ_k·ω_k·h_k² with that part of ζ_k; coupling is the stiffness of the n modes, Σ_{k≤n} h_k²·ω_k². h_k is the
participation of the clamped mode k (mass-normalised) in the hub's angle. truth.json has the parameters' bounds (arm_bound.py).
"""

import json
import math
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
from scipy.linalg import eigh

import arm_bound
import stick_slip

ELEMENTS = 24
# Modes that are simulated; those above follow the hub.
MODES = 6
# Periods of the loop in a sample of the log.
LOOPS = 4
# The hub settles for so long before the log begins [s].
SETTLE_S = 1.0
# Standard deviation of an encoder with noise of a fifth of its step, in steps.
STEPPED = math.hypot(0.2, 1 / math.sqrt(12))
# Relative Cramér-Rao bound of a parameter that the logs tell.
TOLD = 0.05
KINDS = ["angle", "radius", "gauge", "accelerometer"]
MOTIONS = ["sines", "sweep", "multisine", "moves", "squares"]


class Beam:
    """Clamped modes: frequencies `omega` [rad/s], and `part`, their participation in the hub's angle."""

    def __init__(self, length, rigidity, mass, tip_mass):
        n, h = ELEMENTS, length / ELEMENTS
        bend = [[12, 6 * h, -12, 6 * h], [6 * h, 4 * h * h, -6 * h, 2 * h * h]]
        bend += [[-12, -6 * h, 12, -6 * h], [6 * h, 2 * h * h, -6 * h, 4 * h * h]]
        heavy = [[156, 22 * h, 54, -13 * h], [22 * h, 4 * h * h, 13 * h, -3 * h * h]]
        heavy += [[54, 13 * h, 156, -22 * h], [-13 * h, -3 * h * h, -22 * h, 4 * h * h]]
        stiffness, inertia = np.zeros((2 * n + 2, 2 * n + 2)), np.zeros((2 * n + 2, 2 * n + 2))
        for e in range(n):
            at = slice(2 * e, 2 * e + 4)
            stiffness[at, at] += rigidity / h**3 * np.array(bend)
            inertia[at, at] += mass / n / 420 * np.array(heavy)
        inertia[-2, -2] += tip_mass
        rigid = np.ravel(np.column_stack([h * np.arange(n + 1), np.ones(n + 1)]))
        squares, shapes = eigh(stiffness[2:, 2:], inertia[2:, 2:])
        self.inertia = rigid @ inertia @ rigid
        self.omega = np.sqrt(squares[:MODES])
        self.shapes = np.vstack([np.zeros((2, MODES)), shapes[:, :MODES]])
        self.part = self.shapes.T @ inertia @ rigid
        self.length, self.h = length, h

    def shares(self, kind):
        """Share of each mode's oscillator in what is seen: slope or radius at the tip, curvature near the root."""
        if kind == "angle":
            return self.shapes[-1] * self.part
        if kind == "gauge":
            return (self.shapes[5] - self.shapes[3]) / self.h * self.part
        return self.shapes[-2] / self.length * self.part


class Arm:
    """Dimensions, loop, sensors and motions, drawn as an engineer could have chosen them."""

    def __init__(self, rng, kind=None, motion=None, late_ms=None):
        def log(low, high):
            return float(np.exp(rng.uniform(math.log(low), math.log(high))))

        length, mass, tip_mass = rng.uniform(0.3, 1.0), log(0.01, 1.0), log(0.02, 2.0)
        first_hz = log(1.0, 10.0)
        of_one = Beam(length, 1.0, 1.0, tip_mass).omega[0]
        rigidity = mass * (2 * math.pi * first_hz / of_one) ** 2
        self.rng, self.beam = rng, Beam(length, rigidity, mass, mass * tip_mass)
        self.hub = self.beam.inertia * log(0.3, 3.0)
        self.damping = rng.uniform(0.003, 0.03, MODES)
        # Of it, what acts against the frame.
        self.ground = self.damping * (rng.uniform(0, 0.5) if rng.random() < 0.3 else 0.0)
        self.sample_s = 1e-3 * float(rng.choice([1, 2, 4] if first_hz > 3 else [2, 4, 5]))
        self.step, self.tip_step = (2 * math.pi / 2 ** int(rng.integers(12, 17)) for _ in range(2))
        self.kind = kind or str(rng.choice(KINDS))
        self.motion = motion or str(rng.choice(MOTIONS))
        self.constant = log(0.05, 1.0)
        self.travel = rng.uniform(0.3, 1.0)
        total = self.hub + self.beam.inertia
        self.bandwidth = 2 * math.pi * first_hz * rng.uniform(0.4, 1.2)
        peak = total * self.travel * (0.5 * self.bandwidth) ** 2
        self.coulomb = peak * log(0.05, 0.4)
        self.offset = self.coulomb * rng.uniform(-0.1, 0.1)
        self.viscous = peak / (self.travel * 0.5 * self.bandwidth) * log(0.03, 0.3)
        self.gains = np.array([self.bandwidth**2, 1.6 * self.bandwidth]) * total / self.constant
        self.limit = 10 * (peak + 2 * self.coulomb) / self.constant
        # Of the measured current, as a share of its rms: white, or steps.
        self.noise, self.stepped = float(rng.choice([0.002, 0.005, 0.02, 0.05])), False
        self.late_s = 1e-3 * late_ms if late_ms and self.kind != "accelerometer" else 0.0
        self.duration_s = max(10.0, 40 / first_hz)
        base = self.bandwidth / (2 * math.pi)
        # Kind of motion, its frequency [Hz], and its size, last frequency or seed.
        self.runs = {
            "sines": [("sine", f * base, a) for f, a in [(0.1, 1.0), (0.3, 0.7), (0.7, 0.3), (1.1, 0.15)]],
            "sweep": [("sweep", 0.08 * base, 2.0 * base)] * 2,
            "multisine": [("multisine", base, int(rng.integers(1000))) for _ in range(2)],
            "moves": [("moves", base, int(rng.integers(1000))) for _ in range(2)],
            "squares": [("square", 0.12 * base, 1.0), ("square", 0.05 * base, 0.6)],
        }[self.motion]

    def reference(self, run, t):
        kind, base, x = run
        if kind == "sine":
            return self.travel * x * np.sin(2 * math.pi * base * t)
        if kind == "sweep":
            grown = (x / base) ** (t / t[-1])
            phase = 2 * math.pi * base * t[-1] * (grown - 1) / math.log(x / base)
            return 0.5 * self.travel * np.sin(phase) / np.sqrt(grown)
        if kind == "multisine":
            f = base * np.array([0.07, 0.13, 0.23, 0.37, 0.61, 0.89, 1.3, 1.9])
            phases = np.random.default_rng(x).uniform(0, 2 * math.pi, f.size)
            size = 1 / (1 + (f / (0.3 * base)) ** 1.5)
            waves = size * np.sin(2 * math.pi * np.outer(t, f) + phases)
            return self.travel * waves.sum(axis=1) / np.abs(waves.sum(axis=1)).max()
        if kind == "moves":
            rng, angle, at, out = np.random.default_rng(x), 0.0, 0.0, np.zeros_like(t)
            while at < t[-1]:
                goal, length = self.travel * rng.uniform(-1, 1), rng.uniform(0.8, 2.5) / base
                s = np.clip((t - at) / length, 0, 1)
                out = np.where(t >= at, angle + (goal - angle) * s**3 * (10 - 15 * s + 6 * s * s), out)
                angle, at = goal, at + length + rng.uniform(0.1, 0.8) / base
            return out
        return 0.5 * self.travel * x * np.sign(np.sin(2 * math.pi * base * t))

    def matrices(self):
        """Stiffness and damping side by side, and stick_slip.py's table."""
        beam, n = self.beam, 1 + MODES
        inertia = beam.part**2
        own = inertia * beam.omega**2
        rate = 2 * (self.damping - self.ground) * beam.omega * inertia
        stiffness, damping = (np.zeros((n, n)) for _ in range(2))
        for full, part in ((stiffness, own), (damping, rate)):
            full[0, 0] = part.sum()
            full[0, 1:] = full[1:, 0] = -part
            full[range(1, n), range(1, n)] = part
        damping[range(1, n), range(1, n)] += 2 * self.ground * beam.omega * inertia
        damping[0, 0] += self.viscous
        table = np.zeros((3, n))
        table[0] = [self.hub + beam.inertia - inertia.sum(), *inertia]
        table[1, :2] = self.coulomb + self.offset, self.coulomb - self.offset
        return np.hstack([stiffness, damping]), table

    def tip_shares(self):
        """Share of each mode's oscillator in what the tip's sensor shows; a gauge shows volts."""
        shares = self.beam.shares(self.kind)
        return shares / np.abs(shares[0]) * 20 if self.kind == "gauge" else shares

    def tip(self, states, torque, matrices):
        """What the tip's sensor shows, and its standard deviation."""
        n, (turn, table) = 1 + MODES, matrices
        motor, shares = states[:, 0], self.tip_shares()
        white = self.rng.standard_normal(motor.size)
        bent = (states[:, 1:n] - motor[:, None]) @ shares
        if self.kind == "accelerometer":
            pull, speed = -states @ turn.T, states[:, n]
            friction = np.where(speed > 0, table[1, 0], -table[1, 1])
            hub = np.where(speed != 0, (pull[:, 0] + torque - friction) / table[0, 0], 0.0)
            tip = self.beam.length * (hub + (pull[:, 1:] / table[0, 1:] - hub[:, None]) @ shares)
            return tip + 0.02 * tip.std() * white, 0.02 * tip.std()
        if self.kind == "gauge":
            # Volts, in steps of 2 mV.
            return np.round((bent + 0.005 * white) / 0.002) * 0.002, math.hypot(0.005, 0.002 / math.sqrt(12))
        return np.round((motor + bent) / self.tip_step + 0.2 * white) * self.tip_step, self.tip_step * STEPPED

    def simulate(self, run):
        """Columns of a log (time, current, motor, tip), the share of the time at rest, and what arm_bound.py needs."""
        matrices, fast_s = self.matrices(), self.sample_s / LOOPS
        wait = LOOPS * round(SETTLE_S / self.sample_s)
        t = fast_s * np.arange(LOOPS * round(self.duration_s / self.sample_s) + wait)
        noise = self.rng.standard_normal((t.size, 1 + MODES)) * self.step * 0.2
        pd = np.array([*self.gains, 0.2 / self.bandwidth])
        currents, counts, _, stuck, states = stick_slip.loop(
            self.reference(run, t), noise, np.full(1 + MODES, self.step), pd, fast_s, self.limit, self.constant, *matrices, wait, True,
        )
        # A late tip shows the state of some loops before.
        late = round(self.late_s / fast_s)
        counts, states = counts[::LOOPS, 0], states[wait - late : len(states) - late : LOOPS]
        tip, tip_noise = self.tip(states, self.constant * currents[::LOOPS], matrices)
        # At a sample the current steps: what is measured there is the mean of before and after.
        currents = 0.5 * (currents + np.concatenate([currents[:1], currents[:-1]]))[::LOOPS]
        true, noise = currents, self.noise * np.sqrt(np.mean(currents**2))
        if self.stepped and noise > 0:
            step = math.sqrt(12) * noise
            currents = np.round(currents / step + self.rng.uniform(-0.5, 0.5)) * step
        else:
            currents = currents + noise * self.rng.standard_normal(currents.size)
        time_s = self.sample_s * np.arange(tip.size)
        known = (states, self.constant * true, [self.step * STEPPED, tip_noise], self.constant * noise)
        return [time_s, currents, counts * self.step, tip], stuck, known

    def truth(self, modes):
        """The parameters of an arm with so many modes."""
        inertia, omega = self.beam.part**2, self.beam.omega
        total = self.hub + self.beam.inertia
        above = (2 * self.ground * omega * inertia)[modes:].sum()
        rows = {"inertia": total - inertia[:modes].sum(), "coulomb": self.coulomb, "viscous": self.viscous + above}
        return {**rows, "coupling": (inertia * omega**2)[:modes].sum()}

    def write(self, folder):
        folder.mkdir(parents=True, exist_ok=True)
        unit = {"gauge": '"1", quantity = "deflection"'}.get(self.kind, '"rad"')
        if self.kind == "accelerometer":
            unit = f'"m/s^2", quantity = "acceleration", radius = {self.beam.length!r}'
        text = ["[signals]", 'time = { column = "time", unit = "s" }']
        text += ['current = { column = "current", unit = "A", hold = "measured" }', 'motor = { column = "motor", unit = "rad" }']
        text += [f'tips = [{{ name = "tip", column = "tip", unit = {unit} }}]', "", "[drive]", f"torque_constant = {self.constant!r}"]
        stuck, known = [], []
        for k, run in enumerate(self.runs, 1):
            columns, rested, facts = self.simulate(run)
            stuck.append(rested)
            known.append(facts)
            rows, head = np.column_stack(columns), "time,current,motor,tip"
            np.savetxt(folder / f"run-{k}.csv", rows, fmt="%.9g", delimiter=",", header=head, comments="")
            text += ["", "[[runs]]", f'file = "run-{k}.csv"']
        (folder / "campaign.toml").write_text("\n".join(text) + "\n")
        facts = {
            "bounds": arm_bound.bounds(self, known),
            "title": f"{self.kind:13} {self.motion:9} noise {100 * self.noise:.1f} %, {self.beam.omega[0] / 2 / math.pi:.2f} Hz, at rest {max(stuck):.2f}",
            "truth": [self.truth(n) for n in range(MODES)],
            "omega": list(self.beam.omega),
            "zeta": list(self.damping),
        }
        (folder / "truth.json").write_text(json.dumps(facts))


KEYS = {"inertia": "drive.inertia", "coulomb": "friction.coulomb", "viscous": "friction.viscous", "coupling": "beam.coupling"}


class Result:
    """One identification: rows (name, value, standard error, truth, warned, value of slip phases), None where it is not given."""

    def __init__(self, folder, command, options):
        facts, path = json.loads((folder / "truth.json").read_text()), folder / "result.json"
        path.unlink(missing_ok=True)
        start = time.time()
        subprocess.run([command, "identify", folder / "campaign.toml", *options, "--json", path], capture_output=True)
        self.spent_s, self.title, self.rows, self.warnings = time.time() - start, facts["title"], [], ["no result"]
        self.told = [name for name, bound in facts["bounds"].items() if bound < TOLD]
        if not path.exists():
            return
        found = json.loads(path.read_text())
        warnings = [f for f in found["findings"] if f["severity"] == "warning"]
        self.warnings = [f["code"] for f in warnings]
        modes = found["beam"]["modes"]
        # Modes without stiffness, which the tip alone shows, have their inertia in that of the hub.
        heavy = sum(m["stiffness"] > 0 for m in found["arm"]["modes"]) if found["arm"] else len(modes)
        slips = found["methods"]["regression"] or {}

        def row(name, estimate, true, key, but=()):
            warned = any(key in f["affects"] for f in warnings if f["code"] not in but)
            given = estimate and estimate["value"] is not None and estimate["value"] != 0.0
            slip = (slips.get(key.split(".")[1]) or {}).get("value")
            self.rows.append((name, *((estimate["value"], estimate["std"]) if given else (None, None)), true, warned, slip))

        for name, key in KEYS.items():
            part, last = key.split(".")
            row(name, found[part][last] if heavy or name != "coupling" else None, facts["truth"][heavy][name], key)
        for k in range(max(len(modes), 1)):
            mode = modes[k] if k < len(modes) else {}
            # That finding speaks of the highest mode.
            but = ["faint-mode"] if k + 1 < len(modes) else []
            row(f"omega {k + 1}", mode.get("natural_frequency_rad_s"), facts["omega"][k], "beam.modes", but)
            row(f"zeta {k + 1}", mode.get("damping_ratio"), facts["zeta"][k], "beam.modes", but)

    def text(self):
        words = []
        for name, value, std, true, warned, _ in self.rows:
            off = "not given" if value is None else f"{100 * (value / true - 1):+.2f} % ({(value - true) / std:+.1f})"
            words.append(f"{name} {off}{' w' if warned else ' WRONG' if is_wrong(value, std, true) else ''}")
        return f"{self.title}, {self.spent_s:.1f} s: {', '.join(words)} | {' '.join(self.warnings)}"


def is_wrong(value, std, true):
    """By more than five standard errors and 1 %."""
    return value is not None and abs(value - true) > max(5 * std, 0.01 * abs(true))


def table(rows):
    """Of the estimates without a warning: how many are wrong, and how many 95 % intervals have the truth."""
    head = ["parameter", "given", "not given", "warned", "wrong", "intervals", "mean error in standard errors", "rms error over that of slip phases"]
    yield f"| {' | '.join(head)} |"
    yield "| --- " * len(head) + "|"
    for name in [*KEYS, "omega", "zeta", ""]:
        own = [r for r in rows if r[0].startswith(name)]
        given = [r for r in own if r[1] is not None]
        silent = [r for r in given if not r[4]]
        z = np.array([(value - true) / std for _, value, std, true, *_ in silent])
        wrong = sum(is_wrong(*r[1:4]) for r in silent)
        cover = 100 * np.mean(np.abs(z) < 1.96) if z.size else math.nan
        mean = np.clip(z, -10, 10).mean() if z.size else math.nan
        # Both errors relative to the truth, where both methods give the parameter.
        both = np.array([(value / true - 1, slip / true - 1) for _, value, _, true, _, slip in silent if slip is not None])
        rms = np.sqrt(np.mean(both**2, axis=0)) if name and len(both) else [math.nan, math.nan]
        counts = f"{len(given)} | {len(own) - len(given)} | {len(given) - len(silent)} | {wrong} of {len(silent)}"
        yield f"| {name or 'all'} | {counts} | {cover:.0f} % | {mean:+.2f} | {rms[0] / rms[1]:.2f} |"


def main(arguments):
    options = dict(a[2:].split("=") for a in arguments if a.startswith("--") and "=" in a)
    folder, count, seed, *command = [a for a in arguments if not a.startswith("--")]
    indices = range(int(options.get("first", 0)), int(count))
    late_ms = float(options["late_ms"]) if "late_ms" in options else None
    results = []
    for i in indices:
        own = Path(folder) / f"{seed}-{i:04}"
        if not (own / "truth.json").exists():
            drawn = [int(seed), indices[0] if "--same" in arguments else i]
            arm = Arm(np.random.default_rng(drawn), options.get("kind"), options.get("motion"), late_ms)
            arm.rng = np.random.default_rng([int(seed), i, 1])
            arm.noise, arm.stepped = float(options.get("noise", arm.noise)), "--steps" in arguments
            arm.write(own)
        if command:
            results.append(Result(own, command[0], [a for a in arguments if a == "--quick"]))
            print(i, results[-1].text(), flush=True)
    print(*table([row for result in results for row in result.rows]), sep="\n")
    if results:
        rows = [{row[0]: row for row in result.rows if row[1] is not None} for result in results]
        told = [(name in own, name in own and not own[name][4]) for own, r in zip(rows, results) for name in r.told]
        given, silent = (100 * np.mean(column) for column in zip(*told))
        print(f"\nOf {len(told)} parameters with a bound below {100 * TOLD:.0f} % {given:.0f} % are given, {silent:.0f} % without a warning.")
        times = sorted(result.spent_s for result in results)
        print(f"\nTime: {times[len(times) // 2]:.1f} s in the median, {times[-1]:.1f} s at most.")


if __name__ == "__main__":
    main(sys.argv[1:])
