"""The beams, their frequencies and the exact responses."""

from dataclasses import dataclass, field

import mpmath
import numba
import numpy as np

RIGIDITY_N_M2 = 10.0
# Points of a sweep closer to a pole than this, relatively, are judged by no error.
NEAR_POLE = 1e-6
# Frequencies at which the double-double reference is held against mpmath's 200 bits.
CHECKED = 5


@dataclass
class Beam:
    """Massless spans [m], [N·m²] with a mass [kg] at each outer end, clamped to the motor."""

    name: str
    length: np.ndarray
    rigidity: np.ndarray
    mass: np.ndarray
    omega: np.ndarray = field(default_factory=lambda: np.empty(0))

    @property
    def parts(self):
        return self.length, self.rigidity, self.mass

    @property
    def position(self):
        return np.cumsum(self.length)


def uniform(n):
    """1 m, 1 kg, EI 10 N·m², in n equal parts."""
    return Beam("uniform", np.full(n, 1 / n), np.full(n, RIGIDITY_N_M2), np.full(n, 1 / n))


def contrast(n):
    """As `uniform`, with every other span, from the second, 1e9 times as stiff."""
    beam = uniform(n)
    beam.rigidity[1::2] *= 1e9
    beam.name = "EI 1 : 1e9"
    return beam


def random(n, seed=1):
    """Every length, rigidity and mass times its own 10^(u − 1/2): that of `lissom-testmodels`."""
    mask = (1 << 64) - 1
    state = seed
    rows = np.empty((n, 3))
    for row in rows:
        for k, mean in enumerate((1 / n, RIGIDITY_N_M2, 1 / n)):
            state = (state + 0x9E3779B97F4A7C15) & mask
            z = state
            z = ((z ^ (z >> 30)) * 0xBF58476D1CE4E5B9) & mask
            z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) & mask
            u = ((z ^ (z >> 31)) >> 11) / (1 << 53)
            row[k] = mean * 10 ** (u - 0.5)
    return Beam("random", *(np.ascontiguousarray(column) for column in rows.T))


def flexibility(beam):
    """Deflection at each mass per force at each."""
    at, start = beam.position, beam.position - beam.length
    # ∫ x^k/EI from the clamp to each mass.
    s0, s1, s2 = (
        np.cumsum((at**k - start**k) / (k * beam.rigidity)) for k in (1, 2, 3)
    )
    near = np.minimum.outer(np.arange(at.size), np.arange(at.size))
    return np.multiply.outer(at, at) * s0[near] - np.add.outer(at, at) * s1[near] + s2[near]


def modes(beam):
    """Natural frequencies [rad/s], ascending, and mass-normed shapes, motor clamped."""
    root = np.sqrt(beam.mass)
    values, vectors = np.linalg.eigh(flexibility(beam) * np.multiply.outer(root, root))
    order = np.argsort(values)[::-1]
    values, vectors = values[order], vectors[:, order]
    # The highest may drown in rounding; they are far above any sweep.
    values = np.maximum(values, values[0] * 1e-18)
    return 1 / np.sqrt(values), vectors / root[:, None]


def with_sweep(beam, count=1000):
    """The same with frequencies from a tenth of the first to ten times the twentieth natural one,
    and which of them are judged."""
    natural = modes(beam)[0]
    beam.omega = np.geomspace(0.1 * natural[0], 10 * natural[19], count)
    apart = np.abs(beam.omega[:, None] / natural[None, :] - 1).min(axis=1)
    return beam, apart > NEAR_POLE


# Pairs of doubles (Dekker): numba contracts and reorders nothing with fastmath off.


@numba.njit(inline="always")
def _settled(a, b):
    s = a + b
    return s, b - (s - a)


@numba.njit(inline="always")
def _halves(a):
    t = 134217729.0 * a
    high = t - (t - a)
    return high, a - high


@numba.njit(inline="always")
def _add(x, y):
    s = x[0] + y[0]
    t = s - x[0]
    e = (x[0] - (s - t)) + (y[0] - t)
    v = x[1] + y[1]
    w = v - x[1]
    f = (x[1] - (v - w)) + (y[1] - w)
    s, e = _settled(s, e + v)
    return _settled(s, e + f)


