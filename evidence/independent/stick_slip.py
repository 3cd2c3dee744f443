"""An arm with a joint that sticks, under held torques: DOP853 [HairerNorsettWanner1993] compiled by numba.

The coefficients are scipy's; steps and events are written here and share no code with lissom. Within a sample every step's
error is estimated and held below TOLERANCE; the motor's stop, and the instant at which friction lets go, are found by
bisection on the length of the step, each trial integrated anew. Velocities that touch zero within a step are looked for where
their slope changes sign. State: [angles, rates] of motor and masses.
"""

import numpy as np
from numba import njit
from scipy.integrate._ivp import dop853_coefficients as dop

A, B, C = dop.A[:12, :12].copy(), dop.B.copy(), dop.C[:12].copy()
E3, E5 = dop.E3.copy(), dop.E5.copy()
# Error of a step, of angles [rad] and rates over the sample rate alike.
TOLERANCE = 1e-13
# Longest step, as a share of a sample.
LONGEST = 0.5
# Pieces shorter than this share of a sample are rounding.
LEAST = 1e-13
BISECTIONS = 60


@njit(cache=True)
def gravity(angle, arm):
    """Torque of an unbalanced load against the motor, of the motor's angle."""
    if arm[2, 0] == 0.0 and arm[2, 1] == 0.0:
        return 0.0
    return arm[2, 0] * np.sin(angle) + arm[2, 1] * np.cos(angle)


@njit(cache=True)
def pull(i, x, turn):
    """Torque of stiffness and damping against angle i. turn: columns of stiffness, then of damping."""
    found = 0.0
    for j in range(x.size):
        found += turn[i, j] * x[j]
    return found


@njit(cache=True)
def rates(x, torque, way, turn, arm, out):
    """dx/dt. arm: rows of inertias, of the motor's friction forward and backward, and of the coefficients of sine and cosine in
    gravity's torque; turn: matrices of stiffness and damping in their angles and rates, side by side."""
    n = x.size // 2
    for i in range(n):
        out[i] = x[n + i]
        out[n + i] = -pull(i, x, turn) / arm[0, i]
    if way == 0:
        out[0] = 0.0
        out[n] = 0.0
    else:
        friction = arm[1, 0] if way > 0 else -arm[1, 1]
        out[n] += (torque - friction - gravity(x[0], arm)) / arm[0, 0]


@njit(cache=True)
def step(x, h, torque, way, turn, arm, k, y):
    """One step of length h into y; its error, rates counted over a sample."""
    m = x.size
    for s in range(12):
        for i in range(m):
            sum_ = 0.0
            for r in range(s):
                sum_ += A[s, r] * k[r, i]
            y[i] = x[i] + h * sum_
        rates(y, torque, way, turn, arm, k[s])
    for i in range(m):
        sum_ = 0.0
        for s in range(12):
            sum_ += B[s] * k[s, i]
        y[i] = x[i] + h * sum_
    rates(y, torque, way, turn, arm, k[12])
    five, three = 0.0, 0.0
    for i in range(m):
        weight = 1.0 if i < m // 2 else h
        a, b = 0.0, 0.0
        for s in range(13):
            a += E5[s] * k[s, i]
            b += E3[s] * k[s, i]
        five += (weight * a) ** 2
        three += (weight * b) ** 2
    if five == 0.0 and three == 0.0:
        return 0.0
    return h * five / np.sqrt((five + 0.01 * three) * m)


@njit(cache=True)
def watched(x, torque, way, turn, arm):
    """What must stay positive in this phase, and its slope: speed along the way, or friction left (the less of both sides)."""
    n = x.size // 2
    net = torque - gravity(x[0], arm) - pull(0, x, turn)
    if way != 0:
        friction = arm[1, 0] if way > 0 else -arm[1, 1]
        return way * x[n], way * (net - friction) / arm[0, 0]
    change = 0.0
    for j in range(n):
        change += turn[0, j] * x[n + j]
    for j in range(1, n):
        change -= turn[0, n + j] * pull(j, x, turn) / arm[0, j]
    if arm[1, 0] - net < net + arm[1, 1]:
        return arm[1, 0] - net, change
    return net + arm[1, 1], -change


