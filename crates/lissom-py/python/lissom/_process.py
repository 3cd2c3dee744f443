"""The library's threads do not survive a fork."""

from __future__ import annotations

import os

from ._errors import LissomError

_used_in: int | None = None


def use() -> None:
    """Refuse to go on in a child of a process that used the library before its fork: it would hang."""
    global _used_in
    if _used_in is None:
        _used_in = os.getpid()
    elif _used_in != os.getpid():
        raise LissomError(
            "lissom was used before this process was forked, and its threads are not here",
            'start processes with multiprocessing.get_context("spawn")',
        )
