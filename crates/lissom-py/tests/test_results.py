"""Results: keys, units, copies, tables, and models of other libraries."""

from __future__ import annotations

import json
import pickle
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import lissom
import numpy as np
import pytest


def test_keys_and_units_are_those_of_the_table(result: lissom.Result) -> None:
    table = result.to_frame()
    assert list(table.index) == list(result.keys()) == list(result) and table.index.name == "key"
    for key, unit in table["unit"].items():
        found = result[str(key)]
        assert found is None or found.unit == unit, key
    assert table.loc["friction.coulomb", "value"] == result["friction.coulomb"]
    assert isinstance(result, Mapping) and dict(result) == dict(result.items())
    assert result.get("friction.nothing") is None and result.get("drive.inertia") in result.values()
    assert result["friction.coulomb"] == result.friction["coulomb"]
    assert "friction.coulomb" in result and len(result) == len(table)
    methods = result["methods.regression.coulomb"]
    assert methods is not None and methods.unit == "N·m"
    for wrong in ("friction.coulomb_nm", "friction", "beam.modes[7].damping_ratio", "methods.regression.rows"):
        with pytest.raises(KeyError):
            result[wrong]


def test_a_result_is_its_bytes(result: lissom.Result, tmp_path: Path) -> None:
    copied = pickle.loads(pickle.dumps(result))
    assert copied == result and hash(copied) == hash(result) and bytes(copied) == bytes(result)
    result.save(tmp_path / "result.json")
    assert lissom.Result.load(tmp_path / "result.json") == result
    assert result.to_dict() == json.loads(bytes(result))
    # A fresh result takes its parameters directly, a read one from its bytes.
    assert copied.to_frame().equals(result.to_frame())
    with pytest.raises(TypeError):
        result.friction["coulomb"] = None  # type: ignore[index]
    with pytest.raises(ValueError, match="read-only"):
        result.frequency[0] = 1.0


def test_text_and_html_have_every_parameter(result: lissom.Result) -> None:
    text, html = repr(result), result._repr_html_()
    for name in ("Coulomb friction", "viscous friction", "inertia"):
        assert name in text and name in html
    assert "<script" not in html


def test_the_page_and_the_figures_are_those_of_the_logs(result: lissom.Result, tmp_path: Path) -> None:
    path = tmp_path / "axis 1.html"
    result.report(path)
    page = path.read_text()
    assert "<h1>axis 1</h1>" in page and page.rstrip().endswith("</html>")
    assert "Coulomb friction" in page and "Frequency responses" in page
    for named in ("lissom identify", "lissom equivalent", "--quick"):
        assert named not in page
    html = result._repr_html_()
    assert html.count("<svg xmlns") == 2 and "Friction against speed" in html
    assert [file.name for file in tmp_path.iterdir()] == ["axis 1.html"]
    with pytest.raises(lissom.FileError):
        result.report(tmp_path / "missing" / "axis.html")


def test_a_result_without_logs_has_no_page(result: lissom.Result, tmp_path: Path) -> None:
    for other in (lissom.Result(bytes(result)), pickle.loads(pickle.dumps(result))):
        assert other == result and "<svg" not in other._repr_html_()
        with pytest.raises(lissom.InputError) as caught:
            other.report(tmp_path / "report.html")
        assert "identify the logs again" in caught.value.hint
    assert not list(tmp_path.iterdir())


def test_html_shows_names_of_logs_as_text(result: lissom.Result) -> None:
    content = result.to_dict()
    content["findings"][0] |= {"severity": "warning", "run": "<script>alert(1)</script>"}
    html = lissom.Result(json.dumps(content).encode())._repr_html_()
    assert "<script" not in html and "&lt;script" in html


@pytest.mark.parametrize(
    ("data", "message"), [(b"{", "no result"), (b"{}", "lissom"), (b"\xff", "no result"), (b"[" * 100_000, "no result")]
)
def test_other_files_are_no_results(data: bytes, message: str, tmp_path: Path) -> None:
    path = tmp_path / "other.json"
    path.write_bytes(data)
    with pytest.raises(lissom.InputError) as caught:
        lissom.Result.load(path)
    assert str(path) in str(caught.value)


def test_a_missing_file_is_an_os_error(tmp_path: Path) -> None:
    for read in (lissom.Result.load, lissom.Campaign.load, lissom.inspect):
        with pytest.raises(OSError) as caught:
            read(tmp_path / "missing.json")
        assert isinstance(caught.value, lissom.FileError) and isinstance(caught.value, FileNotFoundError)
        assert "missing.json" in str(caught.value)
    copied = pickle.loads(pickle.dumps(caught.value))
    assert str(copied) == str(caught.value) and copied.hint == caught.value.hint


def test_models_of_python_control(result: lissom.Result) -> None:
    control = pytest.importorskip("control")
    omega = 7.0
    space, transfer = result.to_control(), result.to_control(kind="tf")
    inertia, viscous = result["drive.inertia"], result["friction.viscous"]
    assert inertia is not None and viscous is not None
    expected = 0.2 / (inertia * (1j * omega) ** 2 + viscous * 1j * omega)
    assert space(1j * omega) == pytest.approx(expected, rel=1e-9)
    assert transfer(1j * omega) == pytest.approx(expected, rel=1e-9)
    data = result.to_control(kind="frd")
    assert isinstance(data, control.FrequencyResponseData)
    with pytest.raises(lissom.InputError, match="no output 'tip'"):
        result.to_control("tip")


