"""What a result contains: made when it is needed of a fresh result, checked of one that is read."""

from __future__ import annotations

import functools
import json
from typing import TYPE_CHECKING, Any

from . import _lissom
from ._errors import InputError
from ._estimate import Estimate

if TYPE_CHECKING:
    from ._lissom import _Row as Row


class Content:
    """The content of a result.

    Parameters
    ----------
    found : object, optional
        What an identification of this process found.
    """

    def __init__(self, found: _lissom.Found | None = None) -> None:
        self.found = found

    @classmethod
    def read(cls, data: bytes) -> Content:
        """Read and check a result.json.

        Parameters
        ----------
        data : bytes
            Its bytes.

        Returns
        -------
        Content
            The content.
        """
        made = cls()
        made.data = data
        try:
            made.root = json.loads(data.decode("utf-8-sig"))
        except (ValueError, RecursionError) as error:
            raise InputError(f"the data are no result: {error}") from None
        # Says what is missing if the JSON is of something else.
        made.rows = _lissom.parameters(data.decode())
        return made

    @functools.cached_property
    def data(self) -> bytes:
        """The bytes of result.json."""
        return b"" if self.found is None else self.found.data()

    @functools.cached_property
    def root(self) -> dict[str, Any]:
        """Its tables."""
        root: dict[str, Any] = json.loads(self.data)
        return root

    @functools.cached_property
    def rows(self) -> list[Row]:
        """The parameters."""
        return [] if self.found is None else self.found.parameters()

    @functools.cached_property
    def listed(self) -> dict[str, Estimate | None]:
        """Their estimates by key; None if refused."""
        return {
            key: None if found is None else Estimate(found[0], found[1], (found[2][0], found[2][1]), unit)
            for key, _, unit, found, _ in self.rows
        }
