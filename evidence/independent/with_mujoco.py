"""The experiments by MuJoCo: hinges about one axis, joined by tendons that act as springs."""

import mujoco
import numpy as np

# Bodies need some mass; what turns is the joints' armature [kg, kg·m²].
MASS, INERTIA = 1e-6, 1e-12


def model(e, step_s, integrator):
    mean = 0.5 * (e.forward_nm + e.backward_nm)
    # Stick well: the friction constraint asks for rest within a step (time constant of two steps) and yields
    # least (impedance nearly one).
    stick = f'solreffriction="{2 * step_s} 1" solimpfriction="0.99999 0.99999 0.001 0.5 2"'
    turning = [e.inertia_kg_m2, *e.inertia]
    damping = [e.viscous_nm_s_per_rad, *e.drag]
    bodies, hinges = "", range(len(turning))
    for i in hinges:
        friction = f'frictionloss="{mean!r}" {stick}' if i == 0 else ""
        bodies += f"""
        <body><inertial pos="0 0 0" mass="{MASS}" diaginertia="{INERTIA} {INERTIA} {INERTIA}"/>
          <joint name="q{i}" type="hinge" axis="0 0 1" armature="{float(turning[i]) - INERTIA!r}"
                 damping="{float(damping[i])!r}" {friction}/></body>"""
    # The stiffness matrix is a sum of squares: one tendon for each of its eigenvectors that bends the beam.
    values, vectors = np.linalg.eigh(e.stiffness)
    tendons = ""
    for value, vector in zip(values[1:], vectors.T[1:]):
        joints = "".join(f'<joint joint="q{i}" coef="{float(vector[i])!r}"/>' for i in hinges)
        tendons += f'<fixed stiffness="{float(value)!r}" springlength="0">{joints}</fixed>'
    return mujoco.MjModel.from_xml_string(f"""
    <mujoco>
      <compiler boundmass="0" boundinertia="0"/>
      <option timestep="{step_s!r}" integrator="{integrator}" gravity="0 0 0" solver="Newton"
              iterations="100" tolerance="1e-14"/>
      <worldbody>{bodies}</worldbody>
      <tendon>{tendons}</tendon>
    </mujoco>""")


def run(e, step_s, integrator, sense=lambda angle: angle):
    """Current and state [angles, rates] at every sample; the loop's sensor shows `sense` of the motor's angle."""
    made = model(e, step_s, integrator)
    data = mujoco.MjData(made)
    current, steps = e.controller(), round(e.sample_time_s / step_s)
    # MuJoCo has one constant for both directions: what they differ by is a constant load.
    load = 0.5 * (e.forward_nm - e.backward_nm)
    currents, states = np.empty(e.samples), np.empty((e.samples, 2 * made.nv))
    torque, angles, rates = data.qfrc_applied, data.qpos, data.qvel
    for k in range(e.samples):
        states[k, : made.nv], states[k, made.nv :] = angles, rates
        currents[k] = current(k, sense(angles[0]))
        torque[0] = e.torque_constant_nm_per_a * currents[k] - load
        mujoco.mj_step(made, data, steps)
    return currents, states


def step_alone(e, step_s, integrator):
    """The steps of the experiment without loop and log, under a torque that keeps the motor slipping: for their time."""
    made = model(e, step_s, integrator)
    data = mujoco.MjData(made)
    steps, most = round(e.sample_time_s / step_s), 2.0 * max(e.forward_nm, e.backward_nm)
    half = round(np.pi / e.omega_rad_s / e.sample_time_s)
    done = 0
    while done < e.samples:
        data.qfrc_applied[0] = most if done // half % 2 else -most
        many = min(half, e.samples - done)
        mujoco.mj_step(made, data, many * steps)
        done += many
