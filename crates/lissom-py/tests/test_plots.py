"""Plots with matplotlib."""

from __future__ import annotations

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
    (line,) = [line for line in axes[0, 1].lines if line.get_label() == "Coulomb and viscous friction"]
    assert line.get_ydata()[0] == pytest.approx(result.friction["coulomb_nm"])
    with pytest.raises(lissom.InputError, match="2 axes are needed"):
        result.plot.bode(ax=axes[0, 0])
    plt.close("all")
