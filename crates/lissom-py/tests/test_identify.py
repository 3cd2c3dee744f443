"""Identification from Python: the same numbers as the command, progress, Ctrl-C, refusals."""

from __future__ import annotations

import _thread
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Any

import lissom
import numpy as np
import pytest
from conftest import COULOMB, INERTIA, SIGNALS, VISCOUS


def test_the_parameters_are_those_that_were_simulated(result: lissom.Result) -> None:
    truth = {
        "friction.coulomb": COULOMB,
        "friction.viscous": VISCOUS,
        "drive.inertia": INERTIA,
    }
    for key, value in truth.items():
        found = result[key]
        assert found is not None and abs(found / value - 1) < 2e-3, key
        assert 0 < found.std < 3e-3 * value and found.ci95[0] < found < found.ci95[1]


def written(folder: Path, logs: dict[str, dict[str, Any]]) -> Path:
    """Writes the logs as CSV with every digit, and their campaign."""
    for name, columns in logs.items():
        rows = zip(*columns.values(), strict=True)
        text = [",".join(columns), *(",".join(repr(float(v)) for v in row) for row in rows)]
        (folder / f"{name}.csv").write_text("\n".join(text))
    files = {name: folder / f"{name}.csv" for name in logs}
    lissom.Campaign(files, **SIGNALS).save(folder / "campaign.toml")
    return folder / "campaign.toml"


@pytest.mark.parametrize("effort", ["quick", "normal"])
def test_command_and_python_agree_to_the_last_byte(
    effort: Any, campaign: lissom.Campaign, logs: dict[str, dict[str, Any]], tmp_path: Path
) -> None:
    path = written(tmp_path, logs)
    out = tmp_path / "result.json"
    command = [sys.executable, "-m", "lissom", "identify", str(path), "--effort", effort, "--json", str(out)]
    subprocess.run(command, check=True, capture_output=True)
    assert bytes(lissom.identify(path, effort=effort)) == out.read_bytes()
    # Arrays are what the file has.
    from_arrays = lissom.identify(campaign, effort=effort)
    assert bytes(from_arrays) == out.read_bytes()
    assert lissom.Result.load(out) == from_arrays


def test_progress_grows_to_one(campaign: lissom.Campaign) -> None:
    seen: list[tuple[str, float]] = []
    lissom.identify(campaign, progress=lambda stage, share: seen.append((stage, share)))
    shares = [share for _, share in seen]
    assert shares == sorted(shares) and shares[-1] == 1.0


def test_an_exception_of_the_progress_ends_the_work(campaign: lissom.Campaign) -> None:
    def fail(stage: str, share: float) -> None:
        raise ZeroDivisionError(stage)

    with pytest.raises(ZeroDivisionError):
        lissom.identify(campaign, progress=fail)


def noisy(logs: dict[str, dict[str, Any]]) -> lissom.Campaign:
    """Logs with which a search takes some seconds."""
    random = np.random.default_rng(1)
    long = {}
    for name, columns in logs.items():
        times = 8
        rows = len(columns["t"]) * times
        made = {key: np.tile(values, times) for key, values in columns.items()}
        made["t"] = 2e-3 * np.arange(rows)
        made["theta_m"] = made["theta_m"] + 1e-4 * random.standard_normal(rows)
        long[name] = made
    return lissom.Campaign(long, **SIGNALS)


def test_ctrl_c_ends_the_work_and_leaves_the_best_result(logs: dict[str, dict[str, Any]]) -> None:
    campaign = noisy(logs)
    assert len(campaign.runs) == 2
    began = time.monotonic()
    asked: list[float] = []

    def interrupt() -> None:
        asked.append(time.monotonic())
        _thread.interrupt_main()

    timer = threading.Timer(0.5, interrupt)
    timer.start()
    with pytest.raises(KeyboardInterrupt) as caught:
        lissom.identify(campaign, effort="thorough")
    heard = time.monotonic() - asked[0]
    assert heard < 0.2, f"{heard} s after Ctrl-C, {asked[0] - began} s after the beginning"
    assert isinstance(caught.value, lissom.Interrupted)
    best = caught.value.result
    assert best is not None and best["friction.coulomb"] == pytest.approx(COULOMB, rel=0.05)
    assert caught.value.result is best


def test_other_threads_run_meanwhile(logs: dict[str, dict[str, Any]]) -> None:
    campaign = noisy(logs)
    assert len(campaign.runs) == 2
    counted = 0
    over = threading.Event()

    def count() -> None:
        nonlocal counted
        while not over.wait(0.001):
            counted += 1

    thread = threading.Thread(target=count)
    thread.start()
    began = time.monotonic()
    lissom.identify(campaign, time_limit=1.0)
    took = time.monotonic() - began
    over.set()
    thread.join()
    # Half of the ticks that a free interpreter has at most.
    assert counted > 100 * took, (counted, took)


