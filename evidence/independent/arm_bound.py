"""Cramér-Rao bound [Kay1993] of an outside arm's parameters, at the truth and with the noise of the measured current.

Outputs are predicted by the Kalman filter of the true arm, whose process noise is that of the current. With the motion known, the
arm is linear between stops and reversals of the hub, so derivatives of the innovations by the parameters follow a linear
recursion, with the filter's gains:

    dx <- F dx + (dF x + dG u),   dv = -(C dx + dC x),   dx <- dx + K dv,   information = sum of dv' S^-1 dv

F, G: over a sample, of the mode at its start (forward, backward, at rest); dF, dG, dC: differences by each parameter. At a stop dx
of the hub's rate ends; at a reversal it is multiplied by the ratio of the accelerations after and before. Initial states are
unknown. Each parameter is counted relative to its value, and is known beforehand to that size.
"""

import numpy as np
from scipy.linalg import expm

DIFFERENCE = 1e-5


def parameters(arm):
    """By name, the values that the bound is about: hub, frictions, and of each mode inertia, frequency, damping, share."""
    beam, kinds = arm.beam, {"within": arm.damping - arm.ground, "ground": arm.ground}
    found = {"hub": arm.hub + beam.inertia - (beam.part**2).sum(), "viscous": arm.viscous}
    found |= {"forward": arm.coulomb + arm.offset, "backward": arm.coulomb - arm.offset}
    for k in range(beam.omega.size):
        found |= {f"inertia {k}": beam.part[k] ** 2, f"omega {k}": beam.omega[k], f"share {k}": arm.tip_shares()[k]}
        found |= {f"{kind} {k}": ratios[k] for kind, ratios in kinds.items() if ratios[k] > 0.0}
    return found


class Model:
    """F, G (of a mean torque, and of one) and C of each mode of the hub, for some parameters."""

    def __init__(self, arm, p):
        n, self.hub = 1 + arm.beam.omega.size, p["hub"]
        of = lambda name: np.array([p.get(f"{name} {k}", 0.0) for k in range(n - 1)])
        inertia, omega, share = of("inertia"), of("omega"), of("share")
        within, ground = 2 * of("within") * omega * inertia, 2 * of("ground") * omega * inertia
        a = np.zeros((2 * n, 2 * n))
        a[:n, n:] = np.eye(n)
        for part, at in ((inertia * omega**2, 0), (within, n)):
            a[n, at] -= part.sum() / p["hub"]
            a[n, at + 1 : at + n] += part / p["hub"]
            a[range(n + 1, 2 * n), at] += part / inertia
            a[range(n + 1, 2 * n), range(at + 1, at + n)] -= part / inertia
        a[n, n] -= p["viscous"] / p["hub"]
        a[range(n + 1, 2 * n), range(n + 1, 2 * n)] -= ground / inertia
        self.modes = {}
        for way in (1, -1, 0):
            own, b = a.copy(), np.zeros((2 * n, 2))
            if way == 0:
                own[0] = own[n] = 0.0
            else:
                b[n] = [1 / p["hub"], -(p["forward"] if way > 0 else -p["backward"]) / p["hub"]]
            whole = expm(arm.sample_s * np.block([[own, b], [np.zeros((2, 2 * n + 2))]]))
            c, d = np.zeros((2, 2 * n)), np.zeros((2, 2))
            c[0, 0] = 1.0
            if arm.kind == "accelerometer":
                c[1] = arm.beam.length * ((1 - share.sum()) * own[n] + share @ own[n + 1 :])
                d[1] = arm.beam.length * (1 - share.sum()) * b[n]
            else:
                c[1, 1:n], c[1, 0] = share, (arm.kind != "gauge") - share.sum()
            self.modes[way] = (whole[: 2 * n, : 2 * n], whole[: 2 * n, 2 * n :], c, d)


