"""The covariance of estimates is that of their scatter over noise."""

from __future__ import annotations

from typing import Any

import lissom
import numpy as np
import pytest
from conftest import ARM, PLAN, SIGNALS

KEYS = ["friction.coulomb", "friction.viscous", "drive.inertia"]
CAMPAIGNS = 150
#: Four standard errors of a correlation of so many pairs that have none.
MARGIN = 4 / np.sqrt(CAMPAIGNS)


def test_its_diagonal_is_the_square_of_the_standard_errors(result: lissom.Result) -> None:
    keys, covariance = result.covariance()
    assert set(KEYS) <= set(keys) and covariance.shape == (len(keys), len(keys))
    stds = [result[key].std for key in keys]  # type: ignore[union-attr]
    assert np.sqrt(np.diag(covariance)) == pytest.approx(stds)
    assert np.array_equal(covariance, covariance.T)
    some, part = result.covariance(KEYS[::-1])
    assert some == KEYS[::-1] and part[0, 1] == covariance[keys.index(KEYS[2]), keys.index(KEYS[1])]
    with pytest.raises(lissom.InputError, match="no covariance of friction.forward"):
        result.covariance(["friction.forward"])


def correlation(covariance: Any) -> Any:
    """With ones on the diagonal."""
    std = np.sqrt(np.diag(covariance))
    return covariance / np.outer(std, std)


def test_the_correlation_is_that_of_many_noisy_campaigns() -> None:
    # An encoder of finer steps, so that its noise, which is new in each campaign, is what moves the estimates.
    rig = {**ARM["rig"], "motor_sensor": {"counts_per_turn": 1 << 20, "noise": "0.5 mrad"}}
    found, stated = [], []
    for seed in range(CAMPAIGNS):
        logs = lissom.simulate({**ARM, "rig": rig}, PLAN, seed=1000 * seed)
        result = lissom.identify(lissom.Campaign(logs, **SIGNALS), effort="quick")
        found.append([float(result[key]) for key in KEYS])  # type: ignore[arg-type]
        stated.append(correlation(result.covariance(KEYS)[1]))
    scatter = np.corrcoef(np.array(found).T)
    assert np.abs(np.median(stated, axis=0) - scatter).max() < MARGIN, (np.median(stated, axis=0), scatter)
