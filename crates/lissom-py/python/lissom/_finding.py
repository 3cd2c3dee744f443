"""What the logs do not determine, and what to know about estimates."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal


@dataclass(frozen=True)
class Finding:
    """A finding about logs or estimates.

    Parameters
    ----------
    code : str
        Stable name; the page Findings of the book lists all codes.
    severity : {'info', 'warning', 'refusal'}
        How much it matters. A warning: the estimates in `affects` are less certain than their standard errors say.
        A refusal: they are not given.
    run : str or None
        The run that it is about; None if it is about all.
    affects : tuple of str
        Keys of the affected estimates, without the ending of their unit.
    message : str
        What was found.
    hint : str
        What to do about it.
    """

    code: str
    severity: Literal["info", "warning", "refusal"]
    run: str | None
    affects: tuple[str, ...]
    message: str
    hint: str

    @classmethod
    def _of(cls, entry: dict[str, Any]) -> Finding:
        return cls(
            code=entry["code"],
            severity=entry["severity"],
            run=entry["run"],
            affects=tuple(entry["affects"]),
            message=entry["message"],
            hint=entry["hint"],
        )

    def __str__(self) -> str:
        run = f" {self.run}:" if self.run else ""
        hint = f"\n  hint: {self.hint}" if self.hint else ""
        return f"{self.severity} [{self.code}]{run} {self.message}{hint}"
