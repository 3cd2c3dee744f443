"""Identification of a fleet: batches go to an executor, rows come back."""

from __future__ import annotations

import contextlib
import json
import os
import queue
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from numbers import Real
from pathlib import Path as FilePath
from typing import Any, Literal

import numpy as np

from . import _lissom
from ._campaign import Campaign
from ._errors import FileError, InputError, LissomError
from ._fleet import Fleet
from ._fleet_logs import FleetLogs, is_address
from ._fleet_work import Columns, LocalWorkers, run_batch
from ._progress import Progress, progress_of
from ._tables import Path, columns, path_text

#: Time between two looks at Ctrl-C, progress and a closed executor [s].
TICK_S = 0.1
#: Batches that wait in an executor, for each worker.
AHEAD = 2
#: Most processes of this machine at a time.
MOST_WORKERS = 1024
#: Why a log has no result.
FAILURES = ("missing", "input", "time_limit", "process_ended", "internal")
#: Batches that may be lost in a row.
LOST_MOST = 20


def fleet(
    logs: Any,
    like: Campaign | Path,
    *,
    out: Path,
    pattern: str | None = None,
    by_folder: bool = False,
    executor: Any = None,
    workers: int | None = None,
    effort: Literal["quick", "normal", "thorough"] = "quick",
    refine: Literal["normal", "thorough"] | None = "normal",
    refine_on: Sequence[str] = (),
    time_limit: float = 60.0,
    retries: int = 2,
    keep_results: bool = False,
    resume: bool = True,
    again: Sequence[Literal["missing", "input", "time_limit", "process_ended", "internal"]] = (),
    on_error: Literal["record", "raise"] = "record",
    storage_options: Mapping[str, Any] | None = None,
    progress: Progress | bool | None = None,
) -> Fleet:
    """Identify the logs of many machines, each by itself, and write a row for each log.

    Each log is identified in a process that it may bring to its end: that is a row like any other. Rows are in Parquet files,
    which a manifest lists. A run that was stopped, by Ctrl-C, a full disk or a lost machine, goes on if it is called again.

    Parameters
    ----------
    logs : path, list, mapping or table
        Folders, files, patterns as ``"logs/*/*.csv"``, addresses of fsspec as ``"s3://bucket/logs"``; a list of them; a mapping
        of names to tables in memory; or a table (pandas, polars, columns by name) with the columns ``log`` and, if known,
        ``machine`` and ``time``.
    like : Campaign or path
        What describes every log: a campaign, or a campaign.toml. Its runs are read only with `by_folder`, for which it is a
        campaign.toml.
    out : path
        Folder for the rows.
    pattern : str, optional
        Machine and time from the end of the path, as ``"{machine}/{time}.csv"``.
    by_folder : bool
        Whether each folder with the files of the campaign's runs is one log, with one row. `logs` are then folders, and the
        campaign names the files relative to their folder.
    executor : object, optional
        Where batches are identified: anything with a method ``submit``, as a ``distributed.Client`` or an executor of
        `concurrent.futures`. Processes of this machine if absent.
    workers : int, optional
        Number of processes of this machine at a time, without an executor; all cores if absent.
    effort : {'quick', 'normal', 'thorough'}
        Effort for every log.
    refine : {'normal', 'thorough'}, optional
        Effort for logs whose findings ask for it; None for no log.
    refine_on : sequence of str
        Codes of findings that ask for it; every refusal, and ``angle-lag``, if empty.
    time_limit : float
        Time for one log [s]. A search ends with its best result after 80 % of it; a process that needs longer is ended.
    retries : int
        How often a log is tried again whose process ended, and a batch whose worker was lost.
    keep_results : bool
        Whether rows have the whole result of each log, see `Fleet.result`.
    resume : bool
        Whether a run into a folder with rows goes on; an error if not.
    again : sequence of {'missing', 'input', 'time_limit', 'process_ended', 'internal'}
        Failures of former rows whose logs are done again.
    on_error : {'record', 'raise'}
        Whether a log without a result is a row, or ends the run with an exception after its batch.
    storage_options : mapping, optional
        Options of the file system for addresses: they are sent to the workers.
    progress : bool or callable, optional
        Whether a bar shows the progress; in notebooks it does if absent, in calls of more than half a second. Or a function
        that is called about ten times a second with a text and the share of the work that is done.

    Returns
    -------
    Fleet
        The rows.

    Raises
    ------
    InputError
        If there are no logs, or an argument is not valid.
    FileError
        If logs cannot be listed, or the folder cannot be written.
    LissomError
        If workers have another version, or are lost again and again.
    """
    target, options = path_text(out), dict(storage_options or {})
    if is_address(target):
        raise InputError(f"{target} is no folder of this machine", "write the rows here, and copy the folder afterwards")
    settings = _settings(like, by_folder, effort, refine, refine_on, time_limit, retries, keep_results)
    if on_error not in ("record", "raise"):
        raise InputError(f"on_error is {on_error!r}, and not 'record' or 'raise'")
    if isinstance(again, str) or not set(again) <= set(FAILURES):
        raise InputError(f"again is {again!r}", f"give a list of these: {', '.join(FAILURES)}")
    if workers is not None and not (isinstance(workers, int) and 1 <= workers <= MOST_WORKERS):
        raise InputError(f"workers is {workers!r}; it must be from 1 to {MOST_WORKERS}")
    described = [] if isinstance(like, Campaign) else [path_text(like)]
    found = FleetLogs.of(logs, pattern, [*described, target], options, _lissom.fleet_run_files(json.dumps(settings)))
    tables = {name: _columns(name, log) for name, log in found.tables.items()}
    run = _lissom.FleetRun(target, json.dumps(settings), json.dumps(found.entries), bool(resume), list(again))
    engine = _Local(workers) if executor is None else _Executor(executor)
    work = _Work(run, engine, tables, options, retries, on_error)
    try:
        with progress_of(progress) as show:
            work.go(show)
    finally:
        engine.close()
        try:
            work.take_rest()
        finally:
            run.end()
    return Fleet(target)


