"""Models, simulates and identifies flexible arms and motor drives whose joint has friction.

A log of a drive becomes friction, inertia and a friction-free frequency response, each with a standard error, and findings
that say what the log cannot tell:

>>> import lissom
>>> campaign = lissom.Campaign("run.csv", time="t:s", motor="q:rad", current="i:A")  # doctest: +SKIP
>>> result = lissom.identify(campaign)  # doctest: +SKIP
>>> print(result)  # doctest: +SKIP

Numbers are in SI units and rad/s; an estimate has its unit: ``result["friction.coulomb"].unit``.
"""

from ._campaign import Campaign
from ._equivalent import Equivalent
from ._errors import FileError, InputError, LissomError, MissingFileError, RefusedError
from ._estimate import Estimate
from ._finding import Finding
from ._fleet import Fleet
from ._fleet_run import fleet
from ._fleet_summary import Drift, FleetSummary, Outlier, ParameterSummary
from ._functions import compare, identify, inspect, plan, simulate, validate
from ._interrupted import Interrupted
from ._lissom import __version__
from ._plan import Plan
from ._plots import ResultPlots
from ._prediction import Prediction
from ._responses import equivalent
from ._result import Result
from ._run import Run
from ._signal import Signal
from ._tables import Log
from ._validation import Validation
from ._validation_plots import ValidationPlots

__all__ = [
    "Campaign",
    "Drift",
    "Equivalent",
    "Estimate",
    "FileError",
    "Finding",
    "Fleet",
    "FleetSummary",
    "InputError",
    "Interrupted",
    "LissomError",
    "Log",
    "MissingFileError",
    "Outlier",
    "ParameterSummary",
    "Plan",
    "Prediction",
    "RefusedError",
    "Result",
    "ResultPlots",
    "Run",
    "Signal",
    "Validation",
    "ValidationPlots",
    "__version__",
    "compare",
    "equivalent",
    "fleet",
    "identify",
    "inspect",
    "plan",
    "simulate",
    "validate",
]
