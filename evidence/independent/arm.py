"""An experiment of lissom's `external` example: the arm from its dimensions, and the loop."""

import json
import math
from pathlib import Path

import numpy as np


class Experiment:
    def __init__(self, given, folder):
        self.__dict__.update(given)
        log = np.loadtxt(Path(folder, f"{self.name}.csv"), delimiter=",")
        self.current, self.states = log[:, 0], log[:, 1:]
        length = np.cumsum([s["length_m"] for s in self.spans])
        mass = np.array([s["mass_kg"] for s in self.spans])
        damping = np.array([s["damping_n_s_per_m"] for s in self.spans])
        (rigidity,) = {s["flexural_rigidity_n_m2"] for s in self.spans}
        near, far = np.minimum.outer(length, length), np.maximum.outer(length, length)
        # A clamped beam's deflection at one point per force at another.
        stiffness = np.linalg.inv(near**2 * (3 * far - near) / (6 * rigidity))
        # In angles of [motor, masses], with L_i (θ_i − θ_m) for deflections.
        self.inertia = mass * length**2
        self.drag = damping * length**2
        self.masses = len(mass)
        bend = np.column_stack([-length, np.diag(length)])
        self.stiffness = bend.T @ stiffness @ bend

    def controller(self):
        """The PD loop: current [A] for sample k and the motor's angle there."""
        p, d, limit = self.proportional_a_per_rad, self.derivative_a_s_per_rad, self.limit_a
        t, a, w = self.sample_time_s, self.amplitude_rad, self.omega_rad_s
        before = 0.0

        def current(k, angle):
            nonlocal before
            error = a * math.sin(w * (k * t)) - angle
            demand = p * error + d * (error - before) / t
            before = error
            return min(max(demand, -limit), limit)

        return current


def load(folder):
    return [Experiment(given, folder) for given in json.loads(Path(folder, "experiments.json").read_text())]


def harmonics(experiment, current):
    """First and third harmonic of the current over the last two thirds [A], by least squares on 15."""
    k = np.arange(experiment.samples // 3, experiment.samples)
    phase = experiment.omega_rad_s * experiment.sample_time_s * k
    columns = [np.ones_like(phase)]
    for n in range(1, 16):
        columns += [np.cos(n * phase), np.sin(n * phase)]
    fit = np.linalg.lstsq(np.column_stack(columns), current[k], rcond=None)[0]
    return [complex(fit[2 * n - 1], -fit[2 * n]) for n in (1, 3)]
