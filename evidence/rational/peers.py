"""Shared poles of two outputs by scikit-rf and by a vector fit in numpy, timed.

usage: peers.py MODES < rows of `omega re1 im1 std1 re2 im2 std2`

Prints one line a fit: its name, the median time in s, then the fitted responses, row by row.
"""

import sys
import time
import warnings

import numpy as np
from skrf.vectorFitting import VectorFitting

REPEATS = 9


def scikit_rf(omega, responses, std, modes):
    """Its pole relocation and residues, called as its vector_fit does for responses of a network, which has
    as many as the square of its ports. It weighs responses by their size, not by their deviations."""
    frequency = omega / (2 * np.pi)
    norm = np.average(frequency)
    scaled = frequency / norm
    poles = VectorFitting._init_poles(scaled, 0, modes, "log")
    weights = np.linalg.norm(responses, axis=1)
    largest, settled = 1.0, False
    for _ in range(100):
        poles, _, _, _, _, values = VectorFitting._pole_relocation(
            poles, scaled, responses, weights, False, False
        )
        change = abs(1 - np.amax(values) / largest)
        largest = np.amax(values)
        if change < 1e-6 and settled:
            break
        settled = change < 1e-6
    residues = np.array(
        VectorFitting._fit_residues(poles, scaled, responses, False, False, False)[0]
    )
    s = 2j * np.pi * scaled[:, None]
    part = residues[:, None, :] / (s - poles) + residues.conj()[:, None, :] / (s - poles.conj())
    part[:, :, poles.imag == 0] /= 2
    return part.sum(axis=2)


def with_numpy(omega, responses, std, modes):
    """Relaxed vector fitting with each point over its deviation, outputs one by one (QR), numerators with real
    residues of resonances in the end."""
    high = omega[-1]
    s = 1j * omega / high
    start = np.geomspace(omega[0], high, 2 * modes + 1)[1::2] / high
    poles = start * (-0.01 + 1j)
    weights = 1 / std
    for _ in range(12):
        first, second = 1 / (s[:, None] - poles), 1 / (s[:, None] - poles.conj())
        basis = np.hstack([first + second, 1j * (first - second)])
        sigma = np.hstack([basis, np.ones((len(s), 1))])
        stacked, right = [], []
        for response, weight in zip(responses, weights):
            left = basis * weight[:, None]
            middle = -sigma * (response * weight)[:, None]
            rows = np.hstack([left, middle])
            _, r = np.linalg.qr(np.vstack([rows.real, rows.imag]))
            stacked.append(r[2 * modes :, 2 * modes :])
            right.append(np.zeros(len(stacked[-1])))
        size = np.sqrt((np.abs(responses * weights) ** 2).sum()) / len(s)
        stacked.append(size * sigma.real.sum(axis=0)[None, :])
        right.append([size * len(s)])
        stacked = np.vstack(stacked)
        scale = np.linalg.norm(stacked, axis=0)
        found = np.linalg.lstsq(stacked / scale, np.concatenate(right), rcond=None)[0] / scale
        c, d = found[:-1], found[-1]
        state = np.zeros((2 * modes, 2 * modes))
        for k, pole in enumerate(poles):
            state[2 * k : 2 * k + 2, 2 * k : 2 * k + 2] = [
                [pole.real, pole.imag],
                [-pole.imag, pole.real],
            ]
            state[2 * k, :] -= 2 * np.stack([c[:modes], c[modes:]], axis=1).ravel() / d
        moved = np.linalg.eigvals(state)
        upper = moved[moved.imag > 0]
        # Real ones by twos make a resonance of their size.
        real = np.sort(np.abs(moved[moved.imag == 0].real))
        joined = np.sqrt(real[::2] * real[1::2]) * (-0.3 + 0.95j)
        moved = np.concatenate([-np.abs(upper.real) + 1j * upper.imag, joined])
        moved = moved[np.argsort(moved.imag)]
        still = np.max(np.abs(moved / poles[np.argsort(poles.imag)] - 1)) < 1e-6
        poles = moved
        if still:
            break
    square = np.abs(poles) ** 2
    basis = square / (s[:, None] ** 2 - 2 * poles.real * s[:, None] + square)
    fitted = []
    for response, weight in zip(responses, weights):
        rows = basis * weight[:, None]
        value = response * weight
        gains = np.linalg.lstsq(
            np.vstack([rows.real, rows.imag]), np.concatenate([value.real, value.imag]), rcond=None
        )[0]
        fitted.append(basis @ gains)
    return np.array(fitted)


def main():
    warnings.simplefilter("ignore")
    modes = int(sys.argv[1])
    table = np.loadtxt(sys.stdin)
    omega, std = table[:, 0], table[:, [3, 6]].T
    responses = (table[:, [1, 4]] + 1j * table[:, [2, 5]]).T
    for name, fit in [("scikit-rf", scikit_rf), ("numpy", with_numpy)]:
        times = []
        for _ in range(REPEATS):
            begun = time.perf_counter()
            fitted = fit(omega, responses, std, modes)
            times.append(time.perf_counter() - begun)
        values = np.stack([fitted.real, fitted.imag], axis=2).ravel()
        print(name, np.median(times), *values)


main()
