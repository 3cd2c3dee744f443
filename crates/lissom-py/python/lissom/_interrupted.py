"""Ctrl-C while logs are identified."""

from __future__ import annotations

import threading
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
        self._lock = threading.Lock()

    @property
    def result(self) -> Result | None:
        """The best result so far. Waits until the work has ended, which takes about a second."""
        with self._lock:
            if self._pending is not None:
                self._result = Result._of(self._pending.wait())
                self._pending = None
            return self._result

    def __reduce__(self) -> tuple[object, ...]:
        return (_restored, (self.result,))


def _restored(result: Result | None) -> Interrupted:
    made = Interrupted()
    made._result = result
    return made
