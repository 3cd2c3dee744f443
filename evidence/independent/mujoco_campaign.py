"""A campaign that MuJoCo simulates: `python mujoco_campaign.py write FOLDER`, then, once `lissom identify` has left
`result.json` beside each `campaign.toml`, `python mujoco_campaign.py judge FOLDER`. `cargo xtask external` does all three.

The arm of the report's 6.2 in its loop at 3 ms, sensors of 12 bits over a turn, steps of 0.1 ms, friction loss tuned as in
with_mujoco.py; eight stepped sines in pairs ω0 and 3ω0, 0.3 to 0.8 rad, half a minute each.
"""

import copy
import json
import math
import sys
from pathlib import Path

import numpy as np

import arm
import with_mujoco

STEP_RAD = 2 * math.pi / 2**12
STEP_S = 1e-4
# ω0 [rad/s] and the reference's amplitude there and at 3ω0 [rad]; the beam's mode is at 6.56 rad/s.
PAIRS = [(1.0, 0.8, 0.8), (1.7, 0.7, 0.6), (2.9, 0.6, 0.5), (4.3, 0.4, 0.3)]
WAIT_S, RECORD_S = 30.0, 30.0
INTEGRATORS = ("implicitfast", "RK4")
# Relative errors that are allowed.
BOUNDS = {"Coulomb friction": 3e-3, "inertia": 5e-3, "frequency": 2e-3}


def runs(e):
    for omega, slow, fast in PAIRS:
        for frequency, amplitude in ((omega, slow), (3 * omega, fast)):
            one = copy.copy(e)
            one.omega_rad_s, one.amplitude_rad = frequency, amplitude
            one.samples = round((WAIT_S + RECORD_S) / e.sample_time_s)
            yield one


def counts(angles):
    return np.round(angles / STEP_RAD).astype(int)


def write_one(e, integrator, folder):
    folder.mkdir(parents=True, exist_ok=True)
    text = [
        "[signals]",
        f"sample_time = {e.sample_time_s!r}",
        'current = { column = 1, unit = "A", hold = "sampled" }',
        f'motor = {{ column = 2, unit = "rad", scale = {STEP_RAD!r} }}',
        f'tips = [{{ name = "tip", column = 3, unit = "rad", scale = {STEP_RAD!r} }}]',
        "[drive]",
        f"torque_constant = {e.torque_constant_nm_per_a!r}",
        f"current_limit = {e.limit_a!r}",
    ]
    for k, one in enumerate(runs(e), 1):
        currents, states = with_mujoco.run(one, STEP_S, integrator, lambda a: round(a / STEP_RAD) * STEP_RAD)
        first = round(WAIT_S / e.sample_time_s)
        rows = zip(currents[first:].tolist(), counts(states[first:, 0]), counts(states[first:, 1]))
        Path(folder, f"run-{k}.csv").write_text("".join(f"{i!r},{m},{t}\n" for i, m, t in rows))
        text += ["[[runs]]", f'file = "run-{k}.csv"', f"omega_rad_s = {one.omega_rad_s!r}"]
    Path(folder, "campaign.toml").write_text("\n".join(text) + "\n")


def truth(e):
    # The clamped mode of one mass: its undamped frequency is the size of its pole.
    frequency = math.sqrt(e.stiffness[1, 1] / e.inertia[0])
    return {"Coulomb friction": e.forward_nm, "inertia": e.inertia_kg_m2, "frequency": frequency}


def found(path):
    result = json.loads(path.read_text())
    modes = result["beam"]["modes"]
    figures = [result["friction"]["coulomb"], result["drive"]["inertia"], modes[0]["natural_frequency_rad_s"]]
    return dict(zip(BOUNDS, figures))


def judge(e, folder):
    broken = 0
    print("| MuJoCo | figure | true | found | error | bound | deviations |\n|---|---|---|---|---|---|---|")
    for integrator in INTEGRATORS:
        figures = found(folder / integrator / "result.json")
        for name, true in truth(e).items():
            if figures[name] is None:
                print(f"| {integrator} | {name} | {true:.6g} | refused | | | |")
                broken += 1
                continue
            value, std = figures[name]["value"], figures[name]["std"]
            error = value / true - 1
            print(f"| {integrator} | {name} | {true:.6g} | {value:.6g} | {100 * error:+.2g} % | {100 * BOUNDS[name]:g} % "
                  f"| {(value - true) / std:+.1f} |")
            broken += abs(error) > BOUNDS[name]
    print(f"\n{'every bound holds' if not broken else f'{broken} bounds are broken'}")
    return 1 if broken else 0


def main(what, folder):
    e = next(e for e in arm.load(folder) if e.name == "one mass, slow")
    into = Path(folder, "mujoco")
    if what == "judge":
        return judge(e, into)
    for integrator in INTEGRATORS:
        write_one(e, integrator, into / integrator)
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
