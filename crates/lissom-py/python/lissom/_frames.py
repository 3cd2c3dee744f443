"""Tables of results with pandas."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import pandas as pd

    from ._lissom import _Row as Row


def parameters_frame(rows: list[Row]) -> pd.DataFrame:
    """Make a table of parameters, with their keys as index.

    Parameters
    ----------
    rows : list
        The parameters.

    Returns
    -------
    pandas.DataFrame
        A row for each.
    """
    import pandas as pd

    made = []
    for key, name, unit, found, warnings in rows:
        value, std, (low, high) = found if found is not None else (np.nan, np.nan, (np.nan, np.nan))
        made.append((key, name, value, std, low, high, unit, found is None, ", ".join(warnings)))
    heading = ["key", "name", "value", "std", "ci_low", "ci_high", "unit", "refused", "warnings"]
    return pd.DataFrame(made, columns=heading).set_index("key")


def payloads_frame(content: dict[str, Any]) -> pd.DataFrame:
    """Make a table of predicted payloads.

    Parameters
    ----------
    content : dict
        What ``lissom payload --json`` writes; ``attrs`` of the table.

    Returns
    -------
    pandas.DataFrame
        A row for each payload and mode.
    """
    import pandas as pd

    rows = []
    for payload in content["payloads"]:
        for number, mode in enumerate(payload["modes"], start=1):
            row = {"mass_kg": payload["mass_kg"], "mode": number}
            for key, entry in mode.items():
                row |= {key: entry and entry["value"], f"{key}_std": entry and entry["std"]}
            rows.append(row)
    frame = pd.DataFrame(rows)
    frame.attrs.update(content)
    return frame
