"""Experiments that give a wanted precision."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from ._files import write_whole

if TYPE_CHECKING:
    import pandas as pd

    from ._tables import Path


class Plan:
    """The runs that give a wanted precision in the least time; `simulate` takes it.

    Parameters
    ----------
    data : str
        What ``lissom plan --json`` writes.
    text : str
        The plan.toml.
    """

    def __init__(self, data: str, text: str) -> None:
        self._data = data
        self._text = text
        self._root: dict[str, Any] = json.loads(data)

    @property
    def text(self) -> str:
        """The plan.toml, for ``lissom rig``."""
        return self._text

    @property
    def notes(self) -> tuple[str, ...]:
        """What to know about the plan: a precision that cannot be reached, modes that are left out."""
        return tuple(note["message"] for note in self._root["notes"])

    @property
    def ok(self) -> bool:
        """Whether every wanted precision is expected to be reached."""
        return all(entry["relative_std"] <= entry["wanted"] for entry in self._root["expected"])

    def to_frame(self) -> pd.DataFrame:
        """Make a table of the expected standard errors with pandas.

        Returns
        -------
        pandas.DataFrame
            A row for each parameter, with its expected and its wanted relative standard error.
        """
        import pandas as pd

        return pd.DataFrame(self._root["expected"])

    def to_dict(self) -> dict[str, Any]:
        """Give everything that ``lissom plan --json`` writes.

        Returns
        -------
        dict
            A new one for each call.
        """
        content: dict[str, Any] = json.loads(self._data)
        return content

    def save(self, path: Path) -> None:
        """Write the plan.toml, whole or not at all.

        Parameters
        ----------
        path : path
            The file; one that exists is replaced.
        """
        write_whole(path, self._text.encode())

    def __reduce__(self) -> tuple[Any, ...]:
        return (Plan, (self._data, self._text))

    def __repr__(self) -> str:
        return self._text.rstrip()
