"""Estimates compute as their values and keep their uncertainty."""

from __future__ import annotations

import copy
import pickle

import lissom
import numpy as np
import pytest


def test_an_estimate_is_a_float() -> None:
    estimate = lissom.Estimate(0.132, std=0.001, ci95=(0.13, 0.134), unit="N·m")
    assert 2 * estimate == 0.264 and type(2 * estimate) is float
    assert f"{estimate:.2f}" == "0.13" and str(estimate) == "0.132"
    assert np.array([estimate, 1.0]).sum() == 0.132 + 1.0
    with pytest.raises(AttributeError):
        estimate.std = 1.0  # type: ignore[misc]


@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy, lambda x: pickle.loads(pickle.dumps(x))])
def test_copies_are_equal_and_complete(copied: object) -> None:
    estimate = lissom.Estimate(0.132, std=0.001, ci95=(0.13, 0.134), unit="N·m")
    found = copied(estimate)  # type: ignore[operator]
    assert found == estimate and repr(found) == repr(estimate)
