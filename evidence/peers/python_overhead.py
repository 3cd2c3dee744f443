"""What Python adds to Rust: noisy simulations with an estimate each, one campaign of files, and large arrays.

    python evidence/peers/python_overhead.py [CAMPAIGNS]

needs the wheel (`cargo xtask wheel`), `cargo build --release -p lissom-cli`, and the example `6_scatter`, which it builds.
Medians of five repetitions in turn; both use all cores.
"""

import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import lissom
import numpy as np

ROOT = Path(__file__).parents[2]
CAMPAIGNS = int(sys.argv[1]) if len(sys.argv) > 1 else 300
REPETITIONS = 5
ROWS = 2_000_000

ARM = {
    "beam": {"rigid": True},
    "drive": {
        "inertia": "2e-3 kg*m^2",
        "viscous": "5e-3 N*m*s/rad",
        "torque_constant": "0.2 N*m/A",
        "coulomb": "0.02 N*m",
    },
    "rig": {
        "sample_time": "2 ms",
        "current_limit": "5 A",
        "motor_sensor": {"counts_per_turn": 1 << 20, "noise": "0.5 mrad"},
        "controller": {"proportional": "4 A/rad", "derivative": "0.15 A*s/rad"},
    },
}
PLAN = {
    "runs": [
        {"sine": {"frequency": f"{omega} rad/s", "amplitude": "0.5 rad"}, "record": "12 s"}
        for omega in (3, 9)
    ]
}


def python_campaigns() -> float:
    """Seconds for the simulations and estimates."""
    begin = time.perf_counter()
    for seed in range(CAMPAIGNS):
        logs = lissom.simulate(ARM, PLAN, seed=1000 * seed)
        campaign = lissom.Campaign(
            logs,
            time=2e-3,
            motor="theta_m:rad",
            current=lissom.Signal("i", "A", hold="sampled"),
            torque_constant=0.2,
        )
        assert lissom.identify(campaign, effort="quick")["drive.inertia_kg_m2"] is not None
    return time.perf_counter() - begin


def rust_campaigns() -> float:
    """The same in Rust, as the example says."""
    program = ROOT / "target" / "release" / "examples" / "6_scatter"
    output = subprocess.run([program, str(CAMPAIGNS)], check=True, capture_output=True, text=True).stdout
    return float(output.split()[-2])


def arrays() -> None:
    """Prints what a campaign of large arrays costs, compared with a copy of them and with its identification."""
    t = 1e-3 * np.arange(ROWS)
    columns = {"t": t, "i": np.sin(0.9 * t) + 0.1 * np.sin(7 * t), "q": np.sin(0.5 * t)}
    times = []
    for _ in range(REPETITIONS):
        begin = time.perf_counter()
        copies = [values.copy() for values in columns.values()]
        copied = time.perf_counter()
        campaign = lissom.Campaign(columns, time="t:s", motor="q:rad", current="i:A")
        read = time.perf_counter()
        lissom.identify(campaign, effort="quick")
        times.append((copied - begin, read - copied, time.perf_counter() - read))
        del copies
    copy, read, quick = (statistics.median(each) for each in zip(*times))
    call = read + quick
    print(f"{ROWS} rows: copy {copy:.4f} s, checks and copy {read:.3f} s, quick {quick:.2f} s; ", end="")
    print(f"of the call {100 * copy / call:.1f} % and {100 * read / call:.1f} %")


def main() -> None:
    """Prints the comparison."""
    arrays()
    build = ["cargo", "build", "--release", "-p", "lissom", "--example", "6_scatter"]
    subprocess.run(build, check=True, cwd=ROOT)
    pairs = [(python_campaigns(), rust_campaigns()) for _ in range(REPETITIONS)]
    python, rust = (statistics.median(times) for times in zip(*pairs))
    print(f"{CAMPAIGNS} campaigns: Python {python:.2f} s, Rust {rust:.2f} s, ratio {python / rust:.3f}")

    command = ROOT / "target" / "release" / "lissom"
    folder = Path(tempfile.mkdtemp())
    subprocess.run([command, "demo", "--out", folder], check=True, capture_output=True)
    pairs = []
    for _ in range(REPETITIONS):
        begin = time.perf_counter()
        result = lissom.identify(folder / "campaign.toml")
        middle = time.perf_counter()
        out = folder / "again.json"
        subprocess.run(
            [command, "identify", folder / "campaign.toml", "--json", out], check=True, capture_output=True
        )
        pairs.append((middle - begin, time.perf_counter() - middle))
        assert bytes(result) == out.read_bytes()
    python, rust = (statistics.median(times) for times in zip(*pairs))
    print(f"demo: Python {python:.2f} s, command {rust:.2f} s, ratio {python / rust:.3f}; the same bytes")


if __name__ == "__main__":
    main()
