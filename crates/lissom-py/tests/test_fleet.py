"""Fleets: many logs, in processes of this machine, in executors, from addresses."""

from __future__ import annotations

import copy
import hashlib
import json
import os
import shutil
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from concurrent.futures import Future, ProcessPoolExecutor, ThreadPoolExecutor
from pathlib import Path
from typing import Any

import lissom
import numpy as np
import pandas as pd
import pytest
from conftest import ARM, COULOMB, SIGNALS
from lissom import _fleet_work

MACHINES, LOGS = 4, 5
PATTERN = "{machine}/{time}.csv"
CAMPAIGN = """[signals]
time = { column = "t", unit = "s" }
current = { column = "i", unit = "A", hold = "sampled" }
motor = { column = "theta_m", unit = "rad" }
[drive]
torque_constant = "0.2 N*m/A"
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Logs of machines at several days, and the campaign.toml that describes them."""
    made = tmp_path_factory.mktemp("fleet")
    (made / "campaign.toml").write_text(CAMPAIGN)
    for machine in range(MACHINES):
        arm = copy.deepcopy(ARM)
        arm["drive"]["coulomb"] = f"{COULOMB * (1 + 0.1 * machine)} N*m"
        sine = {"frequency": "1 Hz", "amplitude": "0.6 rad"}
        plan = {"seed": machine, "runs": [{"name": f"run-{k}", "sine": sine, "periods": 6} for k in range(LOGS)]}
        runs = lissom.simulate(arm, plan)
        (made / "logs" / f"m{machine}").mkdir(parents=True)
        for day, table in enumerate(runs.values(), start=1):
            pd.DataFrame(table).to_csv(made / "logs" / f"m{machine}" / f"2026-01-{day:02}.csv", index=False)
    return made


def run(folder: Path, out: Path, **more: Any) -> lissom.Fleet:
    """Identify the fleet of these logs."""
    return lissom.fleet(folder / "logs", folder / "campaign.toml", out=out, pattern=PATTERN, **more)


def complete(fleet: lissom.Fleet) -> None:
    """Check that each log has one row, with its result."""
    assert fleet.rows == MACHINES * LOGS and fleet.failed == 0
    assert len(set(fleet["log"])) == MACHINES * LOGS
    for machine in range(MACHINES):
        found = fleet["friction.coulomb"][fleet["machine"] == f"m{machine}"]
        assert np.allclose(found, COULOMB * (1 + 0.1 * machine), rtol=0.05)


def test_rows_are_the_results_of_the_logs(folder: Path, tmp_path: Path) -> None:
    """A row has the estimates that `identify` gives for its log alone, and the hash of its file."""
    shares: list[float] = []
    fleet = run(folder, tmp_path / "out", keep_results=True, progress=lambda text, share: shares.append(share))
    complete(fleet)
    assert shares == sorted(shares) and shares[-1] == 1
    name = str(fleet["log"][7])
    alone = lissom.identify(lissom.Campaign(name, **SIGNALS), effort="quick")
    row = list(fleet["log"]).index(name)
    effort = fleet["effort"][row]
    if effort == "quick":
        assert fleet["friction.coulomb"][row] == alone["friction.coulomb"]
    result = fleet.result(name)
    coulomb = result["friction.coulomb"]
    assert coulomb is not None and fleet["friction.coulomb.std"][row] == coulomb.std
    hashed = subprocess.run(["sha256sum", name], capture_output=True, text=True, check=True).stdout.split()[0]
    assert fleet["input_sha256"][row] == hashed
    assert set(fleet["version"]) == {lissom.__version__}
    frame = fleet.to_frame()
    assert len(frame) == fleet.rows and str(frame["time"].dt.tz) == "UTC"
    read = pd.concat([pd.read_parquet(file) for file in fleet.files])
    assert np.array_equal(read["friction.coulomb [N·m]"], fleet["friction.coulomb"])
    with pytest.raises(lissom.InputError, match="is not a log of this fleet"):
        fleet.result("other.csv")


