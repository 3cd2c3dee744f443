"""MuJoCo's own identification, `mujoco.sysid`, and lissom on the same logs: `python sysid.py compare FOLDER LISSOM`, where LISSOM is
the command; called by `cargo xtask external`. `python sysid.py tune FOLDER` tries every setting in TRIED.

The logs are those of rigid.py. Both leave a table in FOLDER and on the standard output. `compare` ends with 1 where lissom breaks a
bound; mujoco.sysid has none.
"""

import contextlib
import io
import json
import os
import subprocess
import sys
import time
from dataclasses import dataclass, replace
from importlib.metadata import version
from pathlib import Path

# The toolbox runs its simulations in threads of its own.
for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"

import mujoco  # noqa: E402
import numpy as np  # noqa: E402
from mujoco import sysid  # noqa: E402
from scipy.signal import savgol_filter  # noqa: E402

import rigid  # noqa: E402

# Calls that are timed, and the time of one [s] beyond which it is the only one.
REPEATS, LONG_S = 3, 20.0
GRAVITY_M_S2 = 9.81
# Where the search starts, as a multiple of the true value, and its bounds, as a factor to both sides.
START = {"inertia": 1.6, "viscous": 0.5, "coulomb": 0.6, "sine": 1.5, "cosine": 0.5}
BOUND = 10.0
# Samples of the polynomial of degree three whose slope is the speed.
SPEED_SAMPLES = 11
# Relative errors that lissom may have, of a held command and of a noisy measured current.
LISSOM_BOUNDS = {False: {"quick": 1e-3, "normal": 1e-4}, True: {"quick": 5e-3, "normal": 5e-3}}
LABELS = {"inertia": "inertia", "viscous": "viscous friction", "coulomb": "Coulomb friction", "gravity": "m·g·l"}


@dataclass(frozen=True)
class Settings:
    """How mujoco.sysid is used. As they stand, they are those of its tutorial."""

    name: str
    step_s: float = rigid.SAMPLE_S
    integrator: str = "Euler"
    # Friction that sticks within a step and hardly creeps; else MuJoCo's own, which takes 20 ms and creeps.
    hard_friction: bool = False
    # Parts of the log that are simulated from a measured state each; the whole log where it is 0.
    window_s: float = 0.0
    # Time stamps are corrected for what MuJoCo's step does to them, and residuals are in steps of the encoder.
    careful: bool = False
    # Weight of the speed against the angle [s]; no speed where it is 0.
    speed_weight_s: float = 0.0
    optimizer: str = "mujoco"
    options: tuple = ()
    # Settings whose result is the start.
    begin: "Settings | None" = None

    def delay_s(self):
        """What a predicted reading's time stamp is late by."""
        # A reading is that of the state before the step, with the time after it; an angle that is stepped with the new speed
        # (all but RK4) is ahead by half a step.
        return self.step_s * (1.0 if self.integrator == "RK4" else 0.5) if self.careful else 0.0


SCALED = (("x_scale", "jac"),)
TUTORIAL = Settings("as in the tutorial")
HARD = replace(TUTORIAL, name="1: friction that sticks, `implicitfast`", integrator="implicitfast", hard_friction=True)
CAREFUL = replace(HARD, name="2: 1 with stamps corrected, `x_scale`", careful=True, options=SCALED)
ONE_MS = replace(CAREFUL, name="3: 2 with steps of 1 ms", step_s=1e-3)
SCIPY = replace(ONE_MS, name="4: 3 with scipy's optimizer", optimizer="scipy_parallel_fd")
FINE = replace(SCIPY, name="5: 4 with steps of 0.2 ms, from the result of 4", step_s=2e-4, begin=SCIPY,
               options=(*SCALED, ("diff_step", 1e-4), ("ftol", 1e-6), ("xtol", 1e-6)))
FINEST = replace(FINE, name="5 with steps of 0.1 ms", step_s=1e-4)
TRIED = [
    TUTORIAL,
    HARD,
    CAREFUL,
    ONE_MS,
    SCIPY,
    FINE,
    FINEST,
    replace(FINE, name="5 with RK4", integrator="RK4"),
    replace(FINE, name="5 with MuJoCo's optimizer", optimizer="mujoco", options=(*SCALED, ("eps", 1e-5), ("xtol", 1e-5))),
    replace(FINE, name="5 with windows of 1 s", window_s=1.0),
    replace(SCIPY, name="4 with windows of 1 s", window_s=1.0),
    replace(SCIPY, name="4 with windows of 0.2 s", window_s=0.2),
    replace(SCIPY, name="4 with windows of 0.2 s, angle and speed", window_s=0.2, speed_weight_s=0.02),
    replace(SCIPY, name="4 with RK4", integrator="RK4"),
    replace(SCIPY, name="4 with MuJoCo's own friction", hard_friction=False),
]
# The rows of `compare`.
COMPARED = {"as in the tutorial": TUTORIAL, "tuned, steps of 0.2 ms": FINE, "tuned, steps of 0.1 ms": FINEST}