@njit(cache=True)
def first(x, h, want_slope, torque, way, turn, arm, k, y):
    """Length of the shortest of the halved steps up to h after which what is watched (or its slope) has changed sign."""
    low, high = 0.0, h
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        step(x, middle, torque, way, turn, arm, k, y)
        value, slope = watched(y, torque, way, turn, arm)
        past = slope > 0.0 if want_slope else value < 0.0
        if past:
            high = middle
        else:
            low = middle
    return high


@njit(cache=True)
def from_rest(x, torque, turn, arm):
    net = torque - gravity(x[0], arm) - pull(0, x, turn)
    if net > arm[1, 0]:
        return 1
    if net < -arm[1, 1]:
        return -1
    return 0


@njit(cache=True)
def advance(x, way, torque, sample_s, turn, arm, k, y):
    """Moves x by a sample under a held torque; gives the phase at its end and the time stuck."""
    n = x.size // 2
    at, stuck = 0.0, 0.0
    if way == 0:
        way = from_rest(x, torque, turn, arm)
    while sample_s - at > LEAST * sample_s:
        h = min(LONGEST * sample_s, sample_s - at)
        while step(x, h, torque, way, turn, arm, k, y) > TOLERANCE:
            h *= 0.5
        before, after = watched(x, torque, way, turn, arm), watched(y, torque, way, turn, arm)
        event = after[0] < 0.0
        if not event and before[1] < 0.0 and after[1] > 0.0:
            # Falling, then rising: what is watched may have been below zero between.
            low = first(x, h, True, torque, way, turn, arm, k, y)
            step(x, low, torque, way, turn, arm, k, y)
            if watched(y, torque, way, turn, arm)[0] < 0.0:
                event, h = True, low
            else:
                step(x, h, torque, way, turn, arm, k, y)
        if event:
            h = first(x, h, False, torque, way, turn, arm, k, y)
            step(x, h, torque, way, turn, arm, k, y)
        x[:] = y
        at += h
        if way == 0:
            stuck += h
        if event and way != 0:
            x[n] = 0.0
        if event:
            way = from_rest(x, torque, turn, arm)
    return way, stuck


@njit(cache=True)
def loop(reference, noise, steps, pd, sample_s, limit, constant, turn, arm, wait, keep_states):
    """The sampled PD loop from rest. noise: a row a sample, motor first; steps: of each sensor.

    Gives currents and readings of the samples from `wait` on, the state there, the share stuck, and all states.
    """
    m = 2 * turn.shape[0]
    n, samples = m // 2, reference.size
    x, y, k = np.zeros(m), np.zeros(m), np.zeros((13, m))
    currents = np.empty(samples - wait)
    counts = np.empty((samples - wait, n))
    start = np.zeros(m)
    states = np.empty((samples if keep_states else 0, m))
    way, before, rate, stuck = 0, 0.0, 0.0, 0.0
    for s in range(samples):
        if s == wait:
            start[:] = x
        if keep_states:
            states[s] = x
        error = reference[s] - round((x[0] + noise[s, 0]) / steps[0]) * steps[0]
        change = pd[1] * (error - before) if s > 0 else 0.0
        before = error
        rate = (pd[2] * rate + change) / (pd[2] + sample_s)
        current = min(max(pd[0] * error + rate, -limit), limit)
        if s >= wait:
            currents[s - wait] = current
            for i in range(n):
                counts[s - wait, i] = round((x[i] + noise[s, i]) / steps[i])
        way, rested = advance(x, way, constant * current, sample_s, turn, arm, k, y)
        if s >= wait:
            stuck += rested
    return currents, counts, start, stuck / ((samples - wait) * sample_s), states
