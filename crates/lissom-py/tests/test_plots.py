"""Plots with matplotlib."""

from __future__ import annotations

import pickle

import lissom
import numpy as np
import pytest

matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("Agg")


def test_a_bode_plot_has_the_responses_and_the_model(result: lissom.Result) -> None:
    magnitude, phase = result.plot.bode()
    labels = [text.get_text() for text in magnitude.get_legend().get_texts()]
    assert {"raw", "without friction, doubtful", "model"} == set(labels)
    assert magnitude.get_xscale() == "log" and "dB" in magnitude.get_ylabel() and "°" in phase.get_ylabel()
    corrected = next(c for c in magnitude.containers if c.get_label().startswith("without friction"))
    drawn = corrected[0].get_ydata()
    assert np.isin(np.round(drawn, 9), np.round(20 * np.log10(np.abs(result.response["motor_corrected"])), 9)).all()
    with pytest.raises(lissom.InputError, match="no response of 'tip'"):
        result.plot.bode("tip")


def test_plots_go_into_given_axes(result: lissom.Result) -> None:
    import matplotlib.pyplot as plt

    _, axes = plt.subplots(2, 2)
    assert result.plot.bode(ax=axes[:, 0])[0] is axes[0, 0]
    assert result.plot.friction(ax=axes[0, 1]) is axes[0, 1]
    line = next(line for line in axes[0, 1].lines if line.get_label() == "Coulomb and viscous friction")
    assert line.get_ydata()[0] == pytest.approx(result.friction["forward"])
    with pytest.raises(lissom.InputError, match="2 axes are needed"):
        result.plot.bode(ax=axes[0, 0])
    plt.close("all")


def test_residuals_are_those_of_the_validation(campaign: lissom.Campaign, result: lissom.Result) -> None:
    import matplotlib.pyplot as plt

    validation = lissom.validate(result, campaign)
    torque, motor = validation.plot.residual()
    assert "torque (N·m)" in torque.get_ylabel() and "motor (rad)" in motor.get_ylabel()
    first, second = validation.motion["motor"]
    assert np.array_equal(motor.lines[0].get_ydata(), first.residual, equal_nan=True)
    assert motor.lines[1].get_xdata()[0] == pytest.approx(len(first.time) * campaign.runs[0].sample_time_s)
    assert np.array_equal(second.measured, campaign.runs[1].motor) and second.run == "run-02"
    shown = next(run for run in validation.torque if np.isfinite(run.residual).any())
    there = np.isfinite(shown.residual)
    left = np.linalg.norm(shown.residual[there]) / np.linalg.norm(shown.measured[there])
    assert shown.unit == "N·m" and left < 0.1
    (own,) = result.plot.residual(channels=["motor"])
    assert np.array_equal(own.lines[0].get_ydata(), first.residual, equal_nan=True)
    _, axes = plt.subplots()
    assert result.plot.residual(campaign, ["torque"], axes)[0] is axes
    with pytest.raises(lissom.InputError, match="no prediction of 'tip'"):
        validation.plot.residual(["tip"])
    with pytest.raises(lissom.InputError, match="has no logs"):
        lissom.Result(bytes(result)).plot.residual()
    with pytest.raises(lissom.InputError, match="was unpickled"):
        pickle.loads(pickle.dumps(validation)).plot.residual()
    plt.close("all")


def test_friction_with_a_load_is_drawn_with_its_sign(result: lissom.Result) -> None:
    import json

    import matplotlib.pyplot as plt

    content = result.to_dict()
    for point in content["friction"]["curve"]:
        for key in [key for key in point if key.startswith("friction")]:
            point[key]["value"] = -0.7 if point["direction"] == "backward" else 0.9
    content["friction"]["forward"]["value"], content["friction"]["backward"]["value"] = 0.9, -0.7
    axes = lissom.Result(json.dumps(content).encode()).plot.friction()
    drawn = axes.containers[0][0]
    values = np.array(drawn.get_ydata(), dtype=float)
    assert set(values[np.array(drawn.get_xdata(), dtype=float) < 0]) == {0.7}
    lines = [line.get_ydata()[0] for line in axes.lines if line.get_color() == "C3"]
    assert lines == [0.9, 0.7]
    plt.close("all")
