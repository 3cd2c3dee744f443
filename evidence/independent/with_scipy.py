"""The experiments by scipy: DOP853 with terminal events, and true sticking."""

import numpy as np
from scipy.integrate import solve_ivp

RTOL = 1e-12
ATOL = 1e-14
# Pieces shorter than this share of a sample are rounding.
LEAST = 1e-12
# First piece of a slip from rest, as a share of a sample.
HAIR = 1e-9


class Joint:
    def __init__(self, e):
        self.e, self.n = e, 1 + e.masses
        self.way = 0  # 0 sticks, 1 forward, -1 backward

    def coupling(self, x):
        return self.e.stiffness[0] @ x[: self.n]

    def field(self, torque):
        e, n, way = self.e, self.n, self.way
        friction = e.forward_nm if way > 0 else -e.backward_nm

        def f(_, x):
            bend, rate, out = e.stiffness @ x[:n], x[n:], np.empty(2 * n)
            out[:n] = rate
            out[n + 1 :] = -(bend[1:] + e.drag * rate[1:]) / e.inertia
            if way:
                net = torque - friction - bend[0] - e.viscous_nm_s_per_rad * rate[0]
                out[n] = net / e.inertia_kg_m2
            else:
                out[0] = out[n] = 0.0
            return out

        return f

    def events(self, torque):
        """Zero velocity while slipping; a limit of friction reached while sticking."""
        if self.way:

            def stops(_, x):
                return x[self.n]

            stops.terminal, stops.direction = True, -self.way
            return [stops]

        def forward(_, x):
            return torque - self.coupling(x) - self.e.forward_nm

        def backward(_, x):
            return torque - self.coupling(x) + self.e.backward_nm

        forward.terminal = backward.terminal = True
        forward.direction, backward.direction = 1, -1
        return [forward, backward]

    def from_rest(self, torque, x):
        net = torque - self.coupling(x)
        return int(net > self.e.forward_nm) - int(net < -self.e.backward_nm)

    def advance(self, torque, x):
        at, end = 0.0, self.e.sample_time_s
        if self.way == 0:
            self.way = self.from_rest(torque, x)
        while end - at > LEAST * end:
            if self.way and x[self.n] == 0.0:
                # Off the zero that the event function would take for the next stop.
                x = x + HAIR * end * self.field(torque)(at, x)
                at += HAIR * end
            done = solve_ivp(self.field(torque), (at, end), x, method="DOP853", rtol=RTOL, atol=ATOL,
                             events=self.events(torque))
            if not done.success:
                raise RuntimeError(done.message)
            x, at = done.y[:, -1], done.t[-1]
            if done.status == 1 and self.way:
                x[self.n] = 0.0
                self.way = self.from_rest(torque, x)
            elif done.status == 1:
                self.way = 1 if done.t_events[0].size else -1
        return x


def run(e):
    """Current and state [angles, rates] at every sample."""
    joint, current = Joint(e), e.controller()
    x = np.zeros(2 * joint.n)
    currents, states = np.empty(e.samples), np.empty((e.samples, x.size))
    for k in range(e.samples):
        currents[k] = current(k, x[0])
        states[k] = x
        x = joint.advance(e.torque_constant_nm_per_a * currents[k], x)
    return currents, states