def test_a_required_parameter_that_is_refused_is_an_error(logs: dict[str, dict[str, Any]]) -> None:
    columns = logs["run-02"]
    part = {key: values[:400] for key, values in columns.items()}
    still = {**part, "theta_m": np.cumsum(np.full(400, 2e-3))}
    campaign = lissom.Campaign(still, **SIGNALS)
    result = lissom.identify(campaign, effort="quick")
    assert not result.ok and result["drive.inertia"] is None
    with pytest.raises(lissom.RefusedError, match=r"drive\.inertia") as caught:
        lissom.identify(campaign, effort="quick", require=["drive"])
    assert caught.value.findings and caught.value.hint
    assert isinstance(caught.value, ValueError)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"effort": "slow"}, 'effort is "slow"'),
        ({"threads": 0}, "threads is 0"),
        ({"threads": 10**6}, "threads is 1000000"),
        ({"require": "friction"}, "require is a list"),
        ({"require": ["friktion"]}, "'friktion' is no key"),
        ({"window": -1.0}, "window is -1.0 s"),
        ({"time_limit": float("nan")}, "time_limit is nan"),
    ],
)
def test_wrong_arguments_are_named(campaign: lissom.Campaign, arguments: Any, message: str) -> None:
    with pytest.raises(lissom.InputError, match=message):
        lissom.identify(campaign, **arguments)


def test_a_result_predicts_another_log(campaign: lissom.Campaign, result: lissom.Result, logs: Any) -> None:
    validation = lissom.validate(result, logs["run-02"], like=campaign)
    assert validation.ok and validation.torque_left is not None and validation.torque_left < 0.2
    assert lissom.validate(result, campaign.like(logs["run-02"])) == validation
    with pytest.raises(lissom.InputError, match="nothing describes the columns"):
        lissom.validate(result, logs["run-02"])


def test_simulations_repeat_and_differ_by_seed(logs: dict[str, dict[str, Any]]) -> None:
    from conftest import ARM, PLAN

    noise = {**ARM, "rig": {**ARM["rig"], "motor_sensor": {"counts_per_turn": 16384, "noise": "1 mrad"}}}
    first, second, other = (lissom.simulate(noise, PLAN, seed=seed) for seed in (0, 0, 1))
    assert np.array_equal(first["run-01"]["theta_m"], second["run-01"]["theta_m"])
    assert not np.array_equal(first["run-01"]["theta_m"], other["run-01"]["theta_m"])
    with pytest.raises(lissom.InputError, match="torque_constant"):
        lissom.simulate({"drive": {}}, PLAN)


def test_a_required_key_that_the_result_does_not_have_is_refused(campaign: lissom.Campaign) -> None:
    with pytest.raises(lissom.RefusedError, match="beam"):
        lissom.identify(campaign, effort="quick", require=["beam"])


@pytest.mark.parametrize("wrong", [{"window": 0.0}, {"horizon": float("nan")}])
def test_wrong_times_of_a_validation_are_named(campaign: lissom.Campaign, result: lissom.Result, wrong: Any) -> None:
    with pytest.raises(lissom.InputError, match="must be positive"):
        lissom.validate(result, campaign, **wrong)


def test_a_forked_process_says_what_to_do(campaign: lissom.Campaign) -> None:
    import multiprocessing

    import lissom._process

    lissom.identify(campaign, effort="quick")
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        assert pool.apply(named, (campaign,)) == "run-01"
    ends, other = multiprocessing.get_context("fork").Pipe(), None
    process = multiprocessing.get_context("fork").Process(target=forked, args=(campaign, ends[1]))
    process.start()
    assert ends[0].poll(20)
    other = ends[0].recv()
    process.join()
    assert "spawn" in other


def named(campaign: lissom.Campaign) -> str:
    """The name of the first run."""
    return campaign.runs[0].name


def forked(campaign: lissom.Campaign, end: Any) -> None:
    """Sends the error of an identification."""
    try:
        lissom.identify(campaign, effort="quick")
    except lissom.LissomError as error:
        end.send(str(error))
    else:
        end.send("no error")


def test_ctrl_c_is_heard_by_a_plan() -> None:
    from conftest import ARM

    asked: list[float] = []

    def interrupt() -> None:
        asked.append(time.monotonic())
        _thread.interrupt_main()

    # Steps of the angle that are coarse for such a precision: many motions are tried.
    beam = {"flexural_rigidity": "0.394 N*m^2", "spans": [{"length": "0.4 m", "mass": "0.3 kg"}], "damping": {"ratio": 0.01}}
    timer = threading.Timer(0.2, interrupt)
    timer.start()
    try:
        with pytest.raises(KeyboardInterrupt):
            lissom.plan({**ARM, "beam": beam}, precision=1e-3)
    finally:
        timer.cancel()
    # The plan itself takes more than a second.
    assert time.monotonic() - asked[0] < 0.2
