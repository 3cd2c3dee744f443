"""Progress of long calls: a bar in notebooks, a line on a terminal."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from html import escape
from typing import Any, Protocol, TypeAlias

from ._errors import InputError

#: Calls that take less time show nothing [s].
WAIT_S = 0.5
#: Number of characters of a bar in a line.
WIDTH = 30

#: A function that is called with the name of the stage and the share of the work that is done.
Progress: TypeAlias = Callable[[str, float], None]


class Shown(Protocol):
    """What shows a bar."""

    def show(self, stage: str, share: float) -> None:
        """Show or update it."""

    def remove(self) -> None:
        """Remove it."""


class Line:
    """A line on standard error, which is written over."""

    def show(self, stage: str, share: float) -> None:
        """Write the line.

        Parameters
        ----------
        stage : str
            Name of the stage.
        share : float
            Share of the work that is done, 0 to 1.
        """
        full = round(WIDTH * share)
        print(f"\r[{'#' * full}{'.' * (WIDTH - full)}] {100 * share:3.0f} % {stage:24}", end="", file=sys.stderr, flush=True)

    def remove(self) -> None:
        """Erase the line."""
        print("\r" + " " * (WIDTH + 34) + "\r", end="", file=sys.stderr, flush=True)


class Display:
    """A bar below a cell of a notebook.

    Parameters
    ----------
    display : module
        The module IPython.display.
    """

    def __init__(self, display: Any) -> None:
        self._display = display
        self._handle: Any = None

    def show(self, stage: str, share: float) -> None:
        """Show or update the bar.

        Parameters
        ----------
        stage : str
            Name of the stage.
        share : float
            Share of the work that is done, 0 to 1.
        """
        bar = f'<progress max="1" value="{share:.3f}" style="width:20em"></progress> {100 * share:.0f} % {escape(stage)}'
        page = self._display.HTML(bar)
        if self._handle is None:
            self._handle = self._display.display(page, display_id=True)
        elif self._handle is not None:
            self._handle.update(page)

    def remove(self) -> None:
        """Remove the bar."""
        if self._handle is not None:
            self._handle.update(self._display.HTML(""))


def in_notebook() -> bool:
    """Whether this is a notebook or a console with a kernel.

    Returns
    -------
    bool
        Whether it is.
    """
    shell = sys.modules["IPython"].get_ipython() if "IPython" in sys.modules else None
    return getattr(shell, "kernel", None) is not None


@contextmanager
def progress_of(progress: Progress | bool | None) -> Iterator[Progress | None]:
    """Give the function that shows progress; remove its bar at the end.

    Parameters
    ----------
    progress : callable, bool or None
        A function; whether a bar is shown; None for a bar in notebooks only.

    Yields
    ------
    callable or None
        The function.
    """
    if progress is False or (progress is None and not in_notebook()):
        yield None
        return
    if progress is not None and progress is not True:
        if not callable(progress):
            raise InputError(f"progress is {progress!r}", "give True, False, or a function of the stage and the share")
        yield progress
        return
    shown: Shown = Display(sys.modules["IPython"].display) if in_notebook() else Line()
    began, seen = time.monotonic(), False

    def show(stage: str, share: float) -> None:
        nonlocal seen
        if stage != "done" and (seen or time.monotonic() - began > WAIT_S):
            seen = True
            shown.show(stage, share)

    try:
        yield show
    finally:
        if seen:
            shown.remove()
