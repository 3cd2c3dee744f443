"""Reference motions for tests/rig_world: `python make.py > reference.json`.

Written from the equations alone: stiffness of a massless beam by flexibility integrals, masses as
they are, an adaptive Runge-Kutta of order 8 (scipy's DOP853, rtol 1e-12) between events, events by
scipy's root finding, and true sticking. Needs numpy and scipy.
"""

import json

import numpy as np
from scipy.integrate import solve_ivp

RTOL, ATOL = 1e-12, 1e-14


class Arm:
    def __init__(self, spans, motor, damping=0.0):
        """spans: (length, EI, mass); motor: (J, V); damping at the last mass in N*s/m."""
        self.J, self.V = motor
        l = np.array([s[0] for s in spans])
        ei = np.array([s[1] for s in spans])
        self.m = np.array([s[2] for s in spans])
        self.L = np.cumsum(l)
        n = len(spans)
        ends = np.concatenate([[0], self.L])
        f = np.zeros((n, n))
        for i in range(n):
            for j in range(n):
                for k in range(n):
                    # moment (L_i - x)(L_j - x)/EI over span k
                    a, b = ends[k], min(ends[k + 1], self.L[i], self.L[j])
                    if b > a:
                        p = np.polyint(np.poly1d([1, -(self.L[i] + self.L[j]), self.L[i] * self.L[j]]))
                        f[i, j] += (p(b) - p(a)) / ei[k]
        self.K = np.linalg.inv(f)  # forces per deflection
        self.c = damping

    def swap(self, masses):
        other = Arm.__new__(Arm)
        other.__dict__.update(self.__dict__)
        other.m = np.array(masses)
        return other


def simulate(arm, friction, world, torques, dt, x0=None, changes=()):
    n = len(arm.m)
    x = np.zeros(2 + 2 * n) if x0 is None else np.array(x0, float)
    tip_coulomb = world.get("coulomb", 0.0)
    walls = world.get("walls", [])
    visc = world.get("viscous", 0.0)
    force_of = world.get("force", lambda t: 0.0)
    log, sticks_s = [], 0.0
    joint = int(np.sign(x[1]))
    tip = int(np.sign(x[1 + 2 * n]))
    touch = [w["sign"] * (x[1 + n] - w["at"]) > 0 for w in walls]

    def fric(v, th, d):
        fc = friction["forward"] if d > 0 else friction["backward"]
        fs = friction.get("rest", (friction["forward"], friction["backward"]))[0 if d > 0 else 1]
        g = 0.0
        if "vs" in friction:
            u = abs(v) / friction["vs"]
            g = np.exp(-u) if friction["falloff"] == "exponential" else np.exp(-u * u)
        out = fc + (fs - fc) * g
        if "ripple" in friction:
            r, per, ph = friction["ripple"]
            mean = 0.5 * (friction["forward"] + friction["backward"])
            out += r * mean * np.cos(per * th + ph)
        return out

    def parts(x):
        """Deflection forces on the masses, coupling torque."""
        y = arm.L * (x[2:2 + n] - x[0])
        f = -arm.K @ y
        ct = arm.L @ f  # about the axis
        return f, ct

    def tip_push(t, x, f):
        """All on the tip's mass but dry friction."""
        out = f[-1] + force_of(t) - (visc + arm.c) * arm.L[-1] * x[1 + 2 * n]
        for w, on in zip(walls, touch):
            if on:
                out -= w["k"] * arm.L[-1] * (x[1 + n] - w["at"])
        return out

    def rhs(t, x, tau):
        f, ct = parts(x)
        out = np.zeros_like(x)
        if joint:
            out[0] = x[1]
            out[1] = (tau - arm.V * x[1] - ct - joint * fric(x[1], x[0], joint)) / arm.J
        out[2:2 + n] = x[2 + n:]
        a = f.copy()
        a[-1] = tip_push(t, x, f)
        if tip_coulomb:
            a[-1] = 0.0 if tip == 0 else a[-1] - tip * tip_coulomb
        out[2 + n:] = a / arm.m / arm.L
        return out

    def joint_net(t, x, tau):
        return tau - parts(x)[1]

    def decide(t, tau):
        nonlocal joint, tip
        if x[1] == 0:
            net = joint_net(t, x, tau)
            joint = 1 if net > fric(0, x[0], 1) else -1 if net < -fric(0, x[0], -1) else 0
        if tip_coulomb and x[1 + 2 * n] == 0:
            p = tip_push(t, x, parts(x)[0])
            tip = 1 if p > tip_coulomb else -1 if p < -tip_coulomb else 0

    t = 0.0
    changes = list(changes)
    for k, tau in enumerate(torques):
        end = (k + 1) * dt
        while True:
            decide(t, tau)
            stop = end
            if changes and changes[0][0] < stop:
                stop = changes[0][0]
            ev = []

            def add(fn, direction, what):
                fn.terminal, fn.direction = True, direction
                ev.append((fn, what))

            if joint:
                add(lambda t, x, tau, s=joint: s * x[1] if t > t0 + 1e-9 or x0v != 0 else 1e-9, -1, "joint stop")
            else:
                add(lambda t, x, tau: fric(0, x[0], 1) - joint_net(t, x, tau), -1, "joint go")
                add(lambda t, x, tau: fric(0, x[0], -1) + joint_net(t, x, tau), -1, "joint go")
            if tip_coulomb:
                if tip:
                    add(lambda t, x, tau, s=tip: s * x[1 + 2 * n] if t > t0 + 1e-9 or x0t != 0 else 1e-9, -1, "tip stop")
                else:
                    add(lambda t, x, tau: tip_coulomb - tip_push(t, x, parts(x)[0]), -1, "tip go")
                    add(lambda t, x, tau: tip_coulomb + tip_push(t, x, parts(x)[0]), -1, "tip go")
            for i, w in enumerate(walls):
                s = w["sign"] * (1 if touch[i] else -1)
                add(lambda t, x, tau, w=w, s=s: s * (x[1 + n] - w["at"]), -1, i)
            t0, x0v, x0t = t, x[1], x[1 + 2 * n]
            sol = solve_ivp(rhs, (t, stop), x, method="DOP853", rtol=RTOL, atol=ATOL, args=(tau,),
                            events=[e[0] for e in ev], max_step=0.01)
            x = sol.y[:, -1].copy()
            if joint == 0:
                sticks_s += sol.t[-1] - t
            t = sol.t[-1]
            if sol.status == 1:
                hit = [what for (_, what), found in zip(ev, sol.t_events) if len(found)]
                for what in hit:
                    if what == "joint stop":
                        x[1] = 0.0
                    elif what == "tip stop":
                        x[1 + 2 * n] = 0.0
                    elif what == "joint go":
                        net = joint_net(t, x, tau)
                        joint = 1 if net > 0 else -1
                    elif what == "tip go":
                        tip = 1 if tip_push(t, x, parts(x)[0]) > 0 else -1
                    else:
                        touch[what] = not touch[what]
                if "joint go" in hit or "tip go" in hit:
                    # Past the limit by a rounding, so that `decide` agrees.
                    keep = (joint, tip)
                    sol = solve_ivp(rhs, (t, t + 1e-9), x, method="DOP853", rtol=RTOL, atol=1e-18, args=(tau,))
                    x, t = sol.y[:, -1].copy(), t + 1e-9
                    joint, tip = keep
                continue
            t = stop
            if changes and t == changes[0][0]:
                arm = arm.swap(changes.pop(0)[1])
                if t < end:
                    continue
            if t == end:
                break
        log.append(x.tolist())
    return {"states": log, "stuck_s": sticks_s}


