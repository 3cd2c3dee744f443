from collections.abc import Callable, Sequence
from typing import TypeAlias, final

import numpy as np
from numpy.typing import NDArray

_Columns: TypeAlias = list[tuple[str, NDArray[np.float64] | list[str]]]
_Row: TypeAlias = tuple[str, str, str, tuple[float, float, list[float]] | None, list[str]]

__version__: str

@final
class Campaign:
    @staticmethod
    def of_text(name: str, text: str, logs: list[tuple[str, _Columns]], only: str | None = None) -> Campaign: ...
    @staticmethod
    def of_file(path: str, only: str | None = None) -> Campaign: ...
    def runs(self) -> list[dict[str, object]]: ...
    def tips(self) -> list[str]: ...

@final
class Found:
    def report(self, title: str) -> str: ...
    def payload(self, mass_kg: float, to_kg: list[float], at_m: float | None = None, tip: str | None = None) -> str: ...
    def figures(self) -> list[tuple[str, str]]: ...

@final
class Pending:
    def wait(self) -> tuple[bytes, Found]: ...

def command(arguments: Sequence[str]) -> int: ...
def compare(results: list[tuple[str, str]]) -> str: ...
def describe(
    logs: list[str],
    said: dict[str, str],
    tips: list[str],
    drive: list[tuple[str, str]],
    gravity: bool,
    header_row: int | None = None,
    skip_rows: int = 0,
) -> tuple[str, list[str]]: ...
def export(result: str, target: str, into: str | None = None, joint: str | None = None) -> list[tuple[str, bytes]]: ...
def identify(
    campaign: Campaign,
    effort: str,
    window_s: float | None = None,
    time_limit_s: float | None = None,
    threads: int | None = None,
    progress: Callable[[str, float], None] | None = None,
) -> tuple[tuple[bytes, Found] | None, tuple[BaseException, Pending] | None]: ...
def inspect(path: str, header_row: int | None = None, skip_rows: int = 0) -> str: ...
def inspect_columns(name: str, columns: _Columns) -> str: ...
def parameters(result: str) -> list[_Row]: ...
def plan(
    precision: dict[str, float],
    runs: str,
    within_s: float | None = None,
    travel_rad: float | None = None,
    bend_rad: float | None = None,
    reserve: float | None = None,
    arm_path: str | None = None,
    arm_text: str | None = None,
) -> tuple[str, str]: ...
def result_text(result: str) -> str: ...
def simulate(
    seed: int,
    arm_path: str | None = None,
    arm_text: str | None = None,
    plan_path: str | None = None,
    plan_text: str | None = None,
) -> list[tuple[str, dict[str, NDArray[np.float64]]]]: ...
def validate(result: str, campaign: Campaign, window_s: float | None = None, horizon_s: float | None = None) -> bytes: ...
