"""Writes scipy-multisine.csv and mujoco-multisine.csv beside itself, in half a minute.

Two simulators that share no code with lissom move the same arm, a motor and a beam of one mode,
under the same sampled control:

    J th_m'' = K i - V th_m' - kappa (th_m - th_t) - F(th_m')
    th_t''   = w2 (th_m - th_t) - d th_t'

scipy: DOP853 with events. Where its velocity reaches zero the motor sticks or turns back; where
the torque on it reaches the friction of either direction it slips.
mujoco: RK4, friction as a constraint of its solver. The motor creeps a little in place of sticking.
"""
# /// script
# dependencies = ["mujoco==4.0.0", "numpy==2.4.6", "scipy==1.17.1"]
# ///

import math
from pathlib import Path

import mujoco
import scipy
from scipy.integrate import solve_ivp

# The arm, as in main.rs; then sampling, control and sensors.
J, V, K = 0.0012, 0.004, 0.35  # kg m^2, N m s/rad, N m/A
KAPPA, W2, D = 0.4, 121.0, 0.3  # N m/rad, rad^2/s^2, 1/s
T = 0.002  # s
SETTLE, KEPT = 10_000, 6_000  # samples: 20 s that are dropped, 12 s that are kept
KP, KD, LIMIT = 10.0, 0.2, 5.0  # A/rad, A s/rad, A
COUNT, MRAD = 2 * math.pi / 2**13, 1e-3  # rad: the steps of the encoder and of the tip's sensor

# Short steps for the events' sake: none passes over a velocity that barely changes its sign.
PRECISION = {"rtol": 1e-12, "atol": 1e-14, "max_step": T / 20}

# The reference: multiples of 0.1 Hz, with amplitude and phase in rad.
LINES = [
    (1, 0.45, 0.84), (3, 0.25, 2.57), (5, 0.20, 3.01), (9, 0.15, 5.36), (13, 0.12, 4.05),
    (17, 0.08, 0.70), (23, 0.08, 3.31), (29, 0.06, 1.89), (37, 0.05, 2.80),
]  # fmt: skip


def reference(t):
    return sum(a * math.sin(2 * math.pi * 0.1 * n * t + p) for n, a, p in LINES)


def counts(angle, step):
    return math.floor(angle / step + 0.5)


def terminal(event):
    event.terminal, event.direction = True, -1
    return event


class Events:
    # x: th_m, th_m', th_t, th_t'; sign: of the motor's velocity, 0 where it sticks.
    name = f"scipy {scipy.__version__}, DOP853 with events"

    def __init__(self, forward, backward):
        self.forward, self.backward, self.x, self.sign = forward, backward, [0.0] * 4, 0

    def angles(self):
        return self.x[0], self.x[2]

    def direction(self, current):
        torque = K * current - KAPPA * (self.x[0] - self.x[2])
        return 1 if torque > self.forward else -1 if torque < -self.backward else 0

    def hold(self, current):
        t, self.sign = 0.0, self.sign or self.direction(current)
        for _ in range(50):
            slope, events = self.slope(current), self.events(t, current)
            s = solve_ivp(slope, (t, T), self.x, "DOP853", events=events, **PRECISION)
            t, self.x = s.t[-1], s.y[:, -1].copy()
            if s.status == 0:
                return
            if self.sign:
                self.x[1], self.sign = 0.0, self.direction(current)
            else:
                self.sign = 1 if s.t_events[0].size else -1
        raise RuntimeError("too many events in one sample")

    def slope(self, current):
        friction = {1: self.forward, -1: -self.backward, 0: 0.0}[self.sign]

        def slope(_, x):
            bend = x[0] - x[2]
            motor = (K * current - V * x[1] - KAPPA * bend - friction) / J if self.sign else 0.0
            return [x[1], motor, x[3], W2 * bend - D * x[3]]

        return slope

    def events(self, start, current):
        if self.sign:
            # A motor that starts may be back at velocity zero within the first step of the solver.
            start = start + 1e-7 if self.x[1] == 0.0 else -1.0
            return [terminal(lambda t, x: self.sign * x[1] if t > start else 1.0)]
        torque = lambda x: K * current - KAPPA * (x[0] - x[2])
        ahead = terminal(lambda _, x: self.forward - torque(x))
        return [ahead, terminal(lambda _, x: self.backward + torque(x))]


class Mujoco:
    # Two hinges on one axis, a tendon as the spring; friction as hard as one step lets it be.
    name = f"mujoco {mujoco.__version__}, RK4 at 0.25 ms"
    STEP = 0.00025  # s

    def __init__(self, friction):
        tip = KAPPA / W2
        self.model = mujoco.MjModel.from_xml_string(f"""<mujoco>
 <option timestep="{self.STEP}" gravity="0 0 0" integrator="RK4" solver="Newton" tolerance="1e-14"
  iterations="100" ls_iterations="100" ls_tolerance="1e-8">
  <flag contact="disable" refsafe="disable"/></option>
 <worldbody>
  <body><inertial pos="0 0 0" mass="1e-3" diaginertia="1e-7 1e-7 1e-7"/>
   <joint name="m" axis="0 0 1" armature="{J - 1e-7}" damping="{V}" frictionloss="{friction}"
    solreffriction="-1 {-1 / self.STEP}" solimpfriction="0.9999 0.9999 0.001 0.5 2"/></body>
  <body><inertial pos="0 0 0" mass="1" diaginertia="{tip} {tip} {tip}"/>
   <joint name="t" axis="0 0 1" damping="{tip * D}"/></body>
 </worldbody>
 <tendon><fixed stiffness="{KAPPA}" springlength="0">
  <joint joint="m" coef="1"/><joint joint="t" coef="-1"/></fixed></tendon>
 <actuator><motor joint="m" gear="{K}"/></actuator></mujoco>""")
        self.data = mujoco.MjData(self.model)

    def angles(self):
        return self.data.qpos

    def hold(self, current):
        self.data.ctrl[0] = current
        mujoco.mj_step(self.model, self.data, round(T / self.STEP))


def write(file, arm, friction):
    about = f"# Simulated by make.py: {arm.name}; Coulomb friction {friction}."
    rows, before = [about, "i_a,motor_counts,tip_mrad"], None
    for k in range(SETTLE + KEPT):
        n, tip = (counts(x, step) for x, step in zip(arm.angles(), (COUNT, MRAD)))
        error = reference(k * T) - n * COUNT
        rate, before = (error - before) / T if k else 0.0, error
        # Rounded before it is applied: the log has the very current.
        current = round(max(-LIMIT, min(LIMIT, KP * error + KD * rate)), 6)
        if k >= SETTLE:
            rows.append(f"{current:.6f},{n},{tip}")
        arm.hold(current)
    (Path(__file__).parent / file).write_text("\n".join(rows) + "\n")


write("scipy-multisine.csv", Events(0.09, 0.075), "0.09 N m forward, 0.075 N m backward")
write("mujoco-multisine.csv", Mujoco(0.085), "0.085 N m either way")
