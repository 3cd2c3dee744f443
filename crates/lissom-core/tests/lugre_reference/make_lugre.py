#!/usr/bin/env python3
"""lugre.json: the report's one-mass arm on LuGre bristles under held torques, solved by scipy.

J th'' = T - V th' - k (th - tt) - F,  m l^2 tt'' = k (th - tt) - 0.06 m l^2 tt',  k = 3 E I / l
z' = v - s0 |v|/g z,  F = s0 z + s1 z',  g = Fc + (Fs - Fc) exp(-(v/vs)^2), Fc and Fs by direction
T = a sin(3 t) + b cos(19 t), sampled and held over 3 ms.

Radau, rtol 1e-12, started anew at every sample and at every zero of v (a terminal event): each piece is smooth.
`apart`: the largest distance to DOP853 (rtol 2.3e-14, no events) in [th, th', tt, tt', z*s0/Fs].
Run: python make_lugre.py > lugre.json (scipy 1.17.1, numpy 2.4.6)
"""
import json
import math

import numpy as np
from scipy.integrate import solve_ivp

INCH, LBF, LB = 0.0254, 4.4482216152605, 0.45359237
L, M = 7 * INCH, 0.121 * LB
EI = 30e6 * LBF / INCH**2 * math.pi * (0.032 * INCH) ** 4 / 64
J, V = 0.005529 * LBF * INCH, 0.01216 * LBF * INCH
K, DRAG, MASS = 3 * EI / L, 0.06 * M * L * L, M * L * L
SAMPLE, AT = 0.003, [1, 5, 20, 50, 100, 150, 200, 250, 300]


def field(law, torque):
    s0, s1, vs = law["sigma0"], law["sigma1"], law["stribeck"]

    def f(_, x):
        th, v, tt, w, z = x
        way = 0 if v >= 0 else 1
        fc, fs = law["coulomb"][way], law["at_rest"][way]
        g = fc + (fs - fc) * math.exp(-((v / vs) ** 2))
        dz = v - s0 * abs(v) / g * z
        bend = K * (th - tt)
        return [v, (torque - V * v - bend - s0 * z - s1 * dz) / J, w, (bend - DRAG * w) / MASS, dz]

    return f


def crossing(_, x):
    return x[1]


crossing.terminal = True


def run(case, method, rtol, events):
    law = case["law"]
    deflection = max(law["at_rest"]) / law["sigma0"]
    atol = rtol * deflection * np.array([1, 100, 1, 1, 1])
    x, kept = np.array(case["initial"]), []
    for k in range(max(AT)):
        t = k * SAMPLE
        torque = case["a"] * math.sin(3 * t) + case["b"] * math.cos(19 * t)
        f, at = field(law, torque), 0.0
        while at < SAMPLE:
            done = solve_ivp(f, (at, SAMPLE), x, method=method, rtol=rtol, atol=atol,
                             events=crossing if events else None)
            assert done.success, done.message
            x, at = done.y[:, -1].copy(), done.t[-1]
            if done.status == 1:
                x[1] = 0.0
                # Beyond the zero: a Taylor step too short to matter, so that the event is not met again.
                nudge = min(1e-13, SAMPLE - at)
                x, at = x + nudge * np.array(f(0, x)), at + nudge
        if k + 1 in AT:
            kept.append(x.copy())
    return np.array(kept), deflection


def case(name, deflection, sigma1, coulomb, at_rest, stribeck, a, b, initial):
    law = {"sigma0": at_rest[0] / deflection, "sigma1": sigma1, "coulomb": coulomb, "at_rest": at_rest,
           "stribeck": stribeck}
    made = {"name": name, "law": law, "a": a, "b": b, "initial": initial}
    kept, z = run(made, "Radau", 1e-12, True)
    other, _ = run(made, "DOP853", 2.3e-14, False)
    apart = np.abs(kept - other).max(axis=0) / [1, 1, 1, 1, z]
    made["apart"] = apart.tolist()
    made["samples"] = [{"k": k, "state": x.tolist()} for k, x in zip(AT, kept)]
    return made


REST = [0.0] * 5
FC = 0.0326
cases = [
    case("soft", 1e-3, 0.02, [FC, FC], [1.3 * FC, 1.3 * FC], 0.1, 0.12, 0.03, REST),
    case("by direction", 1e-4, 0.03, [FC, 0.8 * FC], [1.3 * FC, 1.2 * FC], 0.1, 0.12, 0.03, REST),
    case("stiff", 1e-5, 0.05, [FC, 0.8 * FC], [1.3 * FC, 1.2 * FC], 0.1, 0.12, 0.03, REST),
    case("presliding", 1e-4, 0.005, [FC, FC], [FC, FC], 0.1, 0.01, 0.015, REST),
    case("release", 1e-4, 0.03, [FC, FC], [1.2 * FC, FC], 0.05, 0.0, 0.0, [0, 0, 0.8, 0, 0]),
]
print(json.dumps({"sample_time_s": SAMPLE, "cases": cases}, indent=1))