def test_command_writes_the_same_rows(folder: Path, tmp_path: Path) -> None:
    """The command and Python give the same estimates, to the last bit, and read each other's folders."""
    fleet = run(folder, tmp_path / "python")
    command = [sys.executable, "-m", "lissom", "fleet", str(folder / "logs"), "--like", str(folder / "campaign.toml")]
    subprocess.run([*command, "--out", str(tmp_path / "command"), "--pattern", PATTERN], check=True, capture_output=True)
    other = lissom.Fleet(tmp_path / "command")
    order, others = np.argsort(fleet["log"]), np.argsort(other["log"])
    for name in ("log", "friction.coulomb", "drive.inertia.std", "time", "machine"):
        assert np.array_equal(fleet[name][order], other[name][others])
    summary = lissom.FleetSummary(json.dumps(fleet.summary().to_dict()))
    page = tmp_path / "page.html"
    summary.report(page)
    assert b"friction.coulomb" in page.read_bytes()
    assert summary.machines == MACHINES and summary.identified == MACHINES * LOGS
    assert "friction.coulomb [N·m]: median" in repr(summary)


def test_executors(folder: Path, tmp_path: Path) -> None:
    """Threads, processes and Dask give the same rows."""
    with ThreadPoolExecutor(2) as threads:
        complete(run(folder, tmp_path / "threads", executor=threads))
    with ProcessPoolExecutor(2) as processes:
        complete(run(folder, tmp_path / "processes", executor=processes))


@pytest.fixture(scope="module")
def client() -> Iterator[Any]:
    """A Dask cluster of two processes."""
    distributed = pytest.importorskip("distributed")
    cluster = distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=":0", memory_limit=None)
    with cluster, distributed.Client(cluster) as client:
        yield client


def test_dask(folder: Path, tmp_path: Path, client: Any) -> None:
    """Workers of a cluster make the rows; one that is killed costs none."""
    complete(run(folder, tmp_path / "dask", executor=client))

    killed = threading.Event()

    def kill(text: str, share: float) -> None:
        if not killed.is_set():
            killed.set()
            victim = next(iter(client.run(os.getpid).values()))
            os.kill(victim, signal.SIGKILL)

    complete(run(folder, tmp_path / "killed", executor=client, progress=kill))
    assert killed.is_set()


def test_closed_executors(folder: Path, tmp_path: Path) -> None:
    """An executor that takes no work is one error, and the run goes on elsewhere."""
    closed = ThreadPoolExecutor(1)
    closed.shutdown()
    with pytest.raises(lissom.LissomError, match="takes no work"):
        run(folder, tmp_path / "out", executor=closed)
    with pytest.raises(lissom.InputError, match="no method submit"):
        run(folder, tmp_path / "out", executor=object())
    complete(run(folder, tmp_path / "out"))


def test_lost_batches_are_tried_again(folder: Path, tmp_path: Path) -> None:
    """A batch whose worker is lost is given again; if that happens too often, its logs have no row yet."""

    class Unreliable(ThreadPoolExecutor):
        lost = 0
        most = 3

        def submit(self, *arguments: Any, **more: Any) -> Future[Any]:  # type: ignore[override]
            if self.lost < self.most:
                self.lost += 1
                future: Future[Any] = Future()
                future.set_exception(RuntimeError("a worker died"))
                return future
            return super().submit(*arguments, **more)

    with Unreliable(1) as executor:
        complete(run(folder, tmp_path / "once", executor=executor))
    with Unreliable(1) as executor:
        executor.most = 10**6
        with pytest.raises(lissom.LissomError, match="20 logs have no row: their workers were lost .*a worker died"):
            run(folder, tmp_path / "never", executor=executor)
    complete(run(folder, tmp_path / "never"))