def test_responses_are_arrays(result: lissom.Result) -> None:
    assert set(result.response) == set(result.response_std)
    for name, response in result.response.items():
        assert response.shape == result.frequency.shape == result.response_std[name].shape
        assert response.dtype == np.complex128


def test_exports(result: lissom.Result, tmp_path: Path) -> None:
    assert f'frictionloss="{float(result.friction["coulomb"] or 0)!r}"' in result.to_mjcf()
    robot = tmp_path / "robot.urdf"
    robot.write_text('<robot><joint name="j" type="revolute"/></robot>')
    assert "dynamics" in result.to_urdf("j", robot)
    result.to_mat(tmp_path / "model.mat")
    assert (tmp_path / "model.mat").read_bytes()[:6] == b"MATLAB"
    assert [file.name for file in result.to_c(tmp_path / "c")] == ["lissom_feedforward.h", "lissom_feedforward.c"]
    assert "control" in result.to_script()
    with pytest.raises(lissom.InputError, match="no joint"):
        result.to_urdf("k", robot)
    with pytest.raises(lissom.InputError, match="together"):
        result.to_mjcf("j")


def test_refused_estimates_are_none(logs: Any) -> None:
    from conftest import SIGNALS

    columns = {key: values[:400] for key, values in logs["run-02"].items()}
    columns["theta_m"] = np.cumsum(np.full(400, 2e-3))
    result = lissom.identify(lissom.Campaign(columns, **SIGNALS), effort="quick")
    assert result.drive["inertia"] is None
    frame = result.to_frame()
    assert frame.loc["drive.inertia", "refused"]
    assert "refused" in repr(result) and "refused" in result._repr_html_()


def test_a_rigid_joint_has_no_payload_to_predict(result: lissom.Result) -> None:
    with pytest.raises(lissom.InputError, match="has no tip"):
        result.payload(mass=0.1, to=[0.2], at=0.3)
    with pytest.raises(lissom.InputError, match="must not be negative"):
        result.payload(mass=-0.1, to=[0.2])
    with pytest.raises(lissom.InputError, match="has no logs"):
        lissom.Result(bytes(result)).payload(mass=0.1, to=[0.2])


def test_a_result_of_other_tables_is_none(result: lissom.Result) -> None:
    for key in ("findings", "frequency_response", "models", "gravity", "verdict"):
        content = result.to_dict()
        content[key] = 7
        with pytest.raises(lissom.InputError):
            lissom.Result(json.dumps(content).encode())
    with pytest.raises(lissom.InputError, match="made of bytes"):
        lissom.Result("result.json")  # type: ignore[arg-type]


def test_files_are_written_whole_by_many_threads_and_keep_their_mode(result: lissom.Result, tmp_path: Path) -> None:
    from concurrent.futures import ThreadPoolExecutor

    path, link = tmp_path / "result.json", tmp_path / "link.json"
    path.write_text("old")
    path.chmod(0o600)
    link.symlink_to(path)
    with ThreadPoolExecutor(4) as pool:
        list(pool.map(lambda _: result.save(link), range(100)))
    assert path.read_bytes() == bytes(result) and link.is_symlink() and path.stat().st_mode & 0o777 == 0o600
    assert sorted(file.name for file in tmp_path.iterdir()) == ["link.json", "result.json"]
    for wrong in (tmp_path, tmp_path / "no" / "r.json", "a\0b", tmp_path / ("x" * 400)):
        with pytest.raises(lissom.FileError):
            result.save(wrong)
    with pytest.raises(lissom.FileError):
        result.to_c(path / "c")


def test_tips_have_responses_and_models_of_their_own() -> None:
    pytest.importorskip("control")
    from conftest import ARM, PLAN

    spans = [{"length": "0.2 m", "mass": "0.2 kg"}, {"length": "0.2 m", "mass": "0.3 kg"}]
    arm = {**ARM, "beam": {"flexural_rigidity": "0.394 N*m^2", "spans": spans}}
    logs = lissom.simulate(arm, PLAN)
    tips = [lissom.Signal("theta_2", "rad", name="m"), lissom.Signal("theta_1", "rad", name="m2")]
    signals: Any = {"time": "t:s", "motor": "theta_m:rad", "current": lissom.Signal("i", "A", hold="sampled")}
    result = lissom.identify(lissom.Campaign(logs, tips=tips, torque_constant=0.2, **signals), effort="quick")
    whole = result.to_control()
    for row, name in enumerate(("m", "m2"), start=1):
        if any(name == label.rsplit("_", 1)[0] for label in whole.output_labels):
            one = result.to_control(name)
            place = [label.rsplit("_", 1)[0] for label in whole.output_labels].index(name)
            assert one(2.0j) == pytest.approx(whole(2.0j)[place])
    with pytest.raises(lissom.InputError, match="no output 'motor_rad'"):
        result.to_control("motor_rad")