ONE = Arm([(0.2, 0.005, 0.05)], (6e-4, 1e-3), damping=2e-3)
TWO = Arm([(0.15, 0.02, 0.05), (0.15, 0.01, 0.04)], (8e-4, 1e-3))
COULOMB = {"forward": 0.03, "backward": 0.025}
rng = np.random.default_rng(4)
TORQUES = [round(float(v), 4) for v in rng.uniform(-0.12, 0.12, 40)]
DT = 0.05

cases = {
    "plain": (ONE, COULOMB, {}, {}),
    "stribeck_exponential": (ONE, {**COULOMB, "rest": (0.05, 0.04), "vs": 0.2, "falloff": "exponential"}, {}, {}),
    "stribeck_gaussian": (TWO, {**COULOMB, "rest": (0.045, 0.05), "vs": 0.3, "falloff": "gaussian"}, {}, {}),
    "sublinear": (ONE, {"forward": 0.05, "backward": 0.045, "rest": (0.03, 0.03), "vs": 1.5, "falloff": "exponential"}, {}, {}),
    "ripple": (ONE, {**COULOMB, "ripple": (0.4, 12.0, 0.3)}, {}, {}),
    "ripple_and_stribeck": (TWO, {**COULOMB, "rest": (0.05, 0.04), "vs": 0.2, "falloff": "exponential", "ripple": (0.3, 9.0, -0.5)}, {}, {}),
    "tip_viscous": (TWO, COULOMB, {"viscous": 0.05}, {}),
    "tip_coulomb": (ONE, COULOMB, {"coulomb": 0.06}, {}),
    "tip_coulomb_two": (TWO, COULOMB, {"coulomb": 0.08}, {}),
    "walls": (ONE, COULOMB, {"walls": [{"at": 0.3, "k": 60.0, "sign": 1}, {"at": -0.2, "k": 30.0, "sign": -1}]}, {}),
    "wall_two": (TWO, COULOMB, {"walls": [{"at": 0.2, "k": 100.0, "sign": 1}], "coulomb": 0.02}, {}),
    "tip_force": (TWO, COULOMB, {"force": lambda t: 0.1 * np.sin(5.0 * t + 0.3) + 0.02}, {}),
    "payload": (ONE, COULOMB, {}, {"changes": [(0.73, [0.12]), (1.41, [0.03])]}),
}
out = {"torques": TORQUES, "dt_s": DT, "cases": {}}
for name, (arm, friction, world, more) in cases.items():
    out["cases"][name] = simulate(arm, friction, world, TORQUES, DT, **more)
print(json.dumps(out, indent=1))
