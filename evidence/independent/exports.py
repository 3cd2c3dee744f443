"""What `lissom export` writes, loaded by the programs that it is for: python-control, scipy.io, MuJoCo.

Usage: exports.py LISSOM RESULT FOLDER, with the command, a result.json of the demo (and its arm.toml beside it), and a
folder to write into.
"""

import json
import runpy
import subprocess
import sys
from pathlib import Path

import control
import mujoco
import numpy as np
import scipy.io

import chains

lissom, result_file, folder = sys.argv[1], sys.argv[2], Path(sys.argv[3])
folder.mkdir(parents=True, exist_ok=True)
result = json.load(open(result_file))
models, arm = result["models"], result["arm"]


def export(target, name):
    path = folder / name
    subprocess.run([lissom, "export", result_file, "--to", target, "--out", path], check=True, stdout=subprocess.DEVNULL)
    return path


def near(what, found, wanted, share):
    off = abs(found / wanted - 1)
    print(f"{what}: {found:.6g}, wanted {wanted:.6g}, off by {100 * off:.4f} %")
    assert off <= share, what


# python-control
script = runpy.run_path(export("python", "arm.py"))
omega = np.geomspace(0.3, 60.0, 50)
wanted = np.polyval(models["motor"]["num"], 1j * omega) / np.polyval(models["motor"]["den"], 1j * omega)
for name, found in [("tf", script["motor"](1j * omega)), ("ss", script["arm"](1j * omega)[0, 0])]:
    near(f"python-control {name}", 1 + np.max(np.abs(found / wanted - 1)), 1.0, 1e-8)
near("python-control friction", script["friction"](1.0), arm["coulomb"] + arm["offset"], 1e-9)

# scipy.io
mat = scipy.io.loadmat(export("mat", "arm.mat"), simplify_cells=True)["lissom"]
found = np.polyval(mat["num"], 1j * omega) / np.polyval(mat["den"], 1j * omega)
near("scipy.io num/den", 1 + np.max(np.abs(found / wanted - 1)), 1.0, 1e-8)
space = control.ss(mat["a"], np.reshape(mat["b"], (-1, 1)), mat["c"], np.reshape(mat["d"], (-1, 1)))
near("scipy.io state space", 1 + np.max(np.abs(space(1j * omega)[0, 0] / wanted - 1)), 1.0, 1e-8)
assert len(mat["responses"]["omega"]) == mat["responses"]["raw"].shape[1]

# MuJoCo: friction from the command that just moves the motor, the mode from its free decay with the motor held
model = mujoco.MjModel.from_xml_path(str(export("mjcf", "arm.xml")))
data = mujoco.MjData(model)
step = model.opt.timestep
mode = arm["modes"][0]


def held_speed(command, seconds):
    mujoco.mj_resetData(model, data)
    data.ctrl[0] = command
    for _ in range(int(seconds / step)):
        mujoco.mj_step(model, data)
    return data.qvel[0]


low, high = 0.0, 2 * arm["coulomb"] / result["torque_per_command"]
for _ in range(12):
    middle = 0.5 * (low + high)
    low, high = (middle, high) if abs(held_speed(middle, 0.5)) < 1e-3 else (low, middle)
near("MuJoCo friction", 0.5 * (low + high) * result["torque_per_command"], arm["coulomb"], 0.02)

mujoco.mj_resetData(model, data)
data.qpos[1] = 0.05 * arm["coulomb"] / mode["stiffness"] * 10
angle = []
for _ in range(int(8.0 / step)):
    mujoco.mj_step(model, data)
    angle.append(data.qpos[1])
angle = np.array(angle)
assert abs(data.qpos[0]) < 1e-3, "the motor should stick"
rising = np.flatnonzero((angle[:-1] < 0) & (angle[1:] >= 0))
period = np.mean(np.diff(rising)) * step
ratio = result["beam"]["modes"][0]["damping_ratio"]["value"]
wanted_omega = result["beam"]["modes"][0]["natural_frequency_rad_s"]["value"] * np.sqrt(1 - ratio**2)
near("MuJoCo mode", 2 * np.pi / period, wanted_omega, 0.02)
peaks = [angle[a:b].max() for a, b in zip(rising[:-1], rising[1:])]
decrement = np.mean(np.log(np.array(peaks[:-1]) / np.array(peaks[1:])))
near("MuJoCo damping ratio (free decay)", decrement / (2 * np.pi), ratio, 0.05)

# Arms of known dimensions: the beam as a chain of hinges. The last two are the arm of the 1989 report.
figures = Path(__file__).parents[2] / "crates/lissom-cli/src/commands/report_figures/arm.toml"
chains.check(lissom, folder / "chains", {"demo": Path(result_file).parent / "arm.toml", "report-figures": figures})
