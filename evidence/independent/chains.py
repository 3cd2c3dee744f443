"""Arms of known dimensions that `lissom export --to mjcf` writes as a chain of hinges, checked in MuJoCo."""

import json
import subprocess

import mujoco
import numpy as np
import scipy.linalg

# A uniform beam with a payload, a stepped beam on a hub, masses on spans without mass, and a stiff uniform beam.
ARMS = {
    "uniform": """
[beam]
young_modulus = "70 GPa"
section = { rectangle = ["30 mm", "2 mm"] }
density = "2700 kg/m^3"
spans = [{ length = "500 mm" }]
payload = { mass = "0.1 kg" }
damping = { stiffness_proportional = "2e-3 s" }
""",
    "stepped": """
[beam]
young_modulus = "70 GPa"
density = "2700 kg/m^3"
hub_radius = "20 mm"
spans = [{ length = "250 mm", section = { rectangle = ["30 mm", "3 mm"] }, mass = "50 g", damping = "0.02 N*s/m" },
         { length = "300 mm", section = { rectangle = ["30 mm", "2 mm"] } }]
payload = { mass = "0.1 kg", inertia = "5e-5 kg*m^2", offset = "20 mm" }
damping = { mass_proportional = "0.2 1/s", stiffness_proportional = "2e-4 s" }
""",
    "two-masses": """
[beam]
flexural_rigidity = "0.9 N*m^2"
spans = [{ length = "0.2 m", mass = "0.15 kg" }, { length = "0.3 m", mass = "0.1 kg" }]
damping = { ratios = [0.01, 0.03] }
""",
    "three-masses": """
[beam]
flexural_rigidity = "0.9 N*m^2"
spans = [{ length = "0.1 m", mass = "0.15 kg", damping = "0.05 N*s/m" }, { length = "0.2 m", mass = "0.1 kg" },
         { length = "0.2 m", mass = "0.05 kg", inertia = "1e-4 kg*m^2" }]
damping = { mass_proportional = "0.1 1/s", stiffness_proportional = "3e-4 s" }
""",
    "light-tip": """
[beam]
flexural_rigidity = "20 N*m^2"
mass_per_length = "0.4 kg/m"
spans = [{ length = "0.8 m" }]
damping = { stiffness_proportional = "1e-4 s" }
""",
}
DRIVE = """
[drive]
inertia = "2e-3 kg*m^2"
viscous = "5e-3 N*m*s/rad"
torque_constant = "0.2 N*m/A"
coulomb = "0.05 N*m"
"""
# Natural frequencies that a model of an arm may have.
MODES = 4


def near(what, found, wanted, share):
    off = found / wanted - 1
    print(f"{what}: {found:.6g}, wanted {wanted:.6g}, off by {100 * off:.4f} %")
    assert abs(off) <= share, what


def matrices(model, data):
    """Mass, stiffness and damping of the joints: `mj_fullM`, and central differences of the passive forces."""
    data.qpos[:] = data.qvel[:] = 0
    mujoco.mj_forward(model, data)
    mass = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, mass)
    made = []
    for vector in (data.qpos, data.qvel):
        matrix = np.empty_like(mass)
        for k in range(model.nv):
            forces = []
            for step in (1e-6, -1e-6):
                vector[k] = step
                mujoco.mj_forward(model, data)
                forces.append(data.qfrc_passive.copy())
            vector[k] = 0
            matrix[:, k] = (forces[1] - forces[0]) / 2e-6
        made.append(matrix)
    return mass, *made


def poles(mass, stiffness, damping):
    """Roots with positive imaginary part, by size."""
    n = len(mass)
    state = np.block([[np.zeros((n, n)), np.eye(n)], [-np.linalg.solve(mass, stiffness), -np.linalg.solve(mass, damping)]])
    roots = np.linalg.eigvals(state)
    roots = roots[roots.imag > 1e-3]
    return roots[np.argsort(np.abs(roots))]


