"""A simulated axis with friction, and its logs as arrays."""

from __future__ import annotations

from typing import Any

import lissom
import pytest

#: The truth: inertia [kg·m²], viscous friction [N·m·s/rad], Coulomb friction [N·m], torque constant [N·m/A].
INERTIA, VISCOUS, COULOMB, CONSTANT = 2e-3, 5e-3, 0.02, 0.2

ARM: dict[str, Any] = {
    "beam": {"rigid": True},
    "drive": {
        "inertia": f"{INERTIA} kg*m^2",
        "viscous": f"{VISCOUS} N*m*s/rad",
        "torque_constant": f"{CONSTANT} N*m/A",
        "coulomb": f"{COULOMB} N*m",
    },
    "rig": {
        "sample_time": "2 ms",
        "current_limit": "5 A",
        "motor_sensor": {"counts_per_turn": 16384},
        "controller": {"proportional": "4 A/rad", "derivative": "0.15 A*s/rad"},
    },
}
PLAN: dict[str, Any] = {
    "seed": 1,
    "runs": [
        {"sine": {"frequency": "0.5 Hz", "amplitude": "0.8 rad"}, "periods": 6},
        {"sine": {"frequency": "1.5 Hz", "amplitude": "0.4 rad"}, "periods": 12},
    ],
}
#: How the simulated logs are described.
SIGNALS: dict[str, Any] = {
    "time": "t:s",
    "motor": "theta_m:rad",
    "current": lissom.Signal("i", "A", hold="sampled"),
    "torque_constant": CONSTANT,
}


@pytest.fixture(scope="session")
def logs() -> dict[str, dict[str, Any]]:
    """The columns of the runs."""
    return lissom.simulate(ARM, PLAN)


@pytest.fixture(scope="session")
def campaign(logs: dict[str, dict[str, Any]]) -> lissom.Campaign:
    """The campaign of these logs."""
    return lissom.Campaign(logs, **SIGNALS)


@pytest.fixture(scope="session")
def result(campaign: lissom.Campaign) -> lissom.Result:
    """Their quick result."""
    return lissom.identify(campaign, effort="quick")
