"""Campaigns of files and of tables in memory, and what is wrong with them."""

from __future__ import annotations

import datetime
import pickle
from pathlib import Path
from typing import Any

import lissom
import numpy as np
import pandas as pd
import polars as pl
import pyarrow as pa
import pytest
from conftest import SIGNALS

ROWS = 2000
T = np.arange(ROWS) * 1e-3
COLUMNS = {"t": T, "i": np.sin(9 * T), "q": np.sin(5 * T)}
ROLES: dict[str, Any] = {"time": "t:s", "motor": "q:rad", "current": "i:A"}


def motor(log: Any, **more: Any) -> Any:
    """The motor's angle as the campaign has it."""
    (run,) = lissom.Campaign(log, **{**ROLES, **more}).runs
    return run.motor


TABLES = {
    "mapping": COLUMNS,
    "lists": {name: list(values) for name, values in COLUMNS.items()},
    "pandas": pd.DataFrame(COLUMNS),
    "pandas nullable": pd.DataFrame(COLUMNS).convert_dtypes(),
    "pandas pyarrow": pd.DataFrame(COLUMNS).convert_dtypes(dtype_backend="pyarrow"),
    "pandas index": pd.DataFrame(COLUMNS).set_index("t"),
    "polars": pl.DataFrame(COLUMNS),
    "pyarrow": pa.table(COLUMNS),
    "structured": np.rec.fromarrays(list(COLUMNS.values()), names="t,i,q"),
    "strided": {name: np.repeat(values, 2)[::2] for name, values in COLUMNS.items()},
    "reversed": {name: values[::-1].copy()[::-1] for name, values in COLUMNS.items()},
    "big endian": {name: values.astype(">f8") for name, values in COLUMNS.items()},
    "objects": {name: values.astype(object) for name, values in COLUMNS.items()},
    "masked": {name: np.ma.array(values) for name, values in COLUMNS.items()},
}


@pytest.mark.parametrize("kind", TABLES)
def test_tables_of_every_kind_give_the_same(kind: str) -> None:
    assert np.array_equal(motor(TABLES[kind]), COLUMNS["q"])


def test_a_matrix_has_columns_by_number() -> None:
    matrix = np.stack(list(COLUMNS.values()), axis=1)
    signals = {"time": lissom.Signal(1, "s"), "current": lissom.Signal(2, "A"), "motor": lissom.Signal(3, "rad")}
    assert np.array_equal(motor(matrix, **signals), COLUMNS["q"])


STAMPS = np.datetime64("2026-03-29T00:59:59.5") + (T * 1e9).round().astype("timedelta64[ns]")
TIMES = {
    "numpy": {**COLUMNS, "t": STAMPS},
    "durations": {**COLUMNS, "t": (T * 1e9).round().astype("timedelta64[ns]")},
    "pandas index": pd.DataFrame(COLUMNS, index=pd.DatetimeIndex(STAMPS, name="t")).drop(columns="t"),
    # One hour is skipped here, half a second after the first stamp.
    "time zone": pd.DataFrame({**COLUMNS, "t": pd.to_datetime(STAMPS, utc=True).tz_convert("Europe/Berlin")}),
    "time zone index": pd.DataFrame(
        COLUMNS, index=pd.to_datetime(STAMPS, utc=True).tz_convert("Europe/Berlin").rename("t")
    ).drop(columns="t"),
    "polars": pl.DataFrame({**COLUMNS, "t": STAMPS}),
    "python": {
        **COLUMNS,
        "t": [datetime.datetime(2026, 1, 1) + datetime.timedelta(microseconds=int(k)) for k in (T * 1e6).round()],
    },
}


@pytest.mark.parametrize("kind", TIMES)
def test_times_are_seconds_from_the_first(kind: str) -> None:
    (run,) = lissom.Campaign(TIMES[kind], **ROLES).runs
    assert run.sample_time_s == pytest.approx(1e-3, rel=1e-9) and len(run.motor) == ROWS