def responses(model, data, chain, omega):
    """The motor's angle per torque without dry friction, and each site's angle per motor angle, by the matrices."""
    mass, stiffness, damping = chain
    load = np.zeros(model.nv)
    load[0] = 1
    joints = np.array([np.linalg.solve(-w * w * mass + 1j * w * damping + stiffness, load) for w in omega])
    data.qpos[:] = data.qvel[:] = 0
    mujoco.mj_forward(model, data)
    tips = []
    for site in range(model.nsite):
        moves = np.zeros((3, model.nv))
        mujoco.mj_jacSite(model, data, moves, None, site)
        tips.append(joints @ moves[1] / data.site_xpos[site, 0] / joints[:, 0])
    return joints[:, 0], tips


def decay(model, data, shape, omega, periods):
    """Frequency and damping ratio of the tip's free decay, the motor held by an inertia that nothing turns."""
    mujoco.mj_resetData(model, data)
    motor = model.dof_armature[0]
    model.dof_armature[0] = 1e9
    data.qpos[1:] = shape
    site = model.nsite - 1
    every = max(1, round(2 * np.pi / omega / model.opt.timestep / 400))
    y = []
    for _ in range(int(2 * np.pi / omega * periods / model.opt.timestep / every)):
        mujoco.mj_step(model, data, every)
        mujoco.mj_kinematics(model, data)
        y.append(data.site_xpos[site, 1])
    model.dof_armature[0] = motor
    y, h = np.array(y), every * model.opt.timestep
    rising = np.flatnonzero((y[:-1] < 0) & (y[1:] >= 0))
    crossing = (rising - y[rising] / (y[rising + 1] - y[rising])) * h
    period = np.mean(np.diff(crossing))
    energy = [np.sqrt(np.mean(y[a:b] ** 2)) for a, b in zip(rising[:-1], rising[1:])]
    decrement = np.mean(np.log(np.array(energy[:-1]) / np.array(energy[1:]))) / (2 * np.pi)
    return 2 * np.pi / period, decrement / np.sqrt(1 + decrement**2)


def moved(model, data, command, seconds):
    """Angle of the motor after a constant command."""
    mujoco.mj_resetData(model, data)
    data.ctrl[0] = command
    mujoco.mj_step(model, data, int(seconds / model.opt.timestep))
    return data.qpos[0]