def _settings(
    like: Campaign | Path,
    by_folder: bool,
    effort: str,
    refine: str | None,
    refine_on: Sequence[str],
    time_limit: float,
    retries: int,
    keep_results: bool,
) -> dict[str, Any]:
    efforts = ("quick", "normal", "thorough")
    if effort not in efforts or refine not in (None, *efforts[1:]):
        raise InputError(f"effort is {effort!r} and refine {refine!r}", f"efforts are {', '.join(efforts)}")
    if isinstance(refine_on, str):
        raise InputError("refine_on is a list of codes", f"give it as in refine_on=[{refine_on!r}]")
    if not isinstance(time_limit, Real) or not 0 < time_limit < float("inf"):
        raise InputError(f"time_limit is {time_limit!r}; it must be positive", "give seconds: time_limit=60")
    if not isinstance(retries, int) or not 0 <= retries < 1000:
        raise InputError(f"retries is {retries!r}; it must be a number from 0 to 999, not negative")
    if isinstance(like, Campaign):
        name, text = like._fleet_text()
    else:
        path = FilePath(path_text(like))
        try:
            name, text = str(path.resolve()), path.read_text(encoding="utf-8-sig")
        except (OSError, UnicodeDecodeError) as error:
            raise FileError(f"{path}: {error}", "give a campaign.toml") from error
    return {
        "version": _lissom.__version__,
        "campaign_name": name,
        "campaign": text,
        "by_folder": bool(by_folder),
        "effort": effort,
        "refinement": None if refine is None else {"effort": refine, "codes": [str(code) for code in refine_on]},
        "time_limit_s": float(time_limit),
        "retries": int(retries),
        "keep_results": bool(keep_results),
    }


def _columns(name: str, log: Any) -> Columns:
    """Give a table in memory as arrays, which can be sent to a worker."""
    return {column: np.asarray(values) for column, values in columns(log, name)}


class _Local:
    """Threads of this process, each with a worker process."""

    def __init__(self, workers: int | None) -> None:
        cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
        self.workers = cores if workers is None else workers
        self._pool = ThreadPoolExecutor(self.workers)
        self._workers_now = LocalWorkers()

    def submit(self, batch: bytes, number: int, tables: Mapping[str, Columns], options: Mapping[str, Any]) -> Any:
        return self._pool.submit(run_batch, batch, number, tables, options, self._workers_now)

    def closed(self) -> bool:
        return False

    def close(self) -> None:
        self._pool.shutdown(wait=False, cancel_futures=True)
        self._workers_now.stop()
        self._pool.shutdown(wait=True)


class _Executor:
    """An executor of the user, which stays open."""

    def __init__(self, executor: Any) -> None:
        if not callable(getattr(executor, "submit", None)):
            raise InputError(
                f"a {type(executor).__name__} is no executor: it has no method submit", "give a distributed.Client"
            )
        self._executor = executor
        self._is_dask = hasattr(executor, "scheduler_info")
        self._waiting: set[Any] = set()

    @property
    def workers(self) -> int:
        if self._is_dask:
            if self.closed():
                raise LissomError("the client is closed", "open a new one")
            return max(int(sum(self._executor.nthreads().values())), 1)
        return max(int(getattr(self._executor, "_max_workers", 0) or os.cpu_count() or 1), 1)

    def submit(self, batch: bytes, number: int, tables: Mapping[str, Columns], options: Mapping[str, Any]) -> Any:
        # Dask would give the former result of a batch that is tried again.
        special = {"pure": False} if self._is_dask else {}
        try:
            future = self._executor.submit(run_batch, batch, number, tables, options, **special)
        except Exception as error:
            raise LissomError(f"the executor takes no work: {error or type(error).__name__}", "open a new one") from error
        self._waiting.add(future)
        future.add_done_callback(self._waiting.discard)
        return future

    def closed(self) -> bool:
        return self._is_dask and getattr(self._executor, "status", "running") in ("closed", "closing")

    def close(self) -> None:
        for future in list(self._waiting):
            future.cancel()