def of_run(arm, model, changed, names, states, torque, sensors, torque_noise):
    """Information of one run on the parameters, relative to their values."""
    n, m = states.shape[1] // 2, states.shape[1]
    ways = np.sign(states[:, n]).astype(int)
    covariance = np.diag(np.concatenate([np.full(n, 1.0), np.full(n, 1e4)]))
    dx, information = np.zeros((m, len(names))), np.zeros((len(names), len(names)))
    noise = np.diag(np.square(sensors))
    slopes = {}
    for way in (1, -1, 0):
        of = [(up.modes[way], down.modes[way]) for up, down in changed]
        slopes[way] = [np.array([(up[i] - down[i]) / (2 * DIFFERENCE) for up, down in of]) for i in range(4)]
    for k in range(len(states) - 1):
        way, x, u = ways[k], states[k], np.array([torque[k], 1.0])
        f, g, c, _ = model.modes[way]
        df, dg, dc, dd = slopes[way]
        seen = covariance @ c.T
        s = c @ seen + noise
        gain = np.linalg.solve(s, seen.T).T
        change = c @ dx + (dc @ x + dd @ u).T
        information += change.T @ np.linalg.solve(s, change)
        dx, covariance = dx - gain @ change, covariance - gain @ seen.T
        mean = np.array([0.5 * (torque[k] + torque[k + 1]), 1.0])
        dx = f @ dx + (df @ x + dg @ mean).T
        covariance = f @ covariance @ f.T + np.outer(g[:, 0], g[:, 0]) * torque_noise**2
        after = ways[k + 1]
        if after == 0:
            covariance[n], covariance[:, n], dx[n] = 0.0, 0.0, 0.0
        elif after == -way:
            free = (states[k + 1, n] - x[n]) / arm.sample_s
            jump = 2 * arm.coulomb / model.hub
            # Of the accelerations before and after, the mean is about that over the sample.
            ratio = min(max((abs(free) - 0.5 * jump) / (abs(free) + 0.5 * jump), 0.0), 1.0)
            dx[n], covariance[n], covariance[:, n] = ratio * dx[n], ratio * covariance[n], ratio * covariance[:, n]
        covariance = 0.5 * (covariance + covariance.T)
    return information


def bounds(arm, runs):
    """Relative bound by name of what is compared, for an arm with the modes from the first on whose inertia has a bound below one
    half. `runs`: states, torques, the sensors' noise and the torque's, of each run."""
    p = parameters(arm)
    names = list(p)
    model = Model(arm, p)
    changed = [[Model(arm, {**p, name: p[name] * (1 + sign * DIFFERENCE)}) for sign in (1, -1)] for name in names]
    information = np.eye(len(names)) + sum(of_run(arm, model, changed, names, *run) for run in runs)
    covariance = np.linalg.inv(information)
    at = {name: i for i, name in enumerate(names)}
    known = [np.sqrt(covariance[at[f"inertia {k}"], at[f"inertia {k}"]]) < 0.5 for k in range(arm.beam.omega.size)]
    modes = known.index(False) if False in known else len(known)

    def std(parts):
        """Of a sum, by the derivatives of it by the logarithms of parameters."""
        row = np.zeros(len(names))
        for name, slope in parts.items():
            row[at[name]] = slope
        return float(np.sqrt(row @ covariance @ row))

    inertia, omega = arm.beam.part**2, arm.beam.omega
    truth = arm.truth(modes)
    found = {"inertia": std({"hub": p["hub"], **{f"inertia {k}": inertia[k] for k in range(modes, omega.size)}}) / truth["inertia"]}
    found["coulomb"] = std({name: p[name] / 2 for name in ("forward", "backward")}) / arm.coulomb
    above = {f"ground {k}": 2 * arm.ground[k] * omega[k] * inertia[k] for k in range(modes, omega.size) if arm.ground[k] > 0}
    found["viscous"] = std({"viscous": arm.viscous, **above}) / truth["viscous"]
    stiffness = inertia * omega**2
    parts = [{f"inertia {k}": stiffness[k], f"omega {k}": 2 * stiffness[k]} for k in range(modes)]
    found["coupling"] = std({k: v for part in parts for k, v in part.items()}) / max(truth["coupling"], 1e-300)
    for k in range(modes):
        found[f"omega {k + 1}"] = std({f"omega {k}": 1.0})
        kinds = [kind for kind in ("within", "ground") if f"{kind} {k}" in at]
        found[f"zeta {k + 1}"] = std({f"{kind} {k}": p[f"{kind} {k}"] for kind in kinds}) / arm.damping[k]
    return found