def check_arm(lissom, name, file, folder):
    """One arm: frequencies, damping, the motor's response, a free decay, friction."""
    path, described = folder / f"{name}.xml", folder / f"{name}.json"
    subprocess.run([lissom, "export", file, "--to", "mjcf", "--out", path], check=True, stdout=subprocess.DEVNULL)
    command = [lissom, "model", file, "--json", described, "--all", "--omega", "0.5:300:200"]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    known = json.loads(described.read_text())
    model = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(model)
    mass, stiffness, damping = matrices(model, data)
    held = slice(1, None)
    values, shapes = scipy.linalg.eigh(stiffness[held, held], mass[held, held])
    free = np.sqrt(np.abs(scipy.linalg.eigh(stiffness, mass, eigvals_only=True)))[1:]
    for what, found, wanted in [
        ("motor held", np.sqrt(values), known["natural_frequencies_rad_s"]),
        ("motor free", free, known["coupled_frequencies_rad_s"]),
    ]:
        for k, (f, w) in enumerate(zip(found[:MODES], wanted)):
            near(f"{name}: mode {k + 1}, {what}", f, w, 0.005)
    mass_kg = sum(known["mass_kg"]) + known["mass_along_kg"] + known["payload"]["mass_kg"]
    near(f"{name}: mass", np.sum(model.body_mass), mass_kg, 1e-6)
    near(f"{name}: inertia", mass[0, 0] - model.dof_armature[0], known["inertia_kg_m2"], 1e-6)

    roots = poles(mass[held, held], stiffness[held, held], damping[held, held])
    wanted = [complex(p["re"], p["im"]) for p in known["transfer_functions"][0]["poles"]]
    wanted = sorted((p for p in wanted if p.imag > 0), key=abs)
    print(f"{name}: damping ratios", [f"{-r.real / abs(r):.5f}" for r in roots[:MODES]])
    if known["kind"] == "lumped":
        for k, (f, w) in enumerate(zip(roots, wanted)):
            near(f"{name}: damping ratio of mode {k + 1}", -f.real / abs(f), -w.real / abs(w), 0.005)

    # Damping of a distributed beam too, and the sites: responses by lissom. A frequency that is off by 0.1 % shows as more
    # at a resonance, so the limit is on the median.
    answer = known["frequency_response"]
    number = lambda series: np.array([complex(v["re"], v["im"]) for v in series])
    motor, tips = responses(model, data, (mass, stiffness, damping), np.array(answer["omega_rad_s"]))
    by_torque = number(answer["motor_rad_per_a"]) / model.actuator_gear[0, 0]
    # A friction law with a change near rest has another viscous friction than the pair.
    pairs = [("motor", motor, by_torque)] if "least-squares line" not in path.read_text() else []
    for i, (name_of, series) in enumerate(zip(answer["to"], answer["tips"])):
        site = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_SITE, name_of.replace("theta", "mass"))
        pairs.append((f"site {i + 1}", tips[site], number(series)))
    for what, found, known_series in pairs:
        off = np.abs(found / known_series - 1)
        print(f"{name}: response of the {what}: off by {100 * np.median(off):.4f} % in the median, {100 * off.max():.3f} % at most")
        assert np.median(off) < 0.005

    # The pole by lissom: with damping for a lumped beam; a distributed one has lissom's frequency, and the damping ratio
    # of the chain, which the responses above confirm.
    first = wanted[0] if known["kind"] == "lumped" else roots[0] / abs(roots[0]) * known["natural_frequencies_rad_s"][0]
    shape = shapes[:, 0] / (shapes[:, 0] @ np.ones(model.nv - 1)) * 0.02
    found_omega, found_ratio = decay(model, data, shape, abs(first), 8)
    near(f"{name}: free decay, frequency", found_omega, first.imag, 0.02)
    near(f"{name}: free decay, damping ratio", found_ratio, -first.real / abs(first), 0.05)

    threshold = model.dof_frictionloss[0] / model.actuator_gear[0, 0]
    stays, goes = (moved(model, data, share * threshold, 1.0) for share in (0.97, 1.03))
    print(f"{name}: at 97 % of the friction the motor turns by {stays:.1e} rad in 1 s, at 103 % by {goes:.1e} rad")
    assert abs(stays) < 0.1 * abs(goes)


LOAD = """
[beam]
rigid = true
[load]
gravity_torque = "2 N*m"
phase = "30 deg"
"""


def check_load(lissom, folder):
    """A rigid joint: the torque of its load's gravity, and the inertia that body and armature share."""
    file, path = folder / "load.toml", folder / "load.xml"
    file.write_text(LOAD + DRIVE)
    subprocess.run([lissom, "export", file, "--to", "mjcf", "--out", path], check=True, stdout=subprocess.DEVNULL)
    model = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(model)
    for angle in (0.0, 1.0, -2.0):
        data.qpos[0] = angle
        mujoco.mj_forward(model, data)
        near(f"load: torque of gravity at {angle} rad", data.qfrc_bias[0], 2 * np.sin(angle + np.radians(30)), 1e-6)
    inertia = np.zeros((1, 1))
    mujoco.mj_fullM(model, data, inertia)
    near("load: inertia", inertia[0, 0], 2e-3, 1e-6)


def check(lissom, folder, files):
    """All arms: those above, and files by name."""
    folder.mkdir(parents=True, exist_ok=True)
    check_load(lissom, folder)
    for name, beam in ARMS.items():
        file = folder / f"{name}.toml"
        file.write_text(beam + DRIVE)
        check_arm(lissom, name, file, folder)
    for name, file in files.items():
        check_arm(lissom, name, file, folder)
