"""Progress: a line, a bar in notebooks, functions, and exceptions that these raise."""

from __future__ import annotations

import sys
import types
from typing import Any

import lissom
import lissom._progress as shown
import pytest


def test_a_bar_is_written_over_and_erased(
    campaign: lissom.Campaign, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(shown, "WAIT_S", 0.0)
    lissom.identify(campaign, progress=True)
    written = capsys.readouterr()
    assert written.out == "" and written.err.startswith("\r[") and " % " in written.err and "\n" not in written.err
    assert written.err.endswith("\r") and written.err.split("\r")[-2].strip() == ""
    lissom.identify(campaign, progress=False)
    lissom.identify(campaign)
    assert capsys.readouterr().err == ""
    with pytest.raises(lissom.InputError, match="progress is 3"):
        lissom.identify(campaign, progress=3)  # type: ignore[arg-type]


def test_a_notebook_shows_a_bar_and_removes_it(campaign: lissom.Campaign, monkeypatch: pytest.MonkeyPatch) -> None:
    pages: list[str] = []

    def display(page: str, display_id: bool) -> Any:
        pages.append(page)
        return types.SimpleNamespace(update=pages.append)

    interactive = types.SimpleNamespace(
        get_ipython=lambda: types.SimpleNamespace(kernel=1), display=types.SimpleNamespace(HTML=str, display=display)
    )
    monkeypatch.setitem(sys.modules, "IPython", interactive)  # type: ignore[arg-type]
    lissom.identify(campaign, effort="quick")
    assert pages == []
    monkeypatch.setattr(shown, "WAIT_S", 0.0)
    lissom.identify(campaign)
    assert "<progress" in pages[0] and pages[-1] == ""


def test_an_exception_of_the_function_ends_the_search_and_keeps_the_best_result(campaign: lissom.Campaign) -> None:
    def stop(stage: str, share: float) -> None:
        if stage == "output-error method":
            raise ZeroDivisionError(stage)

    with pytest.raises(ZeroDivisionError) as caught:
        lissom.identify(campaign, effort="thorough", progress=stop)
    interrupted = caught.value.__cause__
    assert isinstance(interrupted, lissom.Interrupted)
    best = interrupted.result
    assert best is not None and best["friction.coulomb"] == pytest.approx(0.02, rel=0.05)