class _Work:
    """Sends batches and takes rows until no log waits."""

    def __init__(
        self,
        run: Any,
        engine: _Local | _Executor,
        tables: Mapping[str, Columns],
        options: Mapping[str, Any],
        retries: int,
        on_error: str,
    ) -> None:
        self._run = run
        self._engine = engine
        self._tables = tables
        self._options = options
        self._retries = retries
        self._on_error = on_error
        self._done: queue.SimpleQueue[tuple[int, Any]] = queue.SimpleQueue()
        #: Names of the logs of each batch that is being worked on.
        self._given: dict[int, list[str]] = {}
        #: How often the batch of a log was lost.
        self._lost: dict[str, int] = {}
        self._left = 0
        #: How many batches were lost since the last rows.
        self._in_a_row = 0
        self._cause: BaseException | None = None

    def go(self, progress: Progress | None) -> None:
        """Work until no log waits.

        Parameters
        ----------
        progress : callable, optional
            Is called with a text and the share of the work that is done.
        """
        while True:
            self._send()
            if not self._given:
                break
            try:
                number, future = self._done.get(timeout=TICK_S)
            except queue.Empty:
                if self._engine.closed():
                    raise LissomError("the client was closed", "run the fleet again: it goes on") from None
            else:
                self._take(number, future)
            self._run.show_rows()
            if progress is not None:
                self._show(progress)
        if self._left:
            message = f"{self._left} logs have no row: their workers were lost ({self._cause})"
            raise LissomError(message, "run the fleet again: it goes on with these logs") from self._cause

    def _send(self) -> None:
        workers = self._engine.workers
        while len(self._given) < AHEAD * workers:
            given = self._run.next_batch(workers)
            if given is None:
                return
            number, names, batch = given
            self._given[number] = names
            tables = {name: self._tables[name] for name in names if name in self._tables}
            future = self._engine.submit(batch, number, tables, self._options)
            future.add_done_callback(lambda future, number=number: self._done.put((number, future)))

    def _take(self, number: int, future: Any) -> None:
        names = self._given.pop(number)
        try:
            rows = future.result()
        except ImportError as error:
            raise LissomError(f"a worker cannot import lissom: {error}", "install the same version there") from error
        except (InputError, KeyboardInterrupt):
            raise
        except BaseException as error:
            if self._engine.closed():
                raise LissomError("the client was closed", "run the fleet again: it goes on") from error
            self._again(number, names, error)
        else:
            done, failed = self._run.take(rows)
            self._in_a_row = 0
            if len(done) < len(names):
                missing = [name for name in names if name not in set(done)]
                self._again(number, missing, LissomError("they could not be fetched"))
            if failed is not None and self._on_error == "raise":
                log, message = failed
                raise LissomError(f"{log}: {message}", "leave out the log, or record failures: on_error='record'")

    def _again(self, number: int, names: list[str], cause: BaseException) -> None:
        """Give the logs of a lost batch back, unless that was done too often."""
        for name in names:
            self._lost[name] = self._lost.get(name, 0) + 1
        self._cause = cause
        self._in_a_row += 1
        if self._in_a_row > LOST_MOST:
            message = f"{self._in_a_row} batches in a row were lost ({cause})"
            raise LissomError(message, "run the fleet again when workers and logs can be reached: it goes on") from cause
        if max(self._lost[name] for name in names) > self._retries:
            self._left += len(names)
        else:
            self._run.give_back(number)

    def take_rest(self) -> None:
        """Take the rows of batches that have ended, or were stopped, since."""
        with contextlib.suppress(queue.Empty):
            while True:
                number, future = self._done.get_nowait()
                if number in self._given and not future.cancelled() and future.exception() is None:
                    self._run.take(future.result())

    def _show(self, progress: Progress) -> None:
        at = self._run.progress()
        rows = at["before"] + at["done"]
        text = f"{rows} of {at['logs']} logs"
        if at["failed"]:
            text += f", {at['failed']} failed"
        if at["left_s"] is not None:
            text += f", about {at['left_s']:.0f} s left"
        progress(text, rows / at["logs"])