def test_the_unit_of_dates_is_seconds() -> None:
    with pytest.raises(lissom.InputError, match='place of "ns"'):
        motor(TIMES["numpy"], time="t:ns")
    zones = [datetime.datetime(2026, 1, 1, tzinfo=datetime.timezone.utc), datetime.datetime(2026, 1, 2)]
    with pytest.raises(lissom.InputError, match="with a zone"):
        motor({**COLUMNS, "t": zones * (ROWS // 2)})


def test_arrays_are_copied() -> None:
    columns = {name: values.copy() for name, values in COLUMNS.items()}
    campaign = lissom.Campaign(columns, **ROLES)
    columns["q"][:] = 0.0
    assert np.array_equal(campaign.runs[0].motor, COLUMNS["q"])


UNUSED = {
    "complex": T + 1j,
    "lists": [[1], [2, 3]] * (ROWS // 2),
    "short": T[:10],
    "never": np.full(ROWS, np.datetime64("NaT")),
    "column_names": T,
}


@pytest.mark.parametrize("kind", [*UNUSED, "twice"])
def test_columns_that_are_not_used_may_be_of_any_kind(kind: str) -> None:
    if kind == "twice":
        frame = pd.DataFrame(np.stack([*COLUMNS.values(), T, T], axis=1), columns=["t", "i", "q", "x", "x"])
        assert np.array_equal(motor(frame), COLUMNS["q"])
    else:
        assert np.array_equal(motor({kind: UNUSED[kind], **COLUMNS}), COLUMNS["q"])


def test_columns_by_number_are_those_of_the_table() -> None:
    signals = {"time": lissom.Signal(1, "s"), "current": lissom.Signal(2, "A"), "motor": lissom.Signal(3, "rad")}
    frame = pd.DataFrame(COLUMNS)
    for table in (frame.rename_axis("sample"), pd.DataFrame(frame.to_numpy()), {"bad": T + 1j, **COLUMNS}):
        numbers = signals
        if isinstance(table, dict):
            numbers = {role: lissom.Signal(int(s.column) + 1, s.unit) for role, s in signals.items()}
        assert np.array_equal(motor(table, **numbers), COLUMNS["q"])


def test_numbers_of_numpy_are_numbers() -> None:
    columns = {name: values for name, values in COLUMNS.items() if name != "t"}
    more = {"torque_constant": np.float32(0.5), "gear_ratio": np.int64(2), "time": np.float32(0.5)}
    (run,) = lissom.Campaign(columns, **{**ROLES, **more}).runs
    assert run.sample_time_s == 0.5
    (run,) = lissom.Campaign(COLUMNS, **{**ROLES, "motor": lissom.Signal("q", "rad", scale=np.float32(2.0))}).runs
    assert np.array_equal(run.motor, 2 * COLUMNS["q"])


def test_runs_keep_their_names_and_their_tables(tmp_path: Path) -> None:
    other = {**COLUMNS, "q": 2 * COLUMNS["q"]}
    pd.DataFrame(other).to_csv(tmp_path / "log.csv", index=False)
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(tmp_path)
        first, second = lissom.Campaign({"log.csv": COLUMNS, "z": "log.csv"}, **ROLES).runs
    assert (first.name, second.name) == ("log.csv", "z")
    assert np.array_equal(first.motor, COLUMNS["q"]) and np.allclose(second.motor, other["q"])
    with pytest.raises(lissom.InputError, match="two runs are called '1'"):
        lissom.Campaign({1: COLUMNS, "1": other}, **ROLES)  # type: ignore[dict-item]
    with pytest.raises(lissom.InputError, match="cannot be called 'motor_raw'"):
        lissom.Campaign(COLUMNS, tips=[lissom.Signal("q", "rad", name="motor_raw")], **ROLES)


def test_a_saved_campaign_finds_the_logs_of_its_signals(tmp_path: Path) -> None:
    pd.DataFrame(COLUMNS).to_csv(tmp_path / "log.csv", index=False)
    pd.DataFrame({"t": T, "a": COLUMNS["q"]}).to_csv(tmp_path / "tip.csv", index=False)
    tip = lissom.Signal("a", "rad", file=tmp_path / "tip.csv")
    (tmp_path / "sub").mkdir()
    lissom.Campaign(tmp_path / "log.csv", tips=[tip], **ROLES).save(tmp_path / "sub" / "c.toml")
    assert 'file = "../tip.csv"' in (tmp_path / "sub" / "c.toml").read_text()


def test_missing_values_are_gaps_and_many_are_an_error() -> None:
    few = {**COLUMNS, "q": np.where(np.arange(ROWS) == 700, np.nan, COLUMNS["q"])}
    assert len(motor(few)) in (ROWS - 1, ROWS)
    with pytest.raises(lissom.InputError, match='row 1, column "q": "inf" is not a finite'):
        motor({**COLUMNS, "q": np.where(np.arange(ROWS) % 3 == 0, np.inf, COLUMNS["q"])})
    with pytest.raises(lissom.InputError, match="table"):
        motor({**COLUMNS, "q": np.full(ROWS, np.nan)})


def test_words_name_the_runs() -> None:
    words = ["up"] * (ROWS // 2) + ["down"] * (ROWS // 2)
    frame = pd.DataFrame({**COLUMNS, "trial": words})
    names = [run.name for run in lissom.Campaign(frame, run="trial", **ROLES).runs]
    assert names == ["table trial up", "table trial down"]


@pytest.mark.parametrize(
    ("log", "message"),
    [
        ({**COLUMNS, "q": COLUMNS["q"][:-1]}, 'different numbers of rows: .*"q" 1999'),
        ({**COLUMNS, "q": COLUMNS["q"] + 1j}, 'column "q" is complex'),
        ({**COLUMNS, "q": np.zeros((ROWS, 2))}, 'column "q" has 2 dimensions'),
        ({**COLUMNS, "q": [1.0, object()] * (ROWS // 2)}, 'column "q", row 2: .* is no number'),
        ({"t": T, "i": T}, 'there is no column "q"'),
        ({}, "no columns"),
        (np.zeros(5), "two dimensions"),
        (7, "a int is not a log"),
        ([], "no run"),
        ({**COLUMNS, "t": T[::-1].copy()}, "time"),
        ({**COLUMNS, "q": np.array(["a"] * ROWS)}, "number"),
        ({**COLUMNS, "q": np.ma.array(["a"] * ROWS)}, "number"),
        ({**COLUMNS, "q": [10**400] * ROWS}, "no number"),
        ({**COLUMNS, "q": np.full(ROWS, np.datetime64("NaT"))}, "table"),
        (pl.DataFrame(COLUMNS).lazy(), "no values yet"),
        (pd.Series(T), "is not a log"),
        (pd.DataFrame(np.zeros((3, 2)), columns=["t", "t"]), "several columns are called t"),
    ],
)
def test_wrong_tables_are_named(log: Any, message: str) -> None:
    with pytest.raises(lissom.InputError, match=message):
        motor(log)


@pytest.mark.parametrize(
    ("arguments", "error", "message"),
    [
        ({"current": None}, lissom.InputError, "given: none"),
        ({"voltage": "v:V"}, lissom.InputError, "given: current and voltage"),
        ({"motor": "q"}, lissom.InputError, "has no unit"),
        ({"motor": 3}, lissom.InputError, "COLUMN:UNIT"),
        ({"motor": "q:furlong"}, lissom.InputError, "furlong"),
        ({"tips": "q:rad"}, lissom.InputError, "tips is a list"),
        ({"torque": None, "wheels": 4}, TypeError, "no argument 'wheels'"),
        ({"gear_ratio": -3.0}, lissom.InputError, "gear_ratio"),
        ({"torque_constant": "0.1 kg"}, lissom.InputError, "torque_constant"),
    ],
)
def test_wrong_descriptions_are_named(arguments: Any, error: Any, message: str) -> None:
    with pytest.raises(error, match=message):
        motor(COLUMNS, **arguments)


def test_a_sample_time_replaces_stamps() -> None:
    columns = {name: values for name, values in COLUMNS.items() if name != "t"}
    (run,) = lissom.Campaign(columns, **{**ROLES, "time": 2e-3}).runs
    assert run.sample_time_s == 2e-3


def test_names_with_any_character(tmp_path: Path) -> None:
    names = {'a "b" \\ c\u007f\n': "q", "ü::x": "i"}
    columns = {"t": T, **{name: COLUMNS[of] for name, of in names.items()}}
    with pytest.raises(lissom.InputError, match="characters"):
        lissom.Campaign({**columns, "\ud800": T}, time="t:s", motor="q:rad", current="i:A")
    first, second = names
    campaign = lissom.Campaign(columns, time="t:s", motor=lissom.Signal(first, "rad"), current=lissom.Signal(second, "A"))
    assert np.array_equal(campaign.runs[0].motor, COLUMNS["q"])
    with pytest.raises(lissom.InputError, match="characters"):
        lissom.Campaign(columns, time="t:s", motor=lissom.Signal("\ud800", "rad"), current="i:A").runs


def test_campaigns_are_saved_and_pickled(tmp_path: Path, campaign: lissom.Campaign) -> None:
    copied = pickle.loads(pickle.dumps(campaign))
    assert [run.name for run in copied.runs] == [run.name for run in campaign.runs]
    with pytest.raises(lissom.InputError, match="table in memory"):
        campaign.save(tmp_path / "campaign.toml")
    pd.DataFrame(COLUMNS).to_csv(tmp_path / "log.csv", index=False)
    on_disk = lissom.Campaign(tmp_path / "log.csv", gravity=True, skip=0.1, **ROLES)
    (tmp_path / "sub").mkdir()
    on_disk.save(tmp_path / "sub" / "campaign.toml")
    loaded = lissom.Campaign.load(tmp_path / "sub" / "campaign.toml")
    assert np.array_equal(loaded.runs[0].motor, on_disk.runs[0].motor)
    assert pickle.loads(pickle.dumps(loaded)).runs[0].name == loaded.runs[0].name
    with pytest.raises(lissom.FileError, match="exists"):
        on_disk.save(tmp_path / "sub" / "campaign.toml")
    other = loaded.like(tmp_path / "log.csv")
    assert np.array_equal(other.runs[0].motor, loaded.runs[0].motor)


def test_inspect_shows_channels_and_roles(tmp_path: Path) -> None:
    frame = lissom.inspect({"t [s]": T, "current [A]": COLUMNS["i"], "position": COLUMNS["q"]})
    assert list(frame["role"]) == ["time", "current", "motor"]
    assert list(frame["unit"])[:2] == ["s", "A"]
    pd.DataFrame(COLUMNS).to_parquet(tmp_path / "log.parquet")
    assert list(lissom.inspect(tmp_path / "log.parquet")["name"]) == ["t", "i", "q"]


def test_tips_have_names_scales_and_offsets(logs: dict[str, dict[str, Any]]) -> None:
    tip = lissom.Signal("theta_m", "rad", name="end", scale=2.0, offset=0.25)
    campaign = lissom.Campaign(logs, tips=[tip], **SIGNALS)
    assert campaign.tips == ("end",)
    assert np.array_equal(campaign.runs[0].tips["end"], 2 * campaign.runs[0].motor + 0.25)


def test_a_tip_that_is_the_motor_is_refused(logs: dict[str, dict[str, Any]]) -> None:
    with pytest.raises(lissom.InputError, match='tip "end" has the same samples as the motor'):
        lissom.Campaign(logs, tips=[lissom.Signal("theta_m", "rad", name="end")], **SIGNALS)


def test_a_tip_has_a_log_and_a_clock_of_its_own(tmp_path: Path) -> None:
    pd.DataFrame(COLUMNS).to_csv(tmp_path / "log.csv", index=False)
    late = T + 0.2
    pd.DataFrame({"ms": 1e3 * T, "a": np.sin(5 * late)}).to_csv(tmp_path / "tip.csv", index=False)
    for time in ("ms:ms", "1 ms", 1e-3):
        tip = lissom.Signal("a", "rad", file=tmp_path / "tip.csv", time=time, clock="shared")
        (run,) = lissom.Campaign(tmp_path / "log.csv", tips=[tip], **ROLES).runs
        assert np.allclose(run.tips["a"], np.sin(5 * (run.time + 0.2)), atol=1e-6)
    # One period of a sine does not show the shift of another clock.
    tip = lissom.Signal("a", "rad", file=tmp_path / "tip.csv", time="1 ms", clock="own")
    with pytest.raises(lissom.InputError, match="at any shift of its clock"):
        _ = lissom.Campaign(tmp_path / "log.csv", tips=[tip], **ROLES).runs


def test_texts_with_decimal_commas_are_read(tmp_path: Path) -> None:
    lines = ["a preamble", "t;i;q", *(f"{t};{i};{q}".replace(".", ",") for t, i, q in zip(*COLUMNS.values(), strict=True))]
    (tmp_path / "log.csv").write_text("\n".join(lines))
    (run,) = lissom.Campaign(tmp_path / "log.csv", decimal=",", header_row=2, **ROLES).runs
    assert np.array_equal(run.motor, COLUMNS["q"])


def test_sample_times_are_texts_or_seconds() -> None:
    columns = {name: values for name, values in COLUMNS.items() if name != "t"}
    for time in ("2 ms", "0.002 s", 2e-3):
        (run,) = lissom.Campaign(columns, **{**ROLES, "time": time}).runs
        assert run.sample_time_s == 2e-3
    with pytest.raises(lissom.InputError, match=r"the signal 't' has no unit\n.*\"t:s\""):
        motor(COLUMNS, time="t")
    with pytest.raises(lissom.InputError, match="sample_time"):
        motor(columns, time="2 kg")


def test_a_torque_constant_of_a_linear_axis_is_in_newtons() -> None:
    for signals in ({"motor": "q:mm", "current": "i:A"}, {"motor": "q:mm", "voltage": "i:V"}):
        plain = lissom.Campaign(COLUMNS, time="t:s", torque_constant=40.0, **signals)  # type: ignore[arg-type]
        per = "N/A" if "current" in signals else "N/V"
        named = lissom.Campaign(COLUMNS, time="t:s", torque_constant=f"40 {per}", **signals)  # type: ignore[arg-type]
        assert plain.runs[0].motor[7] == named.runs[0].motor[7]


def test_messages_are_about_arguments() -> None:
    with pytest.raises(lissom.InputError) as caught:
        motor(COLUMNS, motor="q:furlong")
    assert str(caught.value).startswith("`motor.unit`")
    with pytest.raises(lissom.InputError) as caught:
        motor(COLUMNS, gear_ratio=2.0)
    for word in ("campaign", "line ", "[drive]", ".toml"):
        assert word not in str(caught.value)


def test_campaigns_of_logs_are_saved_and_take_other_logs(tmp_path: Path) -> None:
    for name, factor in (("a b.csv", 1.0), ("c.csv", 2.0), ("d.csv", 3.0)):
        pd.DataFrame({**COLUMNS, "q": factor * COLUMNS["q"]}).to_csv(tmp_path / name, index=False)
    said: Any = {"time": "t:s", "motor": "q:rad", "current": "i:A", "hold": "measured", "torque_constant": 0.2}
    made = lissom.Campaign.of_logs([tmp_path / "a b.csv", tmp_path / "c.csv"], window="0.2 s", current_limit=3.0, **said)
    (tmp_path / "sub").mkdir()
    made.save(tmp_path / "sub" / "campaign.toml")
    text = (tmp_path / "sub" / "campaign.toml").read_text()
    assert 'file = "../a b.csv"' in text and 'window = "0.2 s"' in text and "current_limit = 3" in text
    loaded = lissom.Campaign.load(tmp_path / "sub" / "campaign.toml")
    assert [run.name for run in loaded.runs] == [run.name for run in made.runs] == ["a b.csv", "c.csv"]
    table = {**COLUMNS, "q": 3 * COLUMNS["q"]}
    for campaign in (made, loaded):
        for others in ([tmp_path / "c.csv", tmp_path / "d.csv"], [tmp_path / "c.csv", table]):
            first, second = campaign.like(others).runs
            assert np.array_equal(first.motor, 2 * COLUMNS["q"]) and np.array_equal(second.motor, table["q"])
        (only,) = campaign.like({"mine": table}).runs
        assert only.name == "mine"
    again = made.like([tmp_path / "c.csv", tmp_path / "d.csv"])
    again.save(tmp_path / "again.toml")
    assert len(lissom.Campaign.load(tmp_path / "again.toml").runs) == 2
    with pytest.raises(lissom.InputError, match="copy that file"):
        loaded.save(tmp_path / "third.toml")
    with pytest.raises(lissom.InputError, match=r'motor = "q:UNIT"'):
        lissom.Campaign.of_logs(tmp_path / "d.csv", time="t:s", current="i:A", motor="q")


def test_logs_describe_themselves(tmp_path: Path, logs: dict[str, dict[str, Any]]) -> None:
    rows = zip(*logs["run-01"].values(), strict=True)
    lines = ["Drive: axis 4", "", "Time [ms];Current [A];Position [deg]"]
    lines += [f"{1e3 * t:.0f};{i:.6f};{np.degrees(q):.6f}".replace(".", ",") for t, i, q in rows]
    path = tmp_path / "trace.csv"
    path.write_text("\n".join(lines))
    campaign = lissom.Campaign.of_logs(path, torque_constant=0.2)
    assert any("held" in note for note in campaign.notes)
    assert np.allclose(campaign.runs[0].motor, logs["run-01"]["theta_m"], atol=1e-7)
    found = lissom.identify(pickle.loads(pickle.dumps(campaign)), effort="quick")["drive.inertia"]
    assert found == pytest.approx(2e-3, rel=0.01)
    assert np.array_equal(campaign.like(path).runs[0].motor, campaign.runs[0].motor)
    part = tmp_path / "part.csv"
    part.write_text("\n".join(lines[:2003]))
    assert len(pickle.loads(pickle.dumps(campaign.like(part))).runs[0].motor) == 2000
    with pytest.raises(lissom.InputError, match="Positions"):
        lissom.Campaign.of_logs(path, motor="Positions:deg")
    bare = tmp_path / "bare.csv"
    bare.write_text("\n".join(["a,b,c", *("1,2,3" for _ in range(300))]))
    with pytest.raises(lissom.InputError, match="motor"):
        lissom.Campaign.of_logs(bare)
    # With the plain description, names are those of the table below the preamble.
    with pytest.raises(lissom.InputError, match="Time \\[ms\\]"):
        lissom.Campaign(path, time="Zeit:ms", motor="Position [deg]:deg", current="Current [A]:A").runs
