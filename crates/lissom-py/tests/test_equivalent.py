"""The equivalent arm: the same numbers as the command, from campaigns, tables and arrays."""

from __future__ import annotations

import json
import pickle
import subprocess
import sys
from pathlib import Path
from typing import Any

import lissom
import numpy as np
import pytest

#: An arm of two masses, as in the guide.
ARM: dict[str, Any] = {
    "beam": {
        "flexural_rigidity": "0.0206 N*m^2",
        "spans": [{"length": "15 cm", "mass": "55 g", "count": 2}],
        "damping": {"ratio": 0.005},
    },
    "drive": {
        "inertia": "6.2e-4 kg*m^2",
        "viscous": "1.4e-3 N*m*s/rad",
        "torque_constant": "0.25 N*m/A",
        "coulomb": "0.03 N*m",
    },
    "rig": {
        "sample_time": "3 ms",
        "motor_sensor": {"bits": 14, "range": "360 deg", "noise": "0.2 mrad"},
        "controller": {"proportional": "8 A/rad", "derivative": "0.2 A*s/rad"},
    },
}
PLAN = {"runs": [{"multisine": {"frequency": "0.2 Hz", "to": "10 Hz", "amplitude": "0.4 rad"}, "periods": 6}]}
SIGNALS: dict[str, Any] = {
    "time": "t:s",
    "motor": "theta_m:rad",
    "current": lissom.Signal("i", "A", hold="sampled"),
    "tips": ["theta_1:rad", "theta_2:rad"],
    "torque_constant": "0.25 N*m/A",
}


def by_command(folder: Path, *arguments: object) -> Any:
    """What `lissom equivalent --json` writes."""
    out = folder / "command.json"
    command = [sys.executable, "-m", "lissom", "equivalent", *map(str, arguments), "--json", str(out)]
    subprocess.run(command, check=True, capture_output=True)
    return json.loads(out.read_bytes())


@pytest.fixture(scope="module")
def flexible() -> lissom.Campaign:
    """The campaign of the arm."""
    return lissom.Campaign(lissom.simulate(ARM, PLAN), **SIGNALS)


def test_the_arm_of_a_campaign_is_that_of_the_command(flexible: lissom.Campaign, tmp_path: Path) -> None:
    (columns,) = lissom.simulate(ARM, PLAN).values()
    rows = zip(*columns.values(), strict=True)
    text = [",".join(columns), *(",".join(repr(float(v)) for v in row) for row in rows)]
    (tmp_path / "run-01.csv").write_text("\n".join(text))
    lissom.Campaign(tmp_path / "run-01.csv", **SIGNALS).save(tmp_path / "campaign.toml")
    expected = by_command(tmp_path, tmp_path / "campaign.toml", "--quick", "--save-arm", tmp_path / "arm.toml")
    result = lissom.identify(flexible, effort="quick")
    for source in (result, flexible, tmp_path / "campaign.toml"):
        arm = lissom.equivalent(source, effort="quick")
        assert arm.to_dict() == expected
    arm.save_arm(tmp_path / "python.toml")
    assert (tmp_path / "python.toml").read_bytes() == (tmp_path / "arm.toml").read_bytes()
    assert pickle.loads(pickle.dumps(arm)) == arm and arm.a.shape == (2, 2) and arm.b.shape == (2,)
    with pytest.raises(lissom.InputError, match="has no logs"):
        lissom.equivalent(lissom.Result(bytes(result)))


def responses() -> dict[str, Any]:
    """Responses of two points and a motor: modes at 6 and 40 rad/s."""
    omega = np.array([3, 5, 5.8, 6.2, 8, 12, 18, 25, 32, 38, 42, 48.0])
    first, second = (w**2 / (w**2 - omega**2 + 0.02j * w * omega) for w in (6.0, 40.0))
    coupling = -(omega**2) * (0.25 / (6.0**2 - omega**2 + 0.12j * omega) + 0.2 / (40.0**2 - omega**2 + 0.8j * omega))
    motor = 0.25 / (-6e-4 * omega**2 + 1e-3j * omega + coupling)
    return {"omega_rad_s": omega, "elbow": 0.7 * first + 0.3 * second, "tip": 1.1 * first - 0.1 * second, "motor": motor}


@pytest.mark.parametrize("with_std", [False, True])
def test_arrays_and_tables_give_the_arm_of_the_command(tmp_path: Path, with_std: bool) -> None:
    arrays = responses()
    columns = {"omega_rad_s": arrays["omega_rad_s"]}
    std = {name: 1e-3 * np.abs(values) for name, values in arrays.items() if name != "omega_rad_s"} if with_std else {}
    for name in ("elbow", "tip", "motor"):
        columns |= {f"{name}_re": arrays[name].real, f"{name}_im": arrays[name].imag}
        columns |= {f"{name}_std": std[name]} if with_std else {}
    rows = [",".join(repr(float(values[k])) for values in columns.values()) for k in range(len(arrays["tip"]))]
    table = tmp_path / "responses.csv"
    table.write_text("\n".join([",".join(columns), *rows]))
    expected = by_command(tmp_path, table, "--torque-constant", "0.25 N*m/A")
    assert lissom.equivalent(table, torque_constant=0.25).to_dict() == expected
    found = lissom.equivalent(arrays, torque_constant="0.25 N*m/A", std=std or None)
    assert found.to_dict() == expected and found.points == ("elbow", "tip")
    lowest = found.modes[0]["natural_frequency_rad_s"]
    assert lowest is not None and lowest == pytest.approx(6.0, rel=1e-3) and lowest.unit == "rad/s"
    one = lissom.equivalent([table], modes=1)
    assert len(one.modes) == 1
    with pytest.raises(lissom.InputError, match=r"no arm\.toml: the torque per current is unknown"):
        _ = one.text


@pytest.mark.parametrize(
    ("change", "arguments", "message"),
    [
        ({"omega_rad_s": np.arange(12.0)}, {}, "positive and ascending"),
        ({"tip": np.ones(3)}, {}, "tip has 3 values at 12 frequencies"),
        ({"tip": np.zeros(12)}, {}, "a response is zero"),
        ({"tip": np.full(12, np.nan)}, {}, "finite"),
        ({}, {"torque_constant": "0.25"}, 'the torque constant "0.25" has no unit'),
        ({}, {"std": {"tip": np.ones(12)}}, "some have none"),
        ({}, {"std": {"top": np.ones(12)}}, "'top', which is no response"),
        ({}, {"modes": 0}, "modes is 0"),
    ],
)
def test_wrong_responses_are_reported(change: Any, arguments: Any, message: str) -> None:
    with pytest.raises(lissom.InputError, match=message):
        lissom.equivalent({**responses(), **change}, **arguments)


def test_other_inputs_are_reported(tmp_path: Path) -> None:
    for wrong, message in (([], "takes a Result"), ({"omega_rad_s": [1.0]}, "for each point")):
        with pytest.raises(lissom.InputError, match=message):
            lissom.equivalent(wrong)
    with pytest.raises(FileNotFoundError):
        lissom.equivalent(tmp_path / "missing.csv")
