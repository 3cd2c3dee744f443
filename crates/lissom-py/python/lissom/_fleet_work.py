"""What a worker of a fleet does: it makes rows of a batch of logs, on this machine or on another one."""

from __future__ import annotations

import os
import shutil
import tempfile
import threading
import time
from collections.abc import Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _lissom
from ._errors import LissomError
from ._fleet_logs import file_system, is_address
from ._own_command import own_command

#: Logs that are fetched together, while the ones before are identified.
CHUNK = 16
#: Times that a log is fetched, if the connection fails.
FETCHES = 3
#: Wait before it is fetched again [s].
WAIT_S = 1.0

#: A table in memory: its columns by name.
Columns = Mapping[str, NDArray[Any]]
#: A file or folder, or why there is none: a failure of the log, or of the connection.
Fetched = Path | None | OSError | LissomError


class LocalWorkers:
    """The workers that are at work in threads of this process, so that another thread can stop them."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._workers: list[Any] = []
        self._is_stopped = False

    def add(self, worker: Any) -> None:
        """Take a worker that begins.

        Parameters
        ----------
        worker : FleetWorker
            The worker; it is stopped at once if all are.
        """
        with self._lock:
            self._workers.append(worker)
            if self._is_stopped:
                worker.stop()

    def remove(self, worker: Any) -> None:
        """Forget a worker: its process ends with the last reference to it.

        Parameters
        ----------
        worker : FleetWorker
            The worker.
        """
        with self._lock:
            self._workers.remove(worker)

    def stop(self) -> None:
        """Stop all workers, also those that begin later."""
        with self._lock:
            self._is_stopped = True
            for worker in self._workers:
                worker.stop()


def run_batch(
    batch: bytes,
    number: int,
    tables: Mapping[str, Columns],
    options: Mapping[str, Any],
    workers: LocalWorkers | None = None,
) -> bytes:
    """Identify the logs of a batch.

    Parameters
    ----------
    batch : bytes
        The batch, JSON.
    number : int
        Its number.
    tables : mapping of str to mapping
        Those of its logs that are tables in memory.
    options : mapping
        Options of the file system for addresses.
    workers : LocalWorkers, optional
        Has the worker meanwhile. When it is stopped, the rows so far are given.

    Returns
    -------
    bytes
        Its rows, JSON.
    """
    begin = time.perf_counter()
    program, *arguments = own_command()
    worker = _lissom.FleetWorker(batch, program, [*arguments, "fleet", "worker"])
    if workers is not None:
        workers.add(worker)
    rows = []
    try:
        with tempfile.TemporaryDirectory(prefix="lissom-") as folder:
            for place, file in enumerate(_files(worker.logs(), worker.run_files(), Path(folder), tables, options)):
                if isinstance(file, LissomError):
                    # Not the log is the cause, but the connection: it has no row, and is tried again.
                    continue
                if isinstance(file, OSError):
                    rows.append(worker.missing(place, str(file)))
                else:
                    row = worker.row(place, file)
                    if row is None:
                        break
                    rows.append(row)
                shutil.rmtree(Path(folder) / str(place), ignore_errors=True)
    finally:
        if workers is not None:
            workers.remove(worker)
    head = f'{{"number":{number},"seconds":{time.perf_counter() - begin!r},"rows":['
    return head.encode() + b",".join(rows) + b"]}"


def _files(
    logs: list[tuple[str, Path]],
    run_files: list[str] | None,
    folder: Path,
    tables: Mapping[str, Columns],
    options: Mapping[str, Any],
) -> Iterator[Fetched]:
    """Give the file or folder of each log, None if it is where its name says; the next ones are fetched meanwhile."""
    if not tables and not any(is_address(name) for name, _ in logs):
        yield from (None for _ in logs)
        return
    chunks = [range(k, min(k + CHUNK, len(logs))) for k in range(0, len(logs), CHUNK)]
    with ThreadPoolExecutor(CHUNK) as pool:

        def begin(chunk: range) -> list[Any]:
            return [pool.submit(_fetched, logs[k][0], run_files, folder / str(k), tables, options) for k in chunk]

        waiting = begin(chunks[0])
        for index in range(len(chunks)):
            found = [future.result() for future in waiting]
            if index + 1 < len(chunks):
                waiting = begin(chunks[index + 1])
            lost = [file for file in found if isinstance(file, LissomError)]
            if len(lost) == len(found):
                # The way to all of them is lost: the batch is tried again, elsewhere or later.
                raise lost[0]
            yield from found


def _fetched(
    name: str, run_files: list[str] | None, place: Path, tables: Mapping[str, Columns], options: Mapping[str, Any]
) -> Fetched:
    place.mkdir()
    if name in tables:
        file = place / "log.npz"
        np.savez(file, **tables[name])  # type: ignore[arg-type,unused-ignore]
        return file
    if not is_address(name):
        return None
    last: Exception = OSError(name)
    for attempt in range(FETCHES):
        if attempt > 0:
            time.sleep(WAIT_S)
        address = name
        try:
            system, path = file_system(name, options)
            if run_files is None:
                file = place / (os.path.basename(path) or "log")
                system.get_file(path, str(file))
                return file
            for run_file in run_files:
                address, file = f"{name.rstrip('/')}/{run_file}", place / run_file
                file.parent.mkdir(parents=True, exist_ok=True)
                system.get_file(f"{path.rstrip('/')}/{run_file}", str(file))
            return place
        except (FileNotFoundError, IsADirectoryError, PermissionError) as error:
            return OSError(f"{address}: {error.strerror or error}")
        except LissomError:
            raise
        except Exception as error:
            last = error
    return LissomError(f"{name}: {last or type(last).__name__}", "check the network and your rights")
