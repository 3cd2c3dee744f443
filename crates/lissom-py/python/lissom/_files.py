"""Files that are written whole or not at all."""

from __future__ import annotations

import os
import stat
import tempfile
from pathlib import Path as FilePath
from typing import TYPE_CHECKING

from ._errors import file_error

if TYPE_CHECKING:
    from ._tables import Path


def write_whole(path: Path, data: bytes) -> None:
    """Write a file whole or not at all; a device or a pipe directly.

    Parameters
    ----------
    path : path
        The file; one that exists is replaced and keeps its permissions.
    data : bytes
        Its content.
    """
    try:
        target = FilePath(path).resolve()
        mode = target.stat().st_mode if target.exists() else None
        if mode is not None and not stat.S_ISREG(mode):
            target.write_bytes(data)
            return
        number, part = tempfile.mkstemp(prefix=".lissom-", suffix=".part", dir=target.parent)
        try:
            with os.fdopen(number, "wb") as file:
                file.write(data)
            os.chmod(part, stat.S_IMODE(mode) if mode is not None else 0o666 & ~_mask())
            os.replace(part, target)
        except BaseException:
            FilePath(part).unlink(missing_ok=True)
            raise
    except OSError as error:
        raise file_error(os.fspath(path), error, "check the folder and its permissions") from error
    except ValueError as error:
        raise file_error(os.fspath(path), error, "give another name") from error


def _mask() -> int:
    """Give the permissions that new files do not have."""
    mask = os.umask(0)
    os.umask(mask)
    return mask
