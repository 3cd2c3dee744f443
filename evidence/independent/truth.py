"""Simulates the campaigns that `lissom-study --export FOLDER` wrote: `python truth.py FOLDER`; called by `cargo xtask truth`.

For NNNN.json this writes NNNN/campaign.toml, its logs, and facts.json: what a log does not say.
"""

import json
import sys
import time
from pathlib import Path

import numpy as np
from scipy.special import exprel  # (e^x − 1)/x

import stick_slip
import with_scipy

# scipy's own solver must agree on the first samples of a run to this [rad].
AGREE = 1e-10
AGREE_SAMPLES = 600


class Arm:
    """The arm from its dimensions, in angles of [motor, masses]."""

    def __init__(self, given):
        spans = given["spans"]
        ends = np.cumsum([s["length_m"] for s in spans])
        mass = np.array([s["mass_kg"] for s in spans])
        damping = np.array([s["damping_n_s_per_m"] for s in spans])
        starts = np.concatenate([[0.0], ends[:-1]])
        rigidity = np.array([s["flexural_rigidity_n_m2"] for s in spans])

        def yields(i, j):
            """Deflection of mass i of the clamped beam per force at mass j: ∫(x_i − s)(x_j − s)/EI ds up to the nearer."""
            a, b, k = ends[i], ends[j], min(i, j) + 1

            def integral(s):
                return a * b * s - (a + b) * s**2 / 2 + s**3 / 3

            return float(np.sum((integral(ends[:k]) - integral(starts[:k])) / rigidity[:k]))

        n = len(spans)
        stiffness = np.linalg.inv([[yields(i, j) for j in range(n)] for i in range(n)])
        bend = np.column_stack([-ends, np.diag(ends)])
        self.masses = n
        self.stiffness = bend.T @ stiffness @ bend
        self.inertia, self.drag = mass * ends**2, damping * ends**2
        self.inertia_kg_m2 = given["inertia_kg_m2"]
        self.viscous_nm_s_per_rad = given["viscous_nm_s_per_rad"]
        self.forward_nm, self.backward_nm = given["forward_nm"], given["backward_nm"]
        self.torque_constant_nm_per_a = given["torque_constant_nm_per_a"]
        self.sample_time_s = given["sample_time_s"]

    def table(self):
        """Rows: inertias, friction forward and backward, gravity (none)."""
        rows = np.zeros((3, 1 + self.masses))
        rows[0] = [self.inertia_kg_m2, *self.inertia]
        rows[1, :2] = self.forward_nm, self.backward_nm
        return rows

    def turn(self):
        """Stiffness and damping, side by side."""
        return np.hstack([self.stiffness, np.diag([self.viscous_nm_s_per_rad, *self.drag])])


def reference(given, times):
    kind = given["kind"]
    if kind == "sine":
        return given["amplitude_rad"] * np.sin(given["omega_rad_s"] * times)
    if kind == "multisine":
        lines = given["lines"]
        phase = given["omega_rad_s"] * times
        return sum(p * np.sin(h * phase) + q * np.cos(h * phase) for h, p, q in lines)
    if kind == "chirp":
        (low, high), length = given["ends_rad_s"], given["duration_s"]
        t = np.minimum(times, length)
        swept = low * t * exprel(np.log(high / low) * t / length)
        return given["amplitude_rad"] * np.sin(swept + high * (times - t))
    raise ValueError(f"no reference of the kind {kind!r} is known here")


def simulate(given, arm, run, keep_states=False):
    sensors = [given["motor"], *[given["tip"]] * arm.masses]
    samples = run["wait_samples"] + run["rows"]
    # numpy's generator, not the rig's: the same noise in law, not in number.
    stream = np.random.default_rng(run["seed"])
    noise = stream.standard_normal((samples, len(sensors))) * [s["noise_rad"] for s in sensors]
    steps = np.array([s["step_rad"] for s in sensors])
    times = arm.sample_time_s * np.arange(samples)
    pd = np.array([given["proportional_a_per_rad"], given["derivative_a_s_per_rad"], given["filter_s"]])
    return stick_slip.loop(
        reference(run["reference"], times), noise, steps, pd, arm.sample_time_s, given["limit_a"],
        arm.torque_constant_nm_per_a, arm.turn(), arm.table(), run["wait_samples"], keep_states,
    )


def apart_from_scipy(given, arm, run):
    """Largest distance of the first samples' angles from those of scipy's own solver under the same currents [rad]."""
    short = {**run, "wait_samples": 0, "rows": AGREE_SAMPLES}
    currents, _, _, _, states = simulate(given, arm, short, keep_states=True)
    joint, x, most = with_scipy.Joint(arm), np.zeros(2 * (1 + arm.masses)), 0.0
    for current, state in zip(currents, states):
        most = max(most, float(np.abs(x - state)[: 1 + arm.masses].max()))
        x = joint.advance(arm.torque_constant_nm_per_a * current, x)
    return most


def campaign_toml(given, masses, runs):
    motor, tip = given["motor"]["step_rad"], given["tip"]["step_rad"]
    tips = ", ".join(f'{{ name = "tip {i}", column = {2 + i}, unit = "rad", scale = {tip!r} }}' for i in range(1, masses + 1))
    lines = [
        "[signals]",
        f"sample_time = {given['sample_time_s']!r}",
        'current = { column = 1, unit = "A", hold = "sampled" }',
        f'motor = {{ column = 2, unit = "rad", scale = {motor!r} }}',
        f"tips = [{tips}]",
        "",
        "[drive]",
        f"torque_constant = {given['torque_constant_nm_per_a']!r}",
        f"current_limit = {given['limit_a']!r}",
    ]
    for k, run in enumerate(runs, 1):
        lines += ["", "[[runs]]", f'file = "run-{k:02}.csv"']
        if run["reference"]["kind"] == "sine":
            lines.append(f"omega_rad_s = {run['reference']['omega_rad_s']!r}")
    return "\n".join(lines) + "\n"


def write(path, folder):
    given = json.loads(path.read_text())
    arm = Arm(given)
    folder.mkdir(exist_ok=True)
    facts = []
    for k, run in enumerate(given["runs"], 1):
        currents, counts, start, stuck, _ = simulate(given, arm, run)
        rows = zip(currents.tolist(), counts.astype(np.int64).tolist())
        text = "\n".join(f"{i!r},{','.join(map(str, c))}" for i, c in rows)
        Path(folder, f"run-{k:02}.csv").write_text(text + "\n")
        angles, rates = np.split(start, 2)
        start = [angles[0], rates[0], *angles[1:], *rates[1:]]
        facts.append({"start": start, "stuck_share": stuck})
    Path(folder, "campaign.toml").write_text(campaign_toml(given, arm.masses, given["runs"]))
    Path(folder, "facts.json").write_text(json.dumps(facts))
    return given, arm


def main(folder):
    paths = sorted(Path(folder).glob("[0-9]*.json"))
    begin, worst = time.time(), 0.0
    for path in paths:
        given, arm = write(path, path.with_suffix(""))
        worst = max(worst, apart_from_scipy(given, arm, given["runs"][0]))
    print(f"{len(paths)} campaigns in {time.time() - begin:.0f} s")
    print(f"angles of {AGREE_SAMPLES} samples of each within {worst:.1e} rad of scipy's DOP853 with events")
    return 0 if worst <= AGREE else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
