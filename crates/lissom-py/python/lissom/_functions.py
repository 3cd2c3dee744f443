"""Functions of the package."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal, cast

import numpy as np
from numpy.typing import NDArray

from . import _lissom
from ._campaign import Campaign
from ._errors import InputError, RefusedError
from ._interrupted import Interrupted
from ._plan import Plan
from ._process import use
from ._progress import Progress, progress_of
from ._result import Result
from ._tables import Log, Path, columns, is_path
from ._toml import toml, toml_key
from ._validation import Validation

if TYPE_CHECKING:
    import pandas as pd


#: Most threads of a call.
MOST_THREADS = 1024
#: What keys of parameters start with.
TABLES = ("friction", "drive", "beam", "gravity", "methods")


def identify(
    campaign: Campaign | Path,
    *,
    effort: Literal["quick", "normal", "thorough"] = "normal",
    require: Sequence[str] = (),
    window: float | None = None,
    time_limit: float | None = None,
    threads: int | None = None,
    progress: Progress | bool | None = None,
) -> Result:
    """Identify a drive, and the beam on it, from the logs of a campaign.

    Other threads run meanwhile. Ctrl-C ends the work; the exception has the best result so far.

    Parameters
    ----------
    campaign : Campaign or path
        The campaign, or a campaign.toml.
    effort : {'quick', 'normal', 'thorough'}
        Effort of the search: none (a fraction of a second), about 10 s, or minutes on two cores. It is a count of
        evaluations, so that a result does not depend on the machine.
    require : sequence of str
        Keys that must be identified, as ``friction.coulomb``, ``drive.inertia`` or ``beam``.
    window : float, optional
        Length of the window of the regression [s]; chosen from the data if absent.
    time_limit : float, optional
        Time after which the search ends with the best result so far [s].
    threads : int, optional
        Number of threads; all cores if absent.
    progress : bool or callable, optional
        Whether a bar shows the progress; in notebooks it does if absent, in calls of more than half a second. Or a function
        that is called about every 50 ms with the name of the stage and the share of the work that is done, 0 to 1. If it
        raises an exception, the search ends; the exception's ``__cause__`` is an `Interrupted` with the best result so far.

    Returns
    -------
    Result
        The estimates with standard errors, and the findings.

    Raises
    ------
    InputError
        If no run moves, or an argument is not valid.
    RefusedError
        If the logs do not determine a parameter of `require`.
    Interrupted
        After Ctrl-C.
    """
    if not isinstance(campaign, Campaign):
        campaign = Campaign.load(campaign)
    if threads is not None and not 1 <= threads <= MOST_THREADS:
        raise InputError(f"threads is {threads}; it must be from 1 to {MOST_THREADS}")
    if isinstance(require, str):
        raise InputError("require is a list of keys", f"give it as in require=[{require!r}]")
    for key in require:
        if not str(key).startswith(TABLES):
            raise InputError(f"{key!r} is no key of a result", f"keys start with {', '.join(TABLES)}")
    for name, seconds in (("window", window), ("time_limit", time_limit)):
        if seconds is not None and not seconds > 0:
            raise InputError(f"{name} is {seconds} s; it must be positive")
    with progress_of(progress) as show:
        done, stopped = _lissom.identify(campaign._read(), effort, window, time_limit, threads, show)
    if stopped is not None:
        error, pending = stopped
        if isinstance(error, KeyboardInterrupt):
            raise Interrupted(pending) from None
        raise error from Interrupted(pending)
    result = Result._of(cast("_lissom.Found", done))
    missing = _refused(result, require)
    if missing:
        affecting = tuple(f for f in result.findings if f.severity == "refusal")
        raise RefusedError(
            f"the logs do not determine {', '.join(missing)}",
            "; ".join(dict.fromkeys(f.hint for f in affecting if f.hint)),
            affecting,
        )
    return result


def validate(
    result: Result,
    runs: Log | Sequence[Log] | Campaign,
    *,
    like: Campaign | Path | None = None,
    window: float | None = None,
    horizon: float | None = None,
) -> Validation:
    """Predict torque and motion of a log from which a result was not identified.

    Parameters
    ----------
    result : Result
        The result.
    runs : Campaign, Log or sequence of Log
        The other logs: a campaign of them, or logs with the columns of `like`.
    like : Campaign or path, optional
        A campaign, or a campaign.toml, with the columns, units and drive of the logs.
    window : float, optional
        Length of the window with which both torques are averaged [s].
    horizon : float, optional
        Time over which motion is predicted [s]; found if absent.

    Returns
    -------
    Validation
        What is left, and findings.
    """
    for name, seconds in (("window", window), ("horizon", horizon)):
        if seconds is not None and not 0 < seconds < float("inf"):
            raise InputError(f"{name} is {seconds} s; it must be positive")
    if not isinstance(result, Result):
        raise InputError("validate takes a Result", "read it with Result.load")
    if isinstance(runs, Campaign):
        campaign = runs
    elif like is None:
        raise InputError("nothing describes the columns of the logs", "give like=, the campaign of the result")
    else:
        campaign = (like if isinstance(like, Campaign) else Campaign.load(like)).like(runs)
    return Validation._of(_lissom.validate(result._text, campaign._read(), window, horizon))


def inspect(log: Log, *, header_row: int | None = None, skip_rows: int = 0) -> pd.DataFrame:
    """Describe the channels of a log of any supported format, or of a table in memory.

    Parameters
    ----------
    log : Log
        A path, or a table.
    header_row : int, optional
        Row of a text with the names, from 1; found if absent.
    skip_rows : int
        Rows at the top of a text that do not count.

    Returns
    -------
    pandas.DataFrame
        A row for each channel: name, unit, values, missing, min, max, step, bits, role and why. ``attrs`` has the whole
        description, as ``lissom inspect --json`` writes it.
    """
    import pandas as pd

    use()
    if skip_rows < 0 or (header_row is not None and header_row < 1):
        raise InputError("header_row is from 1, and skip_rows not negative")
    if is_path(log):
        text = _lissom.inspect(os.fspath(cast("Path", log)), header_row, skip_rows)
    else:
        text = _lissom.inspect_columns("table", columns(log, "table"))
    described = json.loads(text)["logs"][0]
    frame = pd.DataFrame(described["channels"])
    roles = {role["channel"]: role for role in described["roles"]}
    frame["role"] = [roles.get(number, {}).get("role") for number in frame["number"]]
    frame["why"] = [roles.get(number, {}).get("reason") for number in frame["number"]]
    frame.attrs.update(described)
    return frame


def compare(results: Mapping[str, Result] | Sequence[Result]) -> pd.DataFrame:
    """Compare results of different logs with the first of them.

    Parameters
    ----------
    results : mapping of str to Result, or sequence of Result
        Two or more results of the same kind of drive.

    Returns
    -------
    pandas.DataFrame
        A row for each parameter and each further result: key, name, unit, result, first, value, difference, std of the
        difference, relative difference, difference in standard errors, and whether it is clear (above 3).
    """
    import pandas as pd

    if isinstance(results, Result):
        raise InputError("compare takes two or more results", "give a list, or a mapping of names")
    named = results if isinstance(results, Mapping) else {f"result {k + 1}": r for k, r in enumerate(results)}
    text = _lissom.compare([(name, bytes(result).decode()) for name, result in named.items()])
    rows = []
    for parameter in json.loads(text)["parameters"]:
        first = parameter["values"][0]
        for name, value, found in zip(list(named)[1:], parameter["values"][1:], parameter["differences"], strict=True):
            found = found or {"value": None, "std": None, "relative": None, "standard_errors": None, "clear": None}
            rows.append(
                {
                    "key": parameter["key"],
                    "name": parameter["name"],
                    "unit": parameter["unit"],
                    "result": name,
                    "first": first and first["value"],
                    "value": value and value["value"],
                    "difference": found["value"],
                    "std": found["std"],
                    "relative": found["relative"],
                    "standard_errors": found["standard_errors"],
                    "clear": found["clear"],
                }
            )
    return pd.DataFrame(rows)


def plan(
    arm: Path | Mapping[str, Any],
    *,
    precision: float | Mapping[str, float] | None = None,
    within: float | None = None,
    travel: float | None = None,
    bend: float | None = None,
    reserve: float | None = None,
    runs: Literal["pair", "sines", "any"] = "pair",
) -> Plan:
    """Choose the runs that give a wanted precision in the least time.

    Parameters
    ----------
    arm : path or mapping
        An arm.toml with [drive] and [rig], or its content; rough numbers are enough.
    precision : float or mapping of str to float, optional
        Relative standard error of all parameters except damping; or those of ``coulomb``, ``viscous``, ``inertia``,
        ``coupling``, ``frequency``, ``damping``, ``gravity``, and ``all``.
    within : float, optional
        Allowed time of all runs with waiting [s]; 1800 if absent.
    travel : float, optional
        Largest angle of the motor [rad]; 1 if absent.
    bend : float, optional
        Largest bending of the tips [rad]; 0.5 if absent.
    reserve : float, optional
        Share of the current limit that is not used; 0.3 if absent.
    runs : {'pair', 'sines', 'any'}
        With a sine and its triple, sines only, or any runs.

    Returns
    -------
    Plan
        The runs, which `simulate` takes, and the expected standard errors.
    """
    use()
    wanted = {} if precision is None else dict(precision) if isinstance(precision, Mapping) else {"all": precision}
    for name, share in wanted.items():
        if not 0 < share < 1:
            raise InputError(f"the precision of {name} is {share}; it must be between 0 and 1", "0.01 is 1 %")
    for name, value in (("within", within), ("travel", travel), ("bend", bend)):
        if value is not None and not 0 < value < float("inf"):
            raise InputError(f"{name} is {value}; it must be positive")
    if reserve is not None and not 0 <= reserve < 1:
        raise InputError(f"reserve is {reserve}; it must be at least 0 and less than 1")
    made = _lissom.plan(wanted, runs, within, travel, bend, reserve, *_file_or_text(arm))
    return Plan(*made)


def simulate(
    arm: Path | Mapping[str, Any], plan: Path | Mapping[str, Any] | Plan, *, seed: int = 0
) -> dict[str, dict[str, NDArray[np.float64]]]:
    """Simulate the experiments of a plan on a virtual arm whose joint sticks and slips.

    Parameters
    ----------
    arm : path or mapping
        An arm.toml with the table [rig], or its content.
    plan : path, mapping or Plan
        A plan.toml, its content, or what `plan` chose.
    seed : int
        Added to the seeds of the plan: other noise of the sensors.

    Returns
    -------
    dict
        For each run its columns: ``t`` [s], ``i`` [A], ``theta_m`` [rad], ``theta_1`` [rad] and so on, as a Campaign takes
        them.
    """
    use()
    if not 0 <= seed < 2**64:
        raise InputError(f"seed is {seed}; it must be from 0 to 2**64 - 1")
    arm_path, arm_text = _file_or_text(arm)
    plan_path, plan_text = (None, plan.text) if isinstance(plan, Plan) else _file_or_text(plan)
    return dict(_lissom.simulate(seed, arm_path, arm_text, plan_path, plan_text))


def _file_or_text(source: Path | Mapping[str, Any]) -> tuple[str | None, str | None]:
    if isinstance(source, Mapping):
        return None, "".join(f"{toml_key(str(key))} = {toml(value)}\n" for key, value in source.items())
    return os.fspath(source), None


def _refused(result: Result, keys: Sequence[str]) -> list[str]:
    """Give those of the keys, or of tables such as ``friction``, whose estimates are refused."""
    missing = []
    for key in keys:
        listed = [name for name in result if name == key or name.startswith((key + ".", key + "_", key + "["))]
        missing += [name for name in listed if result[name] is None] if listed else [key]
    return missing
