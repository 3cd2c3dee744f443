"""Files that are written whole or not at all."""

from __future__ import annotations

import os
from pathlib import Path as FilePath
from typing import TYPE_CHECKING

from ._errors import FileError

if TYPE_CHECKING:
    from ._tables import Path


def write_whole(path: Path, data: bytes) -> None:
    """Write a file whole or not at all.

    Parameters
    ----------
    path : path
        The file; one that exists is replaced.
    data : bytes
        Its content.
    """
    target = FilePath(path)
    part = target.with_name(f".{target.name}.{os.getpid()}.part")
    try:
        try:
            part.write_bytes(data)
            os.replace(part, target)
        finally:
            part.unlink(missing_ok=True)
    except OSError as error:
        raise FileError(f"{target}: {error.strerror}", "check the folder and its permissions") from error
