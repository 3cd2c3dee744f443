"""Results of an identification."""

from __future__ import annotations

import functools
import json
import os
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path as FilePath
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Literal, TypeVar

import numpy as np
from numpy.typing import NDArray

from . import _lissom
from ._content import Content
from ._errors import InputError, file_error
from ._estimate import Estimate, estimates, is_estimate
from ._files import write_whole
from ._finding import Finding
from ._frames import parameters_frame, payloads_frame
from ._plots import ResultPlots
from ._tables import Path
from ._validation import Validation

if TYPE_CHECKING:
    import control  # type: ignore[import-untyped,unused-ignore]
    import pandas as pd

    from ._campaign import Campaign


#: What to do about a result without logs.
NO_LOGS = "identify the logs again: a result that was read from a file has no logs"


class Result(Mapping[str, "Estimate | None"]):
    """What the logs of a drive say: friction, inertia, modes, responses, and findings.

    A result is an immutable mapping of keys, as ``friction.coulomb``, to estimates, in the order of the tables. An estimate
    that the logs do not determine is None, and a finding gives the reason. Its bytes are those of the file result.json; by its
    keys ``result["methods.regression.coulomb"]`` gives further estimates, which are not listed.

    Parameters
    ----------
    data : bytes
        A result.json.
    """

    def __init__(self, data: bytes) -> None:
        if isinstance(data, (str, int)):
            raise InputError("a Result is made of bytes", "read a file with Result.load")
        self._content = Content.read(bytes(data))

    @classmethod
    def _of(cls, found: _lissom.Found) -> Result:
        """Make a result of what was found, with the logs that it is from."""
        result = cls.__new__(cls)
        result._content = Content(found)
        return result

    @classmethod
    def load(cls, path: Path) -> Result:
        """Read a result.json.

        Parameters
        ----------
        path : path
            The file, written by `save` or by ``lissom identify --json``.

        Returns
        -------
        Result
            The result.
        """
        try:
            data = FilePath(path).read_bytes()
        except (OSError, ValueError) as error:
            raise file_error(os.fspath(path), error, "check the path") from error
        try:
            return cls(data)
        except InputError as error:
            raise InputError(f"{os.fspath(path)}: {error.args[0]}", error.hint) from None

    def save(self, path: Path) -> None:
        """Write a result.json, whole or not at all.

        Parameters
        ----------
        path : path
            The file; one that exists is replaced.
        """
        write_whole(path, self._content.data)

    def report(self, path: Path) -> None:
        """Write the report page: parameters, figures, tables and findings as one HTML file, whole or not at all.

        Parameters
        ----------
        path : path
            The file; one that exists is replaced.

        Raises
        ------
        InputError
            If the result was read from a file or unpickled: only `identify` gives a result with its logs.
        """
        if self._content.found is None:
            message = "the report page needs the logs of the result"
            raise InputError(message, NO_LOGS)
        write_whole(path, self._content.found.report(FilePath(path).stem).encode(errors="replace"))

    def payload(self, mass: float, to: Sequence[float], *, at: float | None = None, tip: str | None = None) -> pd.DataFrame:
        """Predict the arm with other payloads at the same point.

        The payload is a point mass without rotary inertia.

        Parameters
        ----------
        mass : float
            Payload in the logged runs [kg].
        to : sequence of float
            Payloads to predict [kg].
        at : float, optional
            Distance of the payload from a rotary axis [m].
        tip : str, optional
            Tip at which the payload is fixed; the last one if absent.

        Returns
        -------
        pandas.DataFrame
            A row for each payload and mode: mass_kg, mode, natural_frequency_rad_s, damping_ratio, and their standard
            errors. ``attrs`` has everything that ``lissom payload --json`` writes, with the responses of the tip.

        Raises
        ------
        InputError
            If no arm was identified, or if the result was read from a file.
        """
        if self._content.found is None:
            raise InputError("this result has no logs", NO_LOGS)
        masses = [float(mass), *(float(other) for other in to)]
        if not all(0 <= one < float("inf") for one in masses):
            raise InputError(f"masses are {masses} kg; they must not be negative")
        text = self._content.found.payload(masses[0], masses[1:], at, tip)
        return payloads_frame(json.loads(text))

    @property
    def friction(self) -> Mapping[str, Estimate | None]:
        """Friction: ``coulomb``, ``forward``, ``backward``, ``offset``, ``viscous``; None if refused."""
        return self._estimates("friction")

    @property
    def drive(self) -> Mapping[str, Estimate | None]:
        """The drive: ``inertia`` (the mass of a linear axis)."""
        return self._estimates("drive")

    @property
    def gravity(self) -> Mapping[str, Estimate | None]:
        """Gravity of an unbalanced load; empty unless the campaign asks for it."""
        return self._estimates("gravity")

    @property
    def beam(self) -> Mapping[str, Estimate | None]:
        """The beam except its modes: ``coupling``."""
        return self._estimates("beam")

    @property
    def modes(self) -> tuple[Mapping[str, Estimate | None], ...]:
        """Modes with the motor clamped, ascending: ``natural_frequency_rad_s``, ``damping_ratio``."""
        modes = self._content.root["beam"]["modes"]
        return tuple(MappingProxyType(estimates(mode)) for mode in modes)

    @functools.cached_property
    def findings(self) -> tuple[Finding, ...]:
        """What the logs do not determine, and what to know about the estimates."""
        return tuple(Finding._of(entry) for entry in self._content.root["findings"])

    @property
    def method(self) -> str | None:
        """The method that gave friction, inertia and coupling, all of them together."""
        found: str | None = self._content.root["from"]
        return found

    @functools.cached_property
    def frequency(self) -> NDArray[np.float64]:
        """Frequencies of the responses [rad/s], shape (n,)."""
        omega: NDArray[np.float64] = np.asarray(self._content.root["frequency_response"]["omega_rad_s"], dtype=np.float64)
        return _fixed(omega)

    @functools.cached_property
    def response(self) -> Mapping[str, NDArray[np.complex128]]:
        """Frequency responses, shape (n,), NaN where there is none.

        ``motor_raw`` is motor per command as a linear tool sees it, ``motor_corrected`` without friction; tips by their
        names are tip per motor.
        """
        found = {}
        for name, entry in self._responses():
            re, im = (np.array(entry[part], dtype=np.float64) for part in ("re", "im"))
            found[name] = _fixed(re + 1j * im)
        return MappingProxyType(found)

    @functools.cached_property
    def response_std(self) -> Mapping[str, NDArray[np.float64]]:
        """Standard errors of the responses by the same names, shape (n,)."""
        found = {name: _fixed(np.array(entry["std"], dtype=np.float64)) for name, entry in self._responses()}
        return MappingProxyType(found)

    @functools.cached_property
    def response_vouched_for(self) -> NDArray[np.bool_]:
        """Whether a response at a frequency is corrected with confidence, shape (n,)."""
        vouched: NDArray[np.bool_] = _fixed(np.asarray(self._content.root["frequency_response"]["vouched_for"], dtype=np.bool_))
        return vouched

    @property
    def plot(self) -> ResultPlots:
        """Plots with matplotlib: ``result.plot.bode()``, ``result.plot.friction()``."""
        return ResultPlots(self)

    def covariance(self, keys: Sequence[str] | None = None) -> tuple[list[str], NDArray[np.float64]]:
        """Give the covariance of estimates of the accepted solution.

        Parameters
        ----------
        keys : sequence of str, optional
            Keys of parameters; all that have a covariance if absent.

        Returns
        -------
        keys : list of str
            The keys, in the order of rows and columns.
        matrix : array, shape (n, n)
            Covariance, in the units of the estimates; its diagonal is the square of the standard errors.

        Raises
        ------
        InputError
            If an estimate is refused, or the method has no covariance of it.
        """
        known = (self._content.root["verdict"] or {"correlation": {"keys": [], "matrix": []}})["correlation"]
        places = {
            key: place
            for place, key in enumerate(known["keys"])
            if self[key] is not None and known["matrix"][place][place] is not None
        }
        if isinstance(keys, str):
            raise InputError("keys is a list of keys", f"give it as in [{keys!r}]")
        wanted = list(places) if keys is None else list(keys)
        for key in wanted:
            if self[key] is None:
                raise InputError(f"{key} is refused", "the findings give the reason")
            if key not in places:
                raise InputError(f"there is no covariance of {key}", f"there is one of {', '.join(places)}")
        rows = [places[key] for key in wanted]
        std = np.array([estimate.std for estimate in map(self.__getitem__, wanted) if estimate is not None])
        correlation = np.array([[known["matrix"][i][j] for j in rows] for i in rows], dtype=np.float64)
        return wanted, correlation.reshape(len(rows), len(rows)) * np.outer(std, std)

    @property
    def ok(self) -> bool:
        """Whether nothing that was asked for is refused."""
        return not any(finding.severity == "refusal" for finding in self.findings)

    def warnings(self, key: str) -> tuple[str, ...]:
        """Give the codes of the warnings that affect a parameter.

        Parameters
        ----------
        key : str
            A key of the result.

        Returns
        -------
        tuple of str
            Codes of findings.
        """
        for row in self._content.rows:
            if row[0] == key:
                return tuple(row[4])
        raise KeyError(self._no_key(key))

    def __getitem__(self, key: str) -> Estimate | None:
        if key in self._content.listed:
            return self._content.listed[key]
        value: Any = self._content.root
        if not isinstance(key, str):
            raise KeyError(key)
        for part in key.replace("[", ".").replace("]", "").split("."):
            try:
                value = value[int(part)] if isinstance(value, list) else value[part]
            except (KeyError, IndexError, ValueError, TypeError):
                raise KeyError(self._no_key(key)) from None
        if value is None:
            return None
        if not is_estimate(value):
            raise KeyError(f"{key} is no estimate; to_dict() has everything")
        return Estimate._of(value)

    def __iter__(self) -> Iterator[str]:
        return iter(self._content.listed)

    def __contains__(self, key: object) -> bool:
        return key in self._content.listed

    def __len__(self) -> int:
        return len(self._content.listed)

    def to_dict(self) -> dict[str, Any]:
        """Give the content of result.json.

        Returns
        -------
        dict
            A new one for each call.
        """
        content: dict[str, Any] = json.loads(self._content.data)
        return content

    def to_frame(self) -> pd.DataFrame:
        """Make a table of the parameters with pandas.

        Returns
        -------
        pandas.DataFrame
            A row for each, with its key as index: name, value, std, ci_low, ci_high, unit, refused, warnings.
        """
        return parameters_frame(self._content.rows)

    def to_control(self, output: str = "motor", kind: Literal["ss", "tf", "frd"] = "ss") -> Any:
        """Make a model of python-control: linear, without Coulomb friction, input the command.

        Parameters
        ----------
        output : str
            ``"motor"``, or the name of a tip. As a transfer function, a tip is per motor angle; as a state space all outputs
            are per command.
        kind : {'ss', 'tf', 'frd'}
            State space of the identified arm with all outputs if `output` is ``"motor"``; transfer function; or the
            frequency response data, corrected for friction.

        Returns
        -------
        control.StateSpace, control.TransferFunction or control.FrequencyResponseData
            The model.
        """
        from ._control import to_control

        model: control.StateSpace = to_control(self._content.root["models"], self.frequency, self.response, output, kind)
        return model

    def to_mjcf(self, joint: str | None = None, into: Path | None = None) -> str:
        """Write a model of MuJoCo.

        Parameters
        ----------
        joint : str, optional
            The joint of `into` that gets armature, damping and frictionloss.
        into : path, optional
            An MJCF file; without it, a whole model is written.

        Returns
        -------
        str
            The XML.
        """
        return self._exported("mjcf", into, joint)[0][1].decode()

    def to_urdf(self, joint: str, into: Path) -> str:
        """Write friction and damping into a joint of a URDF.

        Parameters
        ----------
        joint : str
            The joint.
        into : path
            A URDF file.

        Returns
        -------
        str
            The XML.
        """
        return self._exported("urdf", into, joint)[0][1].decode()

    def to_mat(self, path: Path) -> None:
        """Write a MATLAB file with state space, transfer functions and responses.

        Parameters
        ----------
        path : path
            The new file.
        """
        write_whole(path, self._exported("mat")[0][1])

    def to_script(self, language: Literal["python", "m"] = "python") -> str:
        """Write a script that makes the models: for python-control, or for MATLAB and Octave.

        Parameters
        ----------
        language : {'python', 'm'}
            The language.

        Returns
        -------
        str
            The script.
        """
        return self._exported(language)[0][1].decode()

    def to_c(self, folder: Path) -> list[FilePath]:
        """Write C code of the friction feed-forward.

        Parameters
        ----------
        folder : path
            Where the header and the source go; made if it does not exist.

        Returns
        -------
        list of path
            The files.
        """
        made = FilePath(folder)
        try:
            made.mkdir(parents=True, exist_ok=True)
        except (OSError, ValueError) as error:
            raise file_error(os.fspath(folder), error, "give a folder that can be made") from error
        files = self._exported("c")
        for name, data in files:
            write_whole(made / name, data)
        return [made / name for name, _ in files]

    def __repr__(self) -> str:
        return _lissom.result_text(self._text)

    def _repr_html_(self) -> str:
        from ._html import result_html

        return result_html(self.findings, self._content.rows, self._content.found.figures() if self._content.found else [])

    def __eq__(self, other: object) -> bool:
        return self._content.data == other._content.data if isinstance(other, Result) else NotImplemented

    def __hash__(self) -> int:
        return hash(self._content.data)

    def __bytes__(self) -> bytes:
        return self._content.data

    def __reduce__(self) -> tuple[Any, ...]:
        return (Result, (self._content.data,))

    @property
    def _text(self) -> str:
        return self._content.data.decode()

    def _estimates(self, table: str) -> Mapping[str, Estimate | None]:
        return MappingProxyType(estimates(self._content.root[table] or {}))

    def _responses(self) -> list[tuple[str, dict[str, Any]]]:
        table = self._content.root["frequency_response"]
        motor = [(name, table[name]) for name in ("motor_raw", "motor_corrected") if table.get(name)]
        taken = {name for name, _ in motor}
        named = [(f"tip {tip['name']}" if tip["name"] in taken else tip["name"], tip) for tip in table["tips"]]
        return motor + named

    def _validation(self, campaign: Campaign | None) -> Validation:
        """Predict the runs of a campaign, or those of the result."""
        if campaign is not None:
            logs = campaign._read()
        elif self._content.found is not None:
            logs = self._content.found.campaign()
        else:
            raise InputError("this result has no logs", "give the campaign of its logs")
        return Validation._of(_lissom.validate(self._text, logs))

    def _exported(self, target: str, into: Path | None = None, joint: str | None = None) -> list[tuple[str, bytes]]:
        if (into is None) != (joint is None):
            raise InputError("`joint` and `into` are given together, or neither of them")
        return _lissom.export(self._text, target, None if into is None else os.fspath(into), joint)

    def _no_key(self, key: str) -> str:
        return f"{key}; the keys are {', '.join(self._content.listed)}"


_Array = TypeVar("_Array", bound="NDArray[Any]")


def _fixed(array: _Array) -> _Array:
    array.flags.writeable = False
    return array