def joint(settings):
    stick = ""
    if settings.hard_friction:
        stick = f'solreffriction="{2 * settings.step_s} 1" solimpfriction="0.99999 0.99999 0.001 0.5 2"'
    speed = '<jointvel name="speed" joint="joint"/>' if settings.speed_weight_s else ""
    return mujoco.MjSpec.from_string(f"""
    <mujoco>
      <compiler boundmass="0" boundinertia="0"/>
      <option timestep="{settings.step_s!r}" integrator="{settings.integrator}" gravity="0 {-GRAVITY_M_S2} 0" tolerance="1e-14">
        <flag contact="disable"/>
      </option>
      <worldbody>
        <body name="load"><inertial pos="0 0 0" mass="1e-9" diaginertia="1e-12 1e-12 1e-12"/>
          <joint name="joint" type="hinge" axis="0 0 1" {stick}/></body>
      </worldbody>
      <actuator><motor name="torque" joint="joint"/></actuator>
      <sensor><jointpos name="angle" joint="joint"/>{speed}</sensor>
    </mujoco>""")


def build_model(params, spec):
    value = {name: params[name].value[0] for name in params.keys()}
    turning = spec.joint("joint")
    turning.armature = value["inertia"]
    turning.damping[0] = value["viscous"]
    turning.frictionloss = value["coulomb"]
    if "sine" in value:
        # A mass of 1 kg where it has both coefficients; what it adds to the inertia is taken off the armature.
        x, y = value["cosine"] / GRAVITY_M_S2, -value["sine"] / GRAVITY_M_S2
        load = spec.body("load")
        load.mass, load.ipos = 1.0, [x, y, 0.0]
        turning.armature = max(value["inertia"] - (x * x + y * y), 1e-6)
    return spec.compile()


def true_parameters(case):
    true = {"inertia": case.inertia_kg_m2, "viscous": case.viscous_nm_s_per_rad, "coulomb": case.coulomb_nm}
    if case.gravity_nm:
        true["sine"], true["cosine"] = case.gravity_coefficients()
    return true


def packed(case, settings):
    """The log in windows, each with its initial state, torque at every step, and readings."""
    spec = joint(settings)
    model = spec.compile()
    speed = savgol_filter(case.angle, SPEED_SAMPLES, 3, deriv=1, delta=rigid.SAMPLE_S)
    torque = case.torque_constant_nm_per_a * case.current
    steps, most = round(rigid.SAMPLE_S / settings.step_s), case.angle.size
    width = round(settings.window_s / rigid.SAMPLE_S) if settings.window_s else most
    names, states, controls, readings = [], [], [], []
    for first in range(0, most - width + 1, width):
        rows = slice(first, min(first + width + 1, most))
        # The log begins at rest.
        start = speed[first] if first else 0.0
        t = rigid.SAMPLE_S * np.arange(case.angle[rows].size)
        fine = settings.step_s * np.arange((t.size - 1) * steps + 1)
        held = np.repeat(torque[rows], steps)[: fine.size]
        applied = np.interp(fine, t, torque[rows]) if case.measured else held
        shown = [case.angle[rows]] + ([speed[rows]] if settings.speed_weight_s else [])
        names.append(f"from {first}")
        states.append(sysid.create_initial_state(model, case.angle[[first]], np.array([start])))
        controls.append(sysid.TimeSeries.from_control_names(fine, applied[:, None], model))
        readings.append(sysid.TimeSeries.from_names(t + settings.delay_s(), np.column_stack(shown), model))
    return sysid.ModelSequences("joint", spec, names, states, controls, readings)


def identify(case, settings):
    """The estimates, and the rms residual of the angle over the encoder's step."""
    true = true_parameters(case)
    start = {name: START[name] * value for name, value in true.items()}
    if settings.begin:
        start, _ = identify(case, settings.begin)
    params = sysid.ParameterDict()
    for name, value in true.items():
        params.add(sysid.Parameter(name, start[name], value / BOUND, value * BOUND))
    options = {}
    if settings.careful:
        transform = sysid.SignalTransform(normalize=False)
        weights = {"angle": 1.0, "speed": settings.speed_weight_s} if settings.speed_weight_s else {"angle": 1.0}
        transform.set_sensor_weights({sensor: weight / rigid.STEP_RAD for sensor, weight in weights.items()})
        options["modify_residual"] = transform.apply
    residual = sysid.build_residual_fn(models_sequences=[packed(case, settings)], build_model=build_model, **options)
    # The optimizer reports its steps.
    with contextlib.redirect_stdout(io.StringIO()):
        found, result = sysid.optimize(params, residual, optimizer=settings.optimizer, verbose=False, **dict(settings.options))
    _, predicted, measured = residual(result.x, found)
    apart = np.concatenate([p[0].data[:, 0] - m[0].data[:, 0] for p, m in zip(predicted, measured)]) / rigid.STEP_RAD
    return {name: found[name].value[0] for name in true}, float(np.sqrt(np.mean(apart**2)))


