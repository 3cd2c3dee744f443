"""Exceptions."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ._finding import Finding


class LissomError(Exception):
    """Any error of lissom.

    Parameters
    ----------
    message : str
        What was found, with file, row and column.
    hint : str
        What to do about it; empty if nothing is known.

    Attributes
    ----------
    hint : str
        What to do about it; empty if nothing is known.
    """

    hint: str

    def __init__(self, message: str, hint: str = "") -> None:
        super().__init__(message)
        self.hint = hint

    def __str__(self) -> str:
        message = str(self.args[0]) if self.args else ""
        return f"{message}\nhint: {self.hint}" if self.hint else message

    def __reduce__(self) -> tuple[object, ...]:
        return (type(self), (self.args[0] if self.args else "", self.hint))


class InputError(LissomError, ValueError):
    """A log, a description or an argument cannot be used."""


class FileError(LissomError, OSError):
    """A file cannot be opened, read or written. If a file is missing, the exception is also a FileNotFoundError."""


class MissingFileError(FileError, FileNotFoundError):
    """A file does not exist."""


def file_error(path: object, error: OSError | ValueError, hint: str) -> FileError:
    """Make the exception of a file.

    Parameters
    ----------
    path : path
        The file.
    error : OSError or ValueError
        What the system says.
    hint : str
        What to do about it.

    Returns
    -------
    FileError
        The exception.
    """
    kind = MissingFileError if isinstance(error, FileNotFoundError) else FileError
    shown = repr(path) if isinstance(error, ValueError) else str(path)
    return kind(f"{shown}: {getattr(error, 'strerror', None) or error}", hint)


class RefusedError(LissomError, ValueError):
    """The logs do not determine a parameter that was required.

    Parameters
    ----------
    message : str
        Which parameters are refused.
    hint : str
        What to do about it.
    findings : tuple of Finding
        The findings that give the reasons.

    Attributes
    ----------
    findings : tuple of Finding
        The findings that give the reasons.
    """

    findings: tuple[Finding, ...]

    def __init__(self, message: str, hint: str = "", findings: tuple[Finding, ...] = ()) -> None:
        super().__init__(message, hint)
        self.findings = findings

    def __reduce__(self) -> tuple[object, ...]:
        return (type(self), (self.args[0] if self.args else "", self.hint, self.findings))