@numba.njit(inline="always")
def _mul(x, y):
    p = x[0] * y[0]
    (a, b), (c, d) = _halves(x[0]), _halves(y[0])
    e = ((a * c - p) + a * d + b * c) + b * d
    return _settled(p, e + (x[0] * y[1] + x[1] * y[0]))


@numba.njit(inline="always")
def _minus(x):
    return -x[0], -x[1]


@numba.njit(inline="always")
def _div(x, y):
    q = x[0] / y[0]
    r = _add(x, _minus(_mul(y, (q, 0.0))))
    s = r[0] / y[0]
    r = _add(r, _minus(_mul(y, (s, 0.0))))
    q, s = _settled(q, s)
    return _add((q, s), (r[0] / y[0], 0.0))


@numba.njit
def _recursion(length, rigidity, mass, omega):
    """θ_n/θ_m and the last pivot in double-double, by the recursion of compliance and motion."""
    zero, one, two, three = (0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (3.0, 0.0)
    c11, c12, c22, d1, d2, total, pivot = zero, zero, zero, zero, one, zero, one
    z = _minus(_mul((omega, 0.0), (omega, 0.0)))
    for i in range(length.size):
        l = (length[i], 0.0)
        f = _div(l, (rigidity[i], 0.0))
        inner = _add(_mul(two, c12), _mul(l, _add(c22, _div(f, three))))
        c11 = _add(c11, _mul(l, inner))
        c12 = _add(c12, _mul(l, _add(c22, _div(f, two))))
        c22 = _add(c22, f)
        d1 = _add(d1, _mul(l, d2))
        total = _add(total, l)
        mu = _mul(z, (mass[i], 0.0))
        pivot = _add(one, _mul(mu, c11))
        g = _div(one, pivot)
        q = _minus(_mul(_mul(mu, g), c12))
        c22 = _add(c22, _mul(q, c12))
        d2 = _add(d2, _mul(q, d1))
        c12, c11, d1 = _mul(c12, g), _mul(c11, g), _mul(d1, g)
    return _div(d1, total)[0], pivot[0]


@numba.njit
def _responses(length, rigidity, mass, omega):
    return np.array([_recursion(length, rigidity, mass, w)[0] for w in omega])


def _in_200_bits(beam, omega):
    """The same recursion in mpmath."""
    with mpmath.workprec(200):
        c11 = c12 = c22 = d1 = total = mpmath.mpf(0)
        d2 = mpmath.mpf(1)
        for l, ei, m in zip(*(map(mpmath.mpf, part) for part in beam.parts)):
            c11 += 2 * l * c12 + l * l * c22 + l**3 / (3 * ei)
            c12 += l * c22 + l * l / (2 * ei)
            c22 += l / ei
            d1 += l * d2
            total += l
            mu = -mpmath.mpf(omega) ** 2 * m
            g = 1 / (1 + mu * c11)
            c22 -= mu * g * c12**2
            d2 -= mu * g * c12 * d1
            c12, c11, d1 = c12 * g, c11 * g, d1 * g
        return float(d1 / total)


def reference(beam):
    """Exact θ_n/θ_m over `beam.omega`, and its largest difference from mpmath where checked."""
    exact = _responses(*beam.parts, beam.omega)
    at = np.linspace(0, beam.omega.size - 1, min(CHECKED, beam.omega.size)).astype(int)
    true = np.array([_in_200_bits(beam, beam.omega[k]) for k in at])
    return exact, error(exact[at], true)


def error(found, exact):
    """Largest |G − G_exact|/max(|G_exact|, 1)."""
    return float(np.max(np.abs(found - exact) / np.maximum(np.abs(exact), 1)))


def frequency(beam, near):
    """The natural frequency [rad/s] beside `near`: the last pivot's zero, by chords."""
    a, b = near * (1 - 1e-11), near * (1 + 1e-11)
    fa, fb = (_recursion(*beam.parts, w)[1] for w in (a, b))
    for _ in range(3):
        c = b - fb * ((b - a) / (fb - fa))
        a, fa, b, fb = b, fb, c, _recursion(*beam.parts, c)[1]
        if fa == fb:
            break
    return b
