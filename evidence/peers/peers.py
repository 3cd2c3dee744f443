"""The other tools, each in its usual form. A peer prepares once and then answers for frequencies."""

import control
import numba
import numpy as np
import scipy.linalg
import scipy.sparse
import scipy.sparse.linalg

import beams


@numba.njit
def _one_by_one(length, rigidity, mass, omega):
    tip = np.empty(omega.size)
    for k in range(omega.size):
        z = -omega[k] * omega[k]
        c11 = c12 = c22 = d1 = total = 0.0
        d2 = 1.0
        for i in range(length.size):
            l, ei = length[i], rigidity[i]
            total += l
            c11 += 2 * l * c12 + l * l * c22 + l * l * l / (3 * ei)
            c12 += l * c22 + l * l / (2 * ei)
            c22 += l / ei
            d1 += l * d2
            mu = z * mass[i]
            g = 1 / (1 + mu * c11)
            q = mu * g
            c22 -= q * c12 * c12
            d2 -= q * c12 * d1
            c12 *= g
            c11 *= g
            d1 *= g
        tip[k] = d1 / total
    return tip


@numba.njit
def _side_by_side(length, rigidity, mass, omega):
    """The same with all frequencies inside: the compiler fills the processor's vectors."""
    z = -omega * omega
    c11, c12 = np.zeros(omega.size), np.zeros(omega.size)
    c22, d1 = np.zeros(omega.size), np.zeros(omega.size)
    d2 = np.ones(omega.size)
    total = 0.0
    for i in range(length.size):
        l, ei, m = length[i], rigidity[i], mass[i]
        a, b, c = l * l * l / (3 * ei), l * l / (2 * ei), l / ei
        total += l
        for k in range(omega.size):
            inner = c12[k] + l * c22[k]
            x = c11[k] + l * (c12[k] + inner) + a
            y = inner + b
            d = d1[k] + l * d2[k]
            mu = z[k] * m
            g = 1 / (1 + mu * x)
            q = mu * g * y
            c22[k] += c - q * y
            d2[k] -= q * d
            c12[k] = y * g
            c11[k] = x * g
            d1[k] = d * g
    return d1 / total


@numba.njit
def _without_division(length, rigidity, mass, omega):
    """lissom's form: everything times the product p of the pivots."""
    square = omega * omega
    a, b, c = np.zeros(omega.size), np.zeros(omega.size), np.zeros(omega.size)
    det, p = np.zeros(omega.size), np.ones(omega.size)
    d1, d2 = np.zeros(omega.size), np.ones(omega.size)
    e1, e2 = np.zeros(omega.size), np.zeros(omega.size)
    total = 0.0
    for i in range(length.size):
        l, m = length[i], mass[i]
        f = l / rigidity[i]
        k2 = l * f / 2
        k3, k6, k12, l23 = 2 * l * k2 / 3, l * k2 / 3, k2 * k2 / 3, l * l / 3
        total += l
        for k in range(omega.size):
            load = square[k] * m
            t = l * b[k] + a[k]
            y = l * c[k] + b[k]
            w = det[k] + (f * (l23 * c[k] + t) + k12 * p[k])
            x = k3 * p[k] + (l * y + t)
            b[k] = k2 * p[k] + y
            c[k] += f * p[k] - load * w
            p[k] -= load * x
            det[k] = w
            a[k] = x
            g = e1[k] + (l * e2[k] + (k6 * d2[k] + k2 * d1[k]))
            e2[k] += f * d1[k] + k2 * d2[k]
            d1[k] += l * d2[k]
            d2[k] += load * g
            e1[k] = g
        if i % 16 == 15:
            for k in range(omega.size):
                r = 1 / max(abs(p[k]), abs(d2[k]))
                a[k] *= r
                b[k] *= r
                c[k] *= r
                det[k] *= r
                p[k] *= r
                d1[k] *= r
                d2[k] *= r
                e1[k] *= r
                e2[k] *= r
    return d1 / (p * total)


def numba_one_by_one(beam):
    return lambda omega: _one_by_one(*beam.parts, omega)


def numba_side_by_side(beam):
    return lambda omega: _side_by_side(*beam.parts, omega)


def numba_without_division(beam):
    return lambda omega: _without_division(*beam.parts, omega)


def _stiffness(beam):
    """Beam elements in (deflection, slope) of each mass, lower half as (row, column, value), and
    the load by a unit turn of the clamp."""
    l, ei = beam.length, beam.rigidity
    k11, k12, near, far = 12 * ei / l**3, 6 * ei / l**2, 4 * ei / l, 2 * ei / l
    w = 2 * np.arange(l.size)
    phi = w + 1
    v, psi = w[1:] - 2, w[1:] - 1  # of the inner end
    entries = [
        (w, w, k11), (phi, w, -k12), (phi, phi, near),
        (v, v, k11[1:]), (psi, v, k12[1:]), (psi, psi, near[1:]),
        (w[1:], v, -k11[1:]), (w[1:], psi, -k12[1:]), (phi[1:], v, k12[1:]), (phi[1:], psi, far[1:]),
    ]
    load = np.zeros(2 * l.size)
    load[:2] = k12[0], -far[0]
    return (*(np.concatenate(part) for part in zip(*entries)), load)


def banded(beam):
    row, column, value, load = _stiffness(beam)
    band = np.zeros((7, load.size))
    np.add.at(band, (3 + row - column, column), value)
    below = row > column
    np.add.at(band, (3 + column[below] - row[below], row[below]), value[below])
    stiff = band[3, ::2].copy()

    def tip(omega):
        found = np.empty(omega.size)
        for k, w in enumerate(omega):
            band[3, ::2] = stiff - w * w * beam.mass
            found[k] = scipy.linalg.solve_banded((3, 3), band, load, check_finite=False)[-2]
        return found / beam.position[-1]

    return tip


def _residues(beam):
    """G = Σ r_k/(1 + s²/ω_k²), from all modes."""
    natural, shapes = beams.modes(beam)
    return natural, shapes[-1] * ((beam.mass * beam.position) @ shapes) / beam.position[-1]


def modal_sum(beam):
    natural, residue = _residues(beam)
    return lambda omega: (residue / (1 - (omega[:, None] / natural) ** 2)).sum(axis=1)


def state_space(beam, count):
    """The lowest `count` modes, the others as if without inertia."""
    natural, residue = (part[:count] for part in _residues(beam))
    n = natural.size
    a = np.block([[np.zeros((n, n)), np.eye(n)], [-np.diag(natural**2), np.zeros((n, n))]])
    b = np.concatenate([np.zeros(n), residue * natural**2])[:, None]
    c = np.concatenate([np.ones(n), np.zeros(n)])[None, :]
    system = control.ss(a, b, c, 1 - residue.sum(), remove_useless_states=False)

    def tip(omega):
        return np.real(control.frequency_response(system, omega, squeeze=True).complex)

    return tip


def eigsh(beam, count):
    """The lowest natural frequencies by shift and invert on sparse K and M."""
    row, column, value, load = _stiffness(beam)
    n = load.size
    lower = scipy.sparse.coo_array((value, (row, column)), shape=(n, n)).tocsc()
    stiffness = lower + scipy.sparse.tril(lower, -1).T
    mass = np.zeros(n)
    mass[::2] = beam.mass
    squares = scipy.sparse.linalg.eigsh(
        stiffness.tocsc(), k=count, M=scipy.sparse.diags_array(mass).tocsc(), sigma=0.0,
        return_eigenvectors=False,
    )
    return np.sqrt(np.sort(np.abs(squares)))
