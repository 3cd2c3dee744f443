"""Measures `lissom identify --quick` beside numpy and scipy: `python evidence/peers/quick.py [--runs N]`. See README.md."""

import argparse
import json
import os
import subprocess
import tempfile
import time
from pathlib import Path

# numpy has one thread; lissom is given one and then all.
for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"

import numpy as np  # noqa: E402
from scipy.signal import butter, filtfilt  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
SAMPLE_S, SAMPLES = 1e-3, 20_000
# N·m/A, kg·m², N·m·s/rad, N·m.
CONSTANT, INERTIA, VISCOUS, COULOMB = 0.25, 0.003, 0.02, 0.15
HARMONICS = 9


def make(folder, runs):
    """Sines of a rigid joint with Coulomb friction, 1 to 60 rad/s, and their campaign file."""
    random = np.random.default_rng(1)
    t = SAMPLE_S * np.arange(SAMPLES)
    omegas = np.geomspace(1.0, 60.0, runs)
    text = [
        '[signals]\ntime = { column = "t", unit = "s" }',
        'current = { column = "i", unit = "A", hold = "sampled" }',
        f'motor = {{ column = "q", unit = "rad" }}\n\n[drive]\ntorque_constant = "{CONSTANT} N*m/A"',
    ]
    for index, omega in enumerate(omegas):
        size = min(3.0, 30.0 / omega)
        angle, speed = size * np.sin(omega * t), size * omega * np.cos(omega * t)
        torque = -INERTIA * omega**2 * angle + VISCOUS * speed + COULOMB * np.sign(speed)
        current = torque / CONSTANT + 0.01 * random.standard_normal(SAMPLES)
        angle = angle + 2e-5 * random.standard_normal(SAMPLES)
        np.savetxt(
            f"{folder}/{index}.csv",
            np.column_stack([t, current, angle]),
            fmt=["%.6f", "%.8f", "%.9f"],
            delimiter=",",
            header="t,i,q",
            comments="",
        )
        text.append(f'\n[[runs]]\nfile = "{index}.csv"\nomega_rad_s = {float(omega)!r}')
    Path(folder, "campaign.toml").write_text("\n".join(text))
    return omegas


def by_numpy(folder, omegas):
    """Reading, harmonics 1 to 9 of both channels, and least squares of the motor's equation."""
    begin = time.perf_counter()
    logs = [np.loadtxt(f"{folder}/{i}.csv", delimiter=",", skiprows=1) for i in range(len(omegas))]
    read_s = time.perf_counter() - begin
    t = SAMPLE_S * np.arange(SAMPLES)
    phasors, sums = [], np.zeros((5, 5))
    for log, omega in zip(logs, omegas):
        waves = np.exp(1j * omega * np.outer(t, np.arange(1, HARMONICS + 1)))
        columns = np.column_stack([np.ones(SAMPLES), t, waves.real, waves.imag])
        phasors.append(np.linalg.lstsq(columns, log[:, 1:], rcond=None)[0])
        # As published: zero-phase low-pass, central differences, ordinary least squares.
        low = butter(4, min(20.0 * omega * SAMPLE_S / np.pi, 0.9))
        current, angle = (filtfilt(*low, log[:, k]) for k in (1, 2))
        speed = np.gradient(angle, SAMPLE_S)
        rows = [np.gradient(speed, SAMPLE_S), speed, filtfilt(*low, np.sign(speed)), np.ones(SAMPLES)]
        rows = np.array([*rows, CONSTANT * current])[:, 200:-200]
        sums += rows @ rows.T
    values = np.linalg.solve(sums[:4, :4], sums[:4, 4])
    return time.perf_counter() - begin, read_s, values[2]


def by_lissom(folder, threads):
    target = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    command = [target / "release/lissom", "identify", f"{folder}/campaign.toml", "--quick", "--json"]
    env = os.environ | ({"RAYON_NUM_THREADS": str(threads)} if threads else {})
    begin = time.perf_counter()
    done = subprocess.run(command, capture_output=True, check=False, env=env)
    seconds = time.perf_counter() - begin
    return seconds, json.loads(done.stdout)["friction"]["coulomb_nm"]["value"]


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--runs", type=int, default=100)
    runs = arguments.parse_args().runs
    subprocess.run(["cargo", "build", "--quiet", "--release", "-p", "lissom-cli"], cwd=ROOT, check=True)
    with tempfile.TemporaryDirectory() as folder:
        omegas = make(folder, runs)
        whole, read_s, coulomb = min(by_numpy(folder, omegas) for _ in range(3))
        rows = [("numpy and scipy, one thread", whole, coulomb), ("… reading alone", read_s, None)]
        for threads, name in ((1, "lissom, one thread"), (0, "lissom, all threads")):
            rows.append((name, *min(by_lissom(folder, threads) for _ in range(3))))
    print(f"{runs} logs of {SAMPLES} samples, least of three; ratio to the first row\n")
    for name, seconds, coulomb in rows:
        error = "" if coulomb is None else f"{abs(coulomb / COULOMB - 1):.1e}"
        print(f"| {name:28} | {seconds:7.2f} s | {seconds / whole:6.3f} | {error:8} |")


if __name__ == "__main__":
    main()