def errors(case, found):
    """Relative errors of what both identify: gravity's size from its two coefficients."""
    found = dict(found)
    if "sine" in found:
        found["gravity"] = float(np.hypot(found.pop("sine"), found.pop("cosine")))
    return {name: found[name] / true - 1 for name, true in case.truth().items()}


def lissom_estimates(path):
    result = json.loads(path.read_text())
    estimates = {
        "inertia": result["drive"]["inertia"],
        "viscous": result["friction"]["viscous"],
        "coulomb": result["friction"]["coulomb"],
    }
    if result.get("gravity"):
        estimates["gravity"] = result["gravity"]["amplitude"]
    return {name: estimate["value"] for name, estimate in estimates.items()}


def by_lissom(program, campaign, effort):
    result = campaign.with_name(f"{effort}.json")
    done = subprocess.run([program, "identify", campaign, "--effort", effort, "--json", result], capture_output=True, text=True)
    if done.returncode not in (0, 3):
        raise RuntimeError(done.stderr)
    return lissom_estimates(result)


def median(f):
    """Median time of a call by the clock, and of all processors that worked for it [s], and what it gives."""
    clock, processors, given = [], [], None
    for _ in range(REPEATS):
        start, used = time.perf_counter(), sum(os.times()[:4])
        given = f()
        clock.append(time.perf_counter() - start)
        processors.append(sum(os.times()[:4]) - used)
        if clock[0] > LONG_S:
            break
    return sorted(clock)[len(clock) // 2], sorted(processors)[len(clock) // 2], given


class Table:
    """A table in Markdown, row by row, on the standard output and in a file."""

    def __init__(self, path, head):
        self.file = open(path, "w", encoding="utf-8")
        self.row(head)
        self.line("|" + "---|" * len(head))

    def row(self, cells):
        self.line("| " + " | ".join(cells) + " |")

    def line(self, text):
        print(text, flush=True)
        self.file.write(text + "\n")
        self.file.flush()


def percent(error):
    """Two digits, none below 0.0001 %."""
    percents = 100 * error
    if abs(percents) < 1e-4:
        return "< 0.0001 %"
    return f"{float(f'{percents:+.2g}'):+f}".rstrip("0").rstrip(".") + " %"


def seconds(time_s):
    return f"{float(f'{time_s:.2g}'):g} s"


def cells(found):
    return [percent(found[name]) if name in found else "" for name in LABELS]


def compare(folder, program):
    print(f"\nmujoco {version('mujoco')}, start within a factor of two, bounds a tenth and ten times\n")
    broken = []
    table = Table(folder / "sysid.md", ["case", "", "samples", "time", "processor time", *LABELS.values()])
    for case in rigid.cases():
        true = case.truth()
        units = {"inertia": "kg·m²", "viscous": "N·m·s/rad"}
        values = [f"{true[name]:g} {units.get(name, 'N·m')}" if name in true else "" for name in LABELS]
        table.row([case.title, "true value", str(case.angle.size), "", "", *values])
        campaign = case.write(folder / "sysid" / case.name)
        for effort, most in LISSOM_BOUNDS[case.measured].items():
            label = "lissom --quick" if effort == "quick" else "lissom"
            *times, found = median(lambda: by_lissom(program, campaign, effort))
            found = {name: found[name] / true[name] - 1 for name in true}
            table.row(["", label, "", *map(seconds, times), *cells(found)])
            broken += [f"{case.title}, {label}, {LABELS[name]}: {percent(e)}, and {percent(most)} is allowed"
                       for name, e in found.items() if abs(e) > most]
        for label, settings in COMPARED.items():
            *times, (found, _) = median(lambda: identify(case, settings))
            table.row(["", f"mujoco.sysid, {label}", "", *map(seconds, times), *cells(errors(case, found))])
    for line in broken:
        print(f"\nBROKEN: {line}")
    print(f"\n{'every bound holds' if not broken else f'{len(broken)} bounds are broken'}")
    return 1 if broken else 0


def tune(folder):
    """A row for every setting: errors [%], rms residual [steps of the encoder] and processor time [s] of each case."""
    cases = rigid.cases()
    table = Table(folder / "sysid-tried.md", ["settings", *(case.title for case in cases), "residuals", "processor time"])
    for settings in TRIED:
        shown, left, times = [], [], []
        for case in cases:
            start = time.process_time()
            found, residual = identify(case, settings)
            times.append(seconds(time.process_time() - start).removesuffix(" s"))
            shown.append(", ".join(percent(error).removesuffix(" %") for error in errors(case, found).values()))
            left.append(f"{float(f'{residual:.2g}'):g}")
        table.row([settings.name, *shown, ", ".join(left), ", ".join(times) + " s"])
    return 0


def main(what, folder, *rest):
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    # Compiles the simulator, and reads MuJoCo in.
    rigid.cases()
    return compare(folder, *rest) if what == "compare" else tune(folder)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
