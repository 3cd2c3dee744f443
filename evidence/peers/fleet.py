"""What a fleet costs: for each log, for scheduling, with one worker and two, on Dask; memory of the workers; 10⁶ logs.

    python evidence/peers/fleet.py [LOGS]

needs the wheel (`cargo xtask wheel`) and `distributed`. Logs are of 6 s at 2 ms. Medians of three repetitions in turn.
"""

import os
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import lissom
import numpy as np

LOGS = int(sys.argv[1]) if len(sys.argv) > 1 else 1000
REPETITIONS = 3
CAMPAIGN = """[signals]
time = { column = "t", unit = "s" }
current = { column = "i", unit = "A", hold = "sampled" }
motor = { column = "theta_m", unit = "rad" }
[drive]
torque_constant = "0.2 N*m/A"
"""
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
        "motor_sensor": {"counts_per_turn": 16384, "noise": "0.05 mrad"},
        "controller": {"proportional": "4 A/rad", "derivative": "0.15 A*s/rad"},
    },
}
PLAN = {"runs": [{"sine": {"frequency": "1 Hz", "amplitude": "0.6 rad"}, "record": "6 s"}]}


class Memory(threading.Thread):
    """Largest resident memory of any worker process [MB], early and late in the run."""

    def __init__(self) -> None:
        super().__init__(daemon=True)
        self.samples: list[tuple[float, float]] = []
        self.done = False

    def run(self) -> None:
        while not self.done:
            for folder in Path("/proc").glob("[0-9]*"):
                try:
                    if b"fleet\0worker" in (folder / "cmdline").read_bytes():
                        pages = int((folder / "statm").read_text().split()[1])
                        self.samples.append((time.perf_counter(), pages * os.sysconf("SC_PAGE_SIZE") / 1e6))
                except (OSError, IndexError):
                    pass
            time.sleep(0.1)


def write_logs(folder: Path) -> None:
    folder.mkdir()
    for k in range(LOGS):
        (table,) = lissom.simulate(ARM, PLAN, seed=k).values()
        names = ["t", "i", "theta_m"]
        np.savetxt(folder / f"{k:06}.csv", np.column_stack([table[n] for n in names]), "%.9g", ",", header=",".join(names), comments="")


def timed(work) -> float:
    begin = time.perf_counter()
    work()
    return time.perf_counter() - begin


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "campaign.toml").write_text(CAMPAIGN)
        write_logs(folder / "logs")
        count = iter(range(10**6))

        def fleet(executor=None, **more):
            out = folder / f"out {next(count)}"
            found = lissom.fleet(folder / "logs", folder / "campaign.toml", out=out, executor=executor, refine=None, **more)
            assert found.rows == LOGS and found.failed == 0
            return found

        def workers(number: int):
            def work() -> None:
                with ThreadPoolExecutor(number) as executor:
                    fleet(executor)

            return work

        def alone() -> None:
            os.environ["RAYON_NUM_THREADS"] = "1"
            paths = sorted((folder / "logs").iterdir())
            program = (
                "import sys, lissom\n"
                "like = lissom.Campaign.of_logs(sys.argv[1:2], current='i:A', hold='sampled', motor='theta_m:rad', time='t:s',"
                " torque_constant=0.2)\n"
                "for path in sys.argv[1:]:\n"
                "    lissom.identify(like.like(path), effort='quick')\n"
            )
            subprocess.run([sys.executable, "-c", program, *map(str, paths)], check=True)

        ways = {"one after the other": alone, "one worker": workers(1), "two workers": workers(2)}
        try:
            from distributed import Client, LocalCluster
        except ImportError:
            client = None
        else:
            cluster = LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None)
            client = Client(cluster)
            ways["Dask, two workers"] = lambda: fleet(client)
        times: dict[str, list[float]] = {way: [] for way in ways}
        for _ in range(REPETITIONS):
            for way, work in ways.items():
                times[way].append(timed(work))
        if client is not None:
            client.close()
            cluster.close()
        medians = {way: statistics.median(found) for way, found in times.items()}
        base = medians["one after the other"]
        print(f"{LOGS} logs of 3000 rows")
        for way, seconds in medians.items():
            spread = f"{min(times[way]):.2f}-{max(times[way]):.2f}"
            print(f"{way}: {seconds:.2f} s ({spread}), {1e3 * seconds / LOGS:.2f} ms each, ratio {seconds / base:.3f}")
        print(f"two workers over one: {medians['one worker'] / medians['two workers']:.2f} times as fast")
        hours = 1e6 * medians["two workers"] / LOGS / 3600
        print(f"10⁶ logs: {hours:.1f} h with two workers, {2 * hours:.1f} hours of a core")
        memory = Memory()
        memory.start()
        fleet()
        memory.done = True
        memory.join()
        begin, end = memory.samples[0][0], memory.samples[-1][0]
        for part, (low, high) in {"first quarter": (0, 0.25), "last quarter": (0.75, 1)}.items():
            span = [mb for at, mb in memory.samples if low <= (at - begin) / (end - begin) <= high]
            print(f"memory of a worker, {part} of the run: {max(span):.1f} MB")


if __name__ == "__main__":
    main()
