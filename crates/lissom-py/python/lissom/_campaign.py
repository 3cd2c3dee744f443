"""Campaigns: the logs of a drive, their columns, and what is known about the drive."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path as FilePath
from typing import TYPE_CHECKING, Any, Literal, cast

from . import _lissom
from ._campaign_text import campaign_text, columns_of, has_own_logs, memory_name, with_paths, with_runs
from ._drive import DRIVE, drive_table, with_unit
from ._errors import InputError, file_error
from ._lissom import Campaign as Native
from ._named_logs import named
from ._process import use
from ._run import Run
from ._signal import Signal, time_table
from ._tables import Log, Path, columns, is_path, is_time, path_text, several
from ._words import of_arguments

if TYPE_CHECKING:
    from ._lissom import _Columns as Columns

#: Values of tables in memory that are read within a few milliseconds.
SHORT = 100_000
_INPUTS = ("current", "voltage", "torque", "command")


class Campaign:
    """Logs of one drive, with the meaning of their columns.

    The logs are read when they are needed, and again only if the campaign is made anew.

    Parameters
    ----------
    runs : Log or sequence of Log
        The logs: paths, tables of pandas, polars or pyarrow, or mappings of column names to arrays; one, or a list. A mapping
        of names to such logs names the runs.
    time : Signal, str or float
        The time stamps, as ``"t:ms"``; or the sample time of logs without stamps, as ``"2 ms"`` or in seconds.
    motor : Signal or str
        Angle, position or speed of the motor.
    current, voltage, torque, command : Signal or str, optional
        The input of the drive: one of these. ``command`` is of unknown unit (``"u:1"``), or a position goal.
    tips : sequence of Signal or str
        Points of the arm.
    speed : Signal or str, optional
        Speed of the motor, which is compared with its angle.
    run : str or int, optional
        Column with the number or name of the run, if a log has several.
    gravity : bool
        Whether gravity of an unbalanced load acts on the motor: its torque is identified.
    mgl : str or float, optional
        Known torque m·g·l of that load, as ``"2.1 N*m"``, or in N·m.
    skip : str or float, optional
        Beginning of each run to leave out, as ``"1 s"``, or in seconds.
    window : str or float, optional
        Length of the window of the regression; chosen from the data if absent.
    hold : {'measured', 'sampled', 'unknown'}, optional
        How the input acts between samples; overrides that of its signal.
    decimal : {'.', ','}, optional
        Decimal sign of logs that are texts; a point if absent.
    header_row : int, optional
        Row of a text with the names, from 1; found if absent.
    skip_rows : int
        Rows at the top of a text that do not count.
    **drive : str or float
        Constants of the drive: ``torque_constant`` ("0.1 N*m/A", or in N·m per unit of the input, on a linear axis in N),
        ``current_limit``, ``voltage_limit``, ``gear_ratio``, ``gear_efficiency``, ``resistance``, ``back_emf``,
        ``position_gain``, ``arm`` (path of an arm.toml to compare with). Numbers are in SI units.

    Examples
    --------
    >>> import numpy as np
    >>> t = np.arange(2000) * 1e-3
    >>> run = {"t": t, "i": np.sin(9 * t), "q": np.sin(5 * t)}
    >>> campaign = Campaign(run, time="t:s", motor="q:rad", current="i:A")
    >>> campaign.runs[0].motor.shape
    (2000,)
    """

    def __init__(
        self,
        runs: Log | Sequence[Log] | Mapping[str, Log],
        *,
        time: Signal | str | float,
        motor: Signal | str,
        current: Signal | str | None = None,
        voltage: Signal | str | None = None,
        torque: Signal | str | None = None,
        command: Signal | str | None = None,
        tips: Sequence[Signal | str] = (),
        speed: Signal | str | None = None,
        run: str | int | None = None,
        gravity: bool = False,
        mgl: str | float | None = None,
        skip: str | float | None = None,
        window: str | float | None = None,
        hold: str | None = None,
        decimal: Literal[".", ","] | None = None,
        header_row: int | None = None,
        skip_rows: int = 0,
        **drive: str | float,
    ) -> None:
        inputs = {"current": current, "voltage": voltage, "torque": torque, "command": command}
        given = {key: Signal.of(value) for key, value in inputs.items() if value is not None}
        if len(given) != 1:
            found = " and ".join(given) if given else "none"
            raise InputError(
                f"a campaign has one input of the drive, {', '.join(_INPUTS)}; given: {found}",
                'give one, as in current="i:A"',
            )
        ((role, source),) = given.items()
        signals: dict[str, object] = time_table(time)
        entry = source._table("command")
        if hold is not None:
            entry["hold"] = hold
        signals["command" if role == "torque" else role] = entry
        axis = Signal.of(motor)
        signals["motor"] = axis._table("motor")
        if speed is not None:
            signals["speed"] = Signal.of(speed)._table("speed")
        if isinstance(tips, (str, Signal)):
            raise InputError("tips is a list of signals", 'give it as in tips=["alpha:rad"]')
        if len(tips) > 0:
            signals["tips"] = [_tip(Signal.of(tip)) for tip in tips]
        if run is not None:
            signals["run"] = run
        text = {"decimal": decimal, "header_row": header_row, "skip_rows": skip_rows or None}
        signals |= {key: value for key, value in text.items() if value is not None}
        tables: dict[str, Mapping[str, object]] = {"signals": signals}
        unknown = [key for key in drive if key not in DRIVE]
        if unknown:
            raise TypeError(f"Campaign has no argument {unknown[0]!r}; constants of the drive are {', '.join(DRIVE)}")
        if drive:
            tables["drive"] = drive_table(drive, role, _lissom.is_linear(axis.unit))
        if mgl is not None:
            tables["load"] = {"gravity": True, "mgl": with_unit(mgl, "N*m")}
        elif bool(gravity):
            tables["load"] = {"gravity": True}
        analysis = {"skip": skip, "window": window}
        if any(value is not None for value in analysis.values()):
            tables["analysis"] = {k: with_unit(v, "s") for k, v in analysis.items() if v is not None}
        self._tables = tables
        self._logs = named(runs)
        if any(not is_path(log) for _, log in self._logs):
            # Arrays may change later: they are copied now.
            self._read()

    #: Tables of a campaign.toml and its runs; empty if `_path` or `_described` has them.
    _tables: Mapping[str, Mapping[str, object]] = {}
    _logs: Sequence[tuple[str, Log]] = ()
    #: The campaign.toml that was read.
    _path: FilePath | None = None
    #: The text of a campaign.toml that `of_logs` made.
    _described: str | None = None
    _notes: tuple[str, ...] = ()
    #: Logs that are read in place of the runs of `_path`.
    _only: Sequence[tuple[str, Log]] = ()
    #: What was read.
    _native: Native | None = None

    @classmethod
    def _empty(cls) -> Campaign:
        """Make a campaign without a description."""
        return cls.__new__(cls)

    @property
    def notes(self) -> tuple[str, ...]:
        """What `of_logs` took from the logs, and why."""
        return self._notes

    @classmethod
    def load(cls, path: Path) -> Campaign:
        """Read a campaign.toml and its logs.

        Parameters
        ----------
        path : path
            The campaign.toml.

        Returns
        -------
        Campaign
            The campaign.

        Raises
        ------
        FileError
            If a file cannot be read.
        InputError
            If a description or a log cannot be used.
        """
        made = cls._empty()
        made._path = FilePath(path_text(path))
        made._read()
        return made

    @classmethod
    def of_logs(
        cls,
        logs: Path | Sequence[Path],
        *,
        time: str | None = None,
        sample_time: str | float | None = None,
        motor: str | None = None,
        current: str | None = None,
        voltage: str | None = None,
        command: str | None = None,
        goal: str | None = None,
        speed: str | None = None,
        tips: Sequence[str] = (),
        run: str | None = None,
        hold: str | None = None,
        gravity: bool = False,
        mgl: str | float | None = None,
        skip: str | float | None = None,
        window: str | float | None = None,
        torque_constant: str | float | None = None,
        current_limit: str | float | None = None,
        voltage_limit: str | float | None = None,
        resistance: str | float | None = None,
        back_emf: str | float | None = None,
        gear_ratio: float | None = None,
        header_row: int | None = None,
        skip_rows: int = 0,
    ) -> Campaign:
        """Make a campaign of files, with what they show: roles, units, decimal sign, whether the command is held.

        It does what ``lissom identify LOG`` does. A role is guessed only where it is unambiguous, a unit never. `notes` has
        what was taken from the logs.

        Parameters
        ----------
        logs : path or sequence of path
            The logs.
        time, motor, current, voltage, command, goal, speed : str, optional
            A channel by its name or number, with its unit if the log does not state it, as ``"q:deg"``. ``command`` is a
            torque (``"tau:N*m"``) or of unknown unit (``"u:1"``), ``goal`` the position reference of a servo.
        sample_time : str or float, optional
            Sample time of logs without stamps, as ``"1 ms"``, or in seconds.
        tips : sequence of str
            Points of the arm.
        run : str, optional
            Column with the number or name of the run.
        hold : {'measured', 'sampled', 'unknown'}, optional
            How the input acts between samples; found from the motion if absent.
        gravity : bool
            Whether gravity of an unbalanced load acts.
        mgl : str or float, optional
            Known torque m·g·l of that load, or in N·m.
        skip : str or float, optional
            Beginning of each run to leave out, or in seconds.
        window : str or float, optional
            Length of the window of the regression, or in seconds; chosen from the data if absent.
        torque_constant, current_limit, voltage_limit, resistance, back_emf : str or float, optional
            Constants of the drive, as ``"0.1 N*m/A"``, or in SI units.
        gear_ratio : float, optional
            Turns of the motor for one turn of the joint.
        header_row : int, optional
            Row of a text with the names, from 1; found if absent.
        skip_rows : int
            Rows at the top of a text that do not count.

        Returns
        -------
        Campaign
            The campaign.

        Raises
        ------
        InputError
            If something is missing that the logs do not show.
        """
        use()
        given = several(cast("Log", logs))
        if not all(is_path(log) for log in given):
            raise InputError("of_logs takes files", "describe a table in memory with Campaign(table, time=..., ...)")
        files = [path_text(log) for log in given]
        texts = {
            "time": time,
            "sample_time": None if sample_time is None else with_unit(sample_time, "s"),
            "motor": motor,
            "current": current,
            "voltage": voltage,
            "command": command,
            "goal": goal,
            "speed": speed,
            "run": run,
            "hold": hold,
            "mgl": None if mgl is None else with_unit(mgl, "N*m"),
            "skip": None if skip is None else with_unit(skip, "s"),
            "window": None if window is None else with_unit(window, "s"),
        }
        said = {key: text for key, text in texts.items() if text is not None}
        role = "voltage" if voltage is not None else "current"
        constants = {
            "torque_constant": torque_constant,
            "current_limit": current_limit,
            "voltage_limit": voltage_limit,
            "resistance": resistance,
            "back_emf": back_emf,
            "gear_ratio": gear_ratio,
        }
        linear = motor is not None and _lissom.is_linear(motor.rpartition(":")[2])
        known = {key: value for key, value in constants.items() if value is not None}
        drive = [(key, str(value)) for key, value in drive_table(known, role, linear).items()]
        text, notes = _lissom.describe(files, said, list(tips), drive, gravity, header_row, skip_rows)
        made = cls._empty()
        made._logs, made._described, made._notes = [(file, file) for file in files], text, tuple(notes)
        return made

    def save(self, path: Path) -> None:
        """Write a campaign.toml, with which the command and `load` read the same campaign.

        Parameters
        ----------
        path : path
            The new file. It is not overwritten.

        Raises
        ------
        InputError
            If a run is a table in memory, or the campaign was read from a file.
        FileError
            If the file exists or cannot be written.
        """
        target = FilePath(path)
        if self._path is not None:
            raise InputError(f"the campaign was read from {self._path}", "copy that file")
        in_memory = [name for name, log in self._logs if not is_path(log)]
        if in_memory:
            raise InputError(
                f"the run {in_memory[0]!r} is a table in memory, which a campaign.toml cannot name",
                "write the table as CSV or Parquet first, and give its path",
            )
        folder = target.parent.resolve()

        def moved(file: str) -> str:
            return os.path.relpath(FilePath(file).resolve(), folder)

        if self._described is not None:
            text = with_paths(self._described, moved)
        else:
            text = campaign_text(self._tables, self._logs, moved)
        try:
            with open(target, "x", encoding="utf-8") as file:
                file.write(text)
        except OSError as error:
            raise file_error(target, error, "give another path") from error

    @property
    def runs(self) -> tuple[Run, ...]:
        """The runs as they are identified: evenly sampled, in SI units, with names."""
        return tuple(Run._of(entry) for entry in self._read().runs())

    @property
    def tips(self) -> tuple[str, ...]:
        """Names of the points of the arm."""
        return tuple(self._read().tips())

    def like(self, runs: Log | Sequence[Log] | Mapping[str, Log]) -> Campaign:
        """Make a campaign of other logs with the same columns, units and drive.

        Parameters
        ----------
        runs : Log or sequence of Log
            The other logs; a mapping of names to logs names those that are tables in memory, and others if the campaign was
            not read from a file.

        Returns
        -------
        Campaign
            The campaign of these logs.
        """
        made = Campaign._empty()
        made._tables, made._path = self._tables, self._path
        logs = named(runs)
        if self._path is not None:
            made._only = logs
        else:
            made._logs = logs
        if self._described is not None:
            made._described = with_runs(self._described, logs)
        if made._path is not None or any(not is_path(log) for _, log in logs):
            made._read()
        return made

    def _fleet_text(self) -> tuple[str, str]:
        """Give the text that describes every log of a fleet, and what errors call it."""
        if self._path is not None:
            try:
                return str(self._path.resolve()), self._path.read_text(encoding="utf-8-sig")
            except OSError as error:
                raise file_error(self._path, error, "check the name") from error
        if self._described is not None:
            return "campaign", self._described
        return "campaign", campaign_text(self._tables, [], lambda file: str(FilePath(file).resolve()))

    def __repr__(self) -> str:
        if self._path is not None:
            return f"Campaign.load({os.fspath(self._path)!r})"
        names = ", ".join(name for name, _ in self._logs[:3])
        more = ", ..." if len(self._logs) > 3 else ""
        return f"<Campaign of {len(self._logs)} logs: {names}{more}>"

    def __getstate__(self) -> dict[str, Any]:
        # What was read is read again where it arrives.
        return {key: value for key, value in self.__dict__.items() if key != "_native"}

    def _read(self) -> Native:
        use()
        if self._native is not None:
            return self._native
        if self._path is not None:
            tables = [(name, columns(log, name)) for name, log in self._only if not is_path(log)]
            only = [path_text(log) if is_path(log) else name for name, log in self._only]
            self._native = Native.of_file(os.fspath(self._path), tables, only)
            return self._native
        text = campaign_text(self._tables, self._logs) if self._described is None else self._described
        tables = self._in_memory()
        values = sum(len(column) for _, log in tables for _, column in log)
        short = len(tables) == len(self._logs) and values < SHORT and not has_own_logs(self._tables)
        try:
            self._native = Native.of_text("campaign", text, tables, short)
        except InputError as error:
            raise of_arguments(error) from None
        return self._native

    def _in_memory(self) -> list[tuple[str, Columns]]:
        """Give the tables in memory, with the names of their runs in the text."""
        wanted = columns_of(self._tables["signals"]) if self._tables else ()
        tables = []
        for place, (name, log) in enumerate(self._logs):
            if not is_path(log):
                self._times_are_seconds(name, log)
                tables.append((memory_name(place), columns(log, name, wanted)))
        return tables

    def _times_are_seconds(self, name: str, log: Log) -> None:
        """Refuse another unit of dates and durations, which are converted to seconds."""
        signals = cast("dict[str, Any]", self._tables.get("signals", {}))
        time = signals.get("time")
        if time is not None and time["unit"] != "s" and is_time(log, time["column"]):
            raise InputError(
                f'{name}: column "{time["column"]}" has dates or durations, which are converted to seconds',
                f'give its unit as "s" in place of "{time["unit"]}"',
            )


#: Names of the motor's channels in results.
_OF_MOTOR = ("motor", "motor_raw", "motor_corrected")


def _tip(signal: Signal) -> dict[str, object]:
    table = signal._table("tip")
    if table["name"] in _OF_MOTOR:
        raise InputError(f"a tip cannot be called {table['name']!r}", 'give it another name: Signal(..., name="tip")')
    return table
