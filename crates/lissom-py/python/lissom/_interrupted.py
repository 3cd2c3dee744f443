"""Ctrl-C while logs are identified."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ._result import Result

if TYPE_CHECKING:
    from ._lissom import Pending


class Interrupted(KeyboardInterrupt):
    """Ctrl-C while logs are identified; `result` is the best result so far.

    Parameters
    ----------
    pending : object
        The work, which ends soon.
    """

    def __init__(self, pending: Pending | None = None) -> None:
        super().__init__("interrupted; `.result` is the best result so far")
        self._pending = pending
        self._result: Result | None = None

    @property
    def result(self) -> Result | None:
        """The best result so far. Waits until the work has ended, which takes about a second."""
        if self._pending is not None:
            pending, self._pending = self._pending, None
            self._result = Result._of(*pending.wait())
        return self._result
