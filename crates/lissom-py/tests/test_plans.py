"""Plans of experiments, and results side by side."""

from __future__ import annotations

import pickle
from pathlib import Path
from typing import Any

import lissom
import pytest
from conftest import ARM, SIGNALS

RIG: dict[str, Any] = {**ARM["rig"], "motor_sensor": {"counts_per_turn": 16384, "noise": "0.2 mrad"}}


def test_a_plan_gives_the_precision_that_it_expects(tmp_path: Path) -> None:
    arm = {**ARM, "rig": RIG}
    plan = lissom.plan(arm, precision=0.01, within=300.0)
    assert plan.ok and pickle.loads(pickle.dumps(plan)).text == plan.text
    logs = lissom.simulate(arm, plan)
    result = lissom.identify(lissom.Campaign(logs, **SIGNALS))
    for key in ("friction.coulomb", "friction.viscous", "drive.inertia"):
        found = result[key]
        assert found is not None and found.std < 0.02 * found, key
    plan.save(tmp_path / "plan.toml")
    assert list(lissom.simulate(arm, tmp_path / "plan.toml")) == list(logs)
    assert {"parameter", "relative_std", "wanted"} <= set(plan.to_frame().columns)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"precision": 1.0}, "the precision of all is 1.0"),
        ({"precision": {"speed": 0.1}}, 'asked of "speed"'),
        ({"within": 0.0}, "within is 0.0"),
        ({"reserve": 1.0}, "reserve is 1.0"),
        ({"runs": "none"}, 'runs is "none"'),
    ],
)
def test_wrong_wishes_are_named(arguments: Any, message: str) -> None:
    with pytest.raises(lissom.InputError, match=message):
        lissom.plan(ARM, **arguments)


def test_a_changed_parameter_is_clear_and_the_others_are_not(result: lissom.Result) -> None:
    from conftest import PLAN

    heavier = {**ARM, "drive": {**ARM["drive"], "inertia": "2.1e-3 kg*m^2"}}
    other = lissom.identify(lissom.Campaign(lissom.simulate(heavier, PLAN), **SIGNALS), effort="quick")
    table = lissom.compare({"before": result, "after": other}).set_index("key")
    assert table.loc["drive.inertia", "clear"]
    assert table.loc["drive.inertia", "relative"] == pytest.approx(0.05, rel=0.05)
    assert not table.loc["friction.offset", "clear"]
    with pytest.raises(lissom.InputError, match="same estimates"):
        lissom.compare([result, result])
    with pytest.raises(lissom.InputError, match="only result"):
        lissom.compare([result])