def test_another_version_is_refused(folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A worker of another version makes no row."""
    from lissom import _fleet_run

    real = _fleet_run._settings
    monkeypatch.setattr(_fleet_run, "_settings", lambda *given: {**real(*given), "version": "0.0.1"})
    with pytest.raises(lissom.LissomError, match=f"version {lissom.__version__}"):
        run(folder, tmp_path / "out")


def test_stopped_and_killed_clients_go_on(folder: Path, tmp_path: Path) -> None:
    """Ctrl-C, or a kill, of the program keeps the rows that were written; the next run adds the others."""
    program = (
        "import signal, sys, time, lissom\n"
        # Programs that a shell starts in the background ignore it.
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "def wait(text, share):\n"
        "    print(text, flush=True)\n"
        "    if share > 0.1: time.sleep(30)\n"
        "lissom.fleet(*sys.argv[1:3], out=sys.argv[3], pattern=sys.argv[4], progress=wait)\n"
    )
    for number, how in enumerate((signal.SIGINT, signal.SIGKILL)):
        out = tmp_path / f"out {number}"
        arguments = [str(folder / "logs"), str(folder / "campaign.toml"), str(out), PATTERN]
        started = subprocess.Popen([sys.executable, "-c", program, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        assert started.stdout is not None
        for line in started.stdout:
            if not line.startswith(b"0 of"):
                break
        started.send_signal(how)
        _, said = started.communicate(timeout=60)
        assert started.returncode != 0
        if how == signal.SIGINT:
            assert b"KeyboardInterrupt" in said and lissom.Fleet(out).rows > 0
        complete(run(folder, out))


@pytest.mark.skipif(not hasattr(os, "fork"), reason="only where processes fork")
def test_the_lock_ends_with_the_client(folder: Path, tmp_path: Path) -> None:
    """Processes of a pool, which outlive a client that is killed, do not keep the folder locked."""
    program = (
        "import multiprocessing, sys, time, lissom\n"
        "from concurrent.futures import ProcessPoolExecutor\n"
        "def wait(text, share):\n"
        "    print(text, flush=True)\n"
        "    if share > 0.1: time.sleep(60)\n"
        "pool = ProcessPoolExecutor(2, mp_context=multiprocessing.get_context('fork'))\n"
        "lissom.fleet(*sys.argv[1:3], out=sys.argv[3], pattern=sys.argv[4], executor=pool, progress=wait)\n"
    )
    arguments = [str(folder / "logs"), str(folder / "campaign.toml"), str(tmp_path / "out"), PATTERN]
    command = [sys.executable, "-W", "ignore", "-c", program, *arguments]
    started = subprocess.Popen(command, stdout=subprocess.PIPE, start_new_session=True)
    assert started.stdout is not None
    try:
        for line in started.stdout:
            if not line.startswith(b"0 of"):
                break
        started.kill()
        started.wait()
        os.killpg(started.pid, 0)  # Processes of the pool are there.
        complete(run(folder, tmp_path / "out"))
    finally:
        os.killpg(started.pid, signal.SIGKILL)
        started.stdout.close()


def test_logs_that_hang_or_are_damaged_are_rows(folder: Path, tmp_path: Path) -> None:
    """A log that cannot be read within the time limit, or at all, is one row; the rest goes on."""
    pipe = tmp_path / "pipe.csv"
    os.mkfifo(pipe)
    (tmp_path / "empty.csv").write_text("")
    (tmp_path / "words.csv").write_text("t,i,theta_m\n0,a,1\n")
    (tmp_path / "binary.csv").write_bytes(bytes(range(256)) * 100)
    good = folder / "logs" / "m0" / "2026-01-01.csv"
    logs = [pipe, tmp_path / "empty.csv", good, tmp_path / "words.csv", tmp_path / "binary.csv", tmp_path / "none.parquet"]
    table = {"log": [str(log) for log in logs]}
    fleet = lissom.fleet(table, folder / "campaign.toml", out=tmp_path / "out", time_limit=3)
    found = dict(zip(fleet["log"], fleet["failure"], strict=True))
    assert [found[str(log)] for log in logs] == ["time_limit", "input", "", "input", "input", "missing"]
    assert fleet.failed == 5 and all(fleet["message"][fleet["failure"] != ""])
    pipe.unlink()
    pipe.write_bytes(good.read_bytes())
    fleet = lissom.fleet(table, folder / "campaign.toml", out=tmp_path / "out", again=["time_limit"])
    assert fleet.rows == 6 and fleet.failed == 4 and len(set(fleet["log"])) == 6
    with pytest.raises(lissom.LissomError, match="empty.csv"):
        lissom.fleet({"log": [str(logs[1])]}, folder / "campaign.toml", out=tmp_path / "raise", on_error="raise")


def test_tables_in_memory(folder: Path, tmp_path: Path, logs: dict[str, dict[str, Any]]) -> None:
    """Logs may be tables in memory, and a log that is no table is a row or one error."""
    like = lissom.Campaign(logs, **SIGNALS)
    tables = {name: pd.DataFrame(table) for name, table in logs.items()}
    fleet = lissom.fleet(tables, like, out=tmp_path / "out")
    assert sorted(fleet["log"]) == sorted(tables) and fleet.failed == 0
    assert np.allclose(fleet["friction.coulomb"], COULOMB, rtol=0.05)
    with pytest.raises(lissom.InputError, match="is an address"):
        lissom.fleet({"a": "s3://bucket/log.csv"}, like, out=tmp_path / "bad")
    bad = {**tables, "complex": {"t": np.array([1j, 2]), "i": [1, 2], "theta_m": [1, 2]}}
    with pytest.raises(lissom.InputError, match='complex: column "t" is complex'):
        lissom.fleet(bad, like, out=tmp_path / "bad")
    odd = {
        "short": {"t": [0.0, 1.0], "i": [np.nan, 1.0], "theta_m": [0.0, 1.0]},
        "words": {"t": np.array([None, "x"], dtype=object), "i": [1, 2], "theta_m": [1, 2]},
    }
    fleet = lissom.fleet({**odd, **tables}, like, out=tmp_path / "odd")
    found = dict(zip(fleet["log"], fleet["failure"], strict=True))
    assert found == {**dict.fromkeys(odd, "input"), **dict.fromkeys(tables, "")}


def test_tables_of_logs(folder: Path, tmp_path: Path) -> None:
    """Machine and time come from a table; times have zones or are universal."""
    log = folder / "logs" / "m0" / "2026-01-01.csv"
    other = folder / "logs" / "m0" / "2026-01-02.csv"
    frame = pd.DataFrame({"log": [str(log), str(other)], "machine": ["a", None]})
    frame["time"] = pd.to_datetime(["2026-03-01T12:00+02:00", None], utc=True).tz_convert("Europe/Berlin")
    fleet = lissom.fleet(frame, folder / "campaign.toml", out=tmp_path / "out")
    rows = fleet.to_frame().set_index("log")
    assert list(rows.loc[[str(log), str(other)], "machine"]) == ["a", ""]
    assert rows.loc[str(log), "time"] == pd.Timestamp("2026-03-01T10:00:00Z") and rows["time"].isna().sum() == 1
    for table, problem in (
        ({"log": [str(log)], "time": ["yesterday"]}, "row 1: 'yesterday' is not a time"),
        ({"log": [str(log), None]}, "row 2: None is no path"),
        ({"log": [str(log)], "machine": ["a", "b"]}, "`machine` has 2 rows"),
        ([], "there are no logs"),
        (3, "a list of logs"),
        ("no/such/log.csv", "no such file"),
        ("no/*.csv", "no file has this form"),
    ):
        with pytest.raises(lissom.LissomError, match=problem):
            lissom.fleet(table, folder / "campaign.toml", out=tmp_path / "wrong")
    with pytest.raises(lissom.InputError, match="does not end like"):
        lissom.fleet([str(log)], folder / "campaign.toml", out=tmp_path / "wrong", pattern="{machine}_{time}.mat")


def test_arguments(folder: Path, tmp_path: Path) -> None:
    """Wrong arguments are one error each, before any work."""
    for more, problem in (
        ({"effort": "fast"}, "efforts are"),
        ({"time_limit": 0}, "must be positive"),
        ({"time_limit": float("nan")}, "must be positive"),
        ({"retries": -1}, "not negative"),
        ({"retries": 1.5}, "must be a number"),
        ({"time_limit": "60 s"}, "give seconds"),
        ({"again": ["gone"]}, "give a list of these"),
        ({"workers": 0}, "must be from 1"),
        ({"pattern": "{machine/{time}.csv"}, "pattern"),
        ({"pattern": "{machine}/{time}.mat"}, "none of 20 files ends like"),
        ({"refine_on": "missing-term"}, "list of codes"),
        ({"on_error": "ignore"}, "on_error"),
    ):
        with pytest.raises(lissom.InputError, match=problem):
            lissom.fleet(folder / "logs", folder / "campaign.toml", out=tmp_path / "out", **{"pattern": PATTERN, **more})
    with pytest.raises(lissom.InputError, match="no folder of this machine"):
        lissom.fleet(folder / "logs", folder / "campaign.toml", out="s3://bucket/out")
    (tmp_path / "wrong.toml").write_text(CAMPAIGN.replace('unit = "s"', 'unit = "kg"'))
    with pytest.raises(lissom.InputError, match="wrong.toml, line 2"):
        lissom.fleet(folder / "logs", tmp_path / "wrong.toml", out=tmp_path / "out")
    assert not (tmp_path / "out").exists()
    with pytest.raises(lissom.FileError, match="give a campaign.toml"):
        lissom.fleet(folder / "logs", folder / "none.toml", out=tmp_path / "out")
    with pytest.raises(lissom.InputError, match="there is no manifest.json"):
        lissom.Fleet(tmp_path)
    run(folder, tmp_path / "out", refine=None)
    with pytest.raises(lissom.InputError, match="another effort"):
        run(folder, tmp_path / "out", effort="normal")
    with pytest.raises(lissom.InputError, match="has results already"):
        run(folder, tmp_path / "out", refine=None, resume=False)


@pytest.fixture(scope="module")
def storage() -> Iterator[dict[str, Any]]:
    """A server with the interface of S3 on this machine, and how it is reached."""
    server = pytest.importorskip("moto.server")
    pytest.importorskip("s3fs")
    running = server.ThreadedMotoServer(ip_address="127.0.0.1", port=0, verbose=False)
    running.start()
    host, port = running.get_host_and_port()
    yield {
        "key": "test",
        "secret": "test",
        "client_kwargs": {"endpoint_url": f"http://{host}:{port}"},
    }
    running.stop()


def test_bucket(folder: Path, tmp_path: Path, storage: dict[str, Any], monkeypatch: pytest.MonkeyPatch) -> None:
    """Logs come from a bucket; one that is gone is a row, a bucket that is not there is one error."""
    import s3fs

    system = s3fs.S3FileSystem(**storage)
    system.mkdir("fleet")
    system.put(str(folder / "logs"), "fleet/logs", recursive=True)
    more = {"like": folder / "campaign.toml", "pattern": PATTERN, "storage_options": storage}
    fleet = lissom.fleet("s3://fleet/logs", out=tmp_path / "out", **more)
    complete(fleet)
    assert "s3://fleet/logs/m0/2026-01-01.csv" in list(fleet["log"])
    complete(lissom.fleet("s3://fleet/logs/*/*.csv", out=tmp_path / "glob", **more))
    addresses = ["s3://fleet/logs/m0/2026-01-01.csv", "s3://fleet/logs/m9/2026-01-01.csv"]
    fleet = lissom.fleet(addresses, folder / "campaign.toml", out=tmp_path / "gone", storage_options=storage)
    assert dict(zip(fleet["log"], fleet["failure"], strict=True)) == dict(zip(addresses, ["", "missing"], strict=True))
    with pytest.raises(lissom.FileError, match="s3://nothing/here"):
        lissom.fleet("s3://nothing/here", out=tmp_path / "none", **more)
    # A server that cannot be reached makes no row, also of a single log: the run can go on later.
    away = {
        **storage,
        "client_kwargs": {"endpoint_url": "http://127.0.0.1:9"},
        "config_kwargs": {"retries": {"max_attempts": 0}},
    }
    monkeypatch.setattr(_fleet_work, "WAIT_S", 0.01)
    with ThreadPoolExecutor(1) as threads, pytest.raises(lissom.LissomError, match="1 logs have no row"):
        given = {"executor": threads, "retries": 0, "storage_options": away}
        lissom.fleet(addresses[:1], folder / "campaign.toml", out=tmp_path / "away", **given)
    assert lissom.Fleet(tmp_path / "away").rows == 0 and list(lissom.Fleet(tmp_path / "away")["log"]) == []
    fleet = lissom.fleet(addresses[:1], folder / "campaign.toml", out=tmp_path / "away", storage_options=storage)
    assert fleet.rows == 1 and fleet.failed == 0
    with pytest.raises(lissom.LissomError, match="check the protocol"):
        lissom.fleet("nosuchprotocol://here", out=tmp_path / "none", **more)


RUNS = ("slow.csv", "fast/chirp.csv")


@pytest.fixture(scope="module")
def tests_by_folder(tmp_path_factory: pytest.TempPathFactory, folder: Path) -> Path:
    """Folders with two runs each, of which one lacks a file, and their campaign.toml."""
    made = tmp_path_factory.mktemp("by_folder")
    runs = "".join(f'[[runs]]\nfile = "{file}"\n' for file in RUNS)
    (made / "campaign.toml").write_text(CAMPAIGN + runs + 'skip = "0.5 s"\n')
    for machine in ("m0", "m1"):
        for day, files in (("2026-01-01", RUNS), ("2026-01-02", RUNS[: 2 if machine == "m0" else 1])):
            for number, file in enumerate(files, start=1):
                target = made / "logs" / machine / day / file
                target.parent.mkdir(parents=True, exist_ok=True)
                target.write_bytes((folder / "logs" / machine / f"2026-01-{number:02}.csv").read_bytes())
    (made / "logs" / "notes").mkdir()
    (made / "logs" / "notes" / "notes.txt").write_text("none of the runs")
    return made


def of_folders(fleet: lissom.Fleet, made: Path, root: str) -> None:
    """Check the rows: the results of each folder's campaign, and the file that is missing."""
    assert fleet.rows == 4 and fleet.failed == 1
    order = np.argsort(fleet["log"])
    days = [f"m{machine}/2026-01-0{day}" for machine in (0, 1) for day in (1, 2)]
    assert list(fleet["log"][order]) == [f"{root}/{day}" for day in days]
    assert list(fleet["machine"][order]) == ["m0", "m0", "m1", "m1"]
    assert list(fleet["failure"][order]) == ["", "", "", "missing"]
    assert fleet["message"][order][3].startswith(f"{root}/{days[3]}/{RUNS[1]}: ")
    for row, day in zip(order[:3], days, strict=False):
        campaign = made / "logs" / day / "campaign.toml"
        campaign.write_text((made / "campaign.toml").read_text())
        alone = lissom.identify(lissom.Campaign.load(campaign), effort="quick")
        campaign.unlink()
        assert fleet["friction.coulomb"][row] == alone["friction.coulomb"]
        content = b"".join((made / "logs" / day / file).read_bytes() for file in RUNS)
        assert fleet["input_sha256"][row] == hashlib.sha256(content).hexdigest()


def test_folders_are_logs(folder: Path, tests_by_folder: Path, tmp_path: Path) -> None:
    """A folder with the files of the campaign's runs is one log, however folders are given."""
    made, root = tests_by_folder, str(tests_by_folder / "logs")
    more: dict[str, Any] = {"by_folder": True, "pattern": "{machine}/{time}", "refine": None}
    like = made / "campaign.toml"
    of_folders(lissom.fleet(root, like, out=tmp_path / "folder", **more), made, root)
    of_folders(lissom.fleet(f"{root}/*", like, out=tmp_path / "glob", **more), made, root)
    shutil.copytree(f"{root}/m0/2026-01-01", tmp_path / "reference")
    shutil.copy(like, tmp_path / "reference")
    campaign = lissom.Campaign.load(tmp_path / "reference" / "campaign.toml")
    of_folders(lissom.fleet([f"{root}/m0", f"{root}/m1/"], campaign, out=tmp_path / "list", **more), made, root)
    table = {"log": [f"{root}/m{machine}/2026-01-0{day}" for machine in (0, 1) for day in (1, 2)]}
    of_folders(lissom.fleet(table, like, out=tmp_path / "table", **more), made, root)
    (made / "up.toml").write_text(like.read_text().replace("slow", "../slow"))
    for logs, wrong, problem in (
        (root, folder / "campaign.toml", "has no `runs`"),
        (root, made / "up.toml", "is not in the folder of a log"),
        (f"{root}/notes", like, "no folder has files of the runs: slow.csv, fast/chirp.csv"),
        ({"a": {"t": [0.0, 1.0]}}, like, "tables in memory are not in folders"),
    ):
        with pytest.raises(lissom.InputError, match=problem) as raised:
            lissom.fleet(logs, wrong, out=tmp_path / "wrong", by_folder=True)
        assert raised.value.hint
    with pytest.raises(lissom.InputError, match="cannot be written into a folder with logs"):
        lissom.fleet(root, like, out=root, by_folder=True)
    with pytest.raises(lissom.InputError, match="another choice of files or folders as logs"):
        lissom.fleet(table, like, out=tmp_path / "table", refine=None)


def test_folders_of_a_bucket(tests_by_folder: Path, tmp_path: Path, storage: dict[str, Any]) -> None:
    """The files of folders are fetched from addresses; addresses in a list that end in / are listed."""
    import s3fs

    system = s3fs.S3FileSystem(**storage)
    system.mkdir("tests")
    system.put(str(tests_by_folder / "logs"), "tests/logs", recursive=True)
    more: dict[str, Any] = {"pattern": "{machine}/{time}", "refine": None, "storage_options": storage}
    for number, logs in enumerate(("s3://tests/logs", "s3://tests/logs/*", ["s3://tests/logs/m0/", "s3://tests/logs/m1/"])):
        fleet = lissom.fleet(logs, tests_by_folder / "campaign.toml", out=tmp_path / str(number), by_folder=True, **more)
        of_folders(fleet, tests_by_folder, "s3://tests/logs")
    files = ["s3://tests/logs/m1/", "s3://tests/logs/m0/2026-01-01/slow.csv"]
    fleet = lissom.fleet(files, tests_by_folder / "campaign.toml", out=tmp_path / "files", **{**more, "pattern": None})
    assert fleet.rows == 4 and fleet.failed == 0
    with pytest.raises(lissom.InputError, match="s3://tests/logs/notes: no folder has files of the runs"):
        lissom.fleet("s3://tests/logs/notes", tests_by_folder / "campaign.toml", out=tmp_path / "no", by_folder=True, **more)


def test_worker_processes_end_with_the_program(folder: Path, tmp_path: Path) -> None:
    """A run has at most one process for each worker at a time, and leaves none behind."""

    def children() -> list[str]:
        command = ["pgrep", "-P", str(os.getpid()), "-f", "fleet worker"]
        return subprocess.run(command, capture_output=True, text=True, check=False).stdout.split()

    counts: list[int] = []
    run(folder, tmp_path / "out", workers=2, progress=lambda text, share: counts.append(len(children())))
    assert len(lissom.Fleet(tmp_path / "out").files) > 3 and max(counts) <= 2
    time.sleep(0.2)
    assert children() == []
