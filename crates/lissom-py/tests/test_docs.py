"""Everything public has a docstring with its parameters, and the types are complete."""

from __future__ import annotations

import doctest
import importlib
import inspect
import os
import pkgutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import lissom
import pytest
from numpydoc.docscrape import FunctionDoc

SOURCE = Path(__file__).parents[1] / "python"


def documented() -> Iterator[tuple[str, Any]]:
    """Every public class, function and method."""
    for name in lissom.__all__:
        item = getattr(lissom, name)
        if name.startswith("_") or not (inspect.isclass(item) or inspect.isfunction(item)):
            continue
        yield name, item
        if inspect.isclass(item):
            for key, member in vars(item).items():
                inner = getattr(member, "__func__", getattr(member, "func", getattr(member, "fget", member)))
                if not key.startswith("_") and inspect.isfunction(inner):
                    yield f"{name}.{key}", inner


@pytest.mark.parametrize(("name", "item"), list(documented()), ids=lambda value: value if isinstance(value, str) else "")
def test_every_parameter_is_documented(name: str, item: Any) -> None:
    assert item.__doc__, name
    doc = FunctionDoc(item) if inspect.isfunction(item) else FunctionDoc(None, doc=inspect.getdoc(item))
    taken = item.__init__ if inspect.isclass(item) else item
    if inspect.isclass(item) and issubclass(item, float):
        taken = item.__new__
    parameters = inspect.signature(taken).parameters
    described = {part.strip().lstrip("*") for entry in doc["Parameters"] for part in entry.name.split(",")}
    expected = {key for key in parameters if key not in ("self", "cls")}
    if inspect.isclass(item) and issubclass(item, Exception) and taken is lissom.LissomError.__init__:
        expected = set() if item is not lissom.LissomError else expected
    assert described >= expected, f"{name}: {expected - described}"
    assert all(entry.type and entry.desc for entry in doc["Parameters"]), name
    if inspect.isfunction(item) and "." in name:
        of_class = getattr(getattr(lissom, name.split(".")[0]), name.split(".")[1], None)
        if not inspect.isfunction(of_class) and not inspect.ismethod(of_class):
            return
    returns = inspect.signature(item).return_annotation if inspect.isfunction(item) else None
    assert returns in (None, "None") or doc["Returns"], f"{name}: what it returns"


def test_the_examples_of_the_docstrings_are_true() -> None:
    for module in pkgutil.iter_modules(lissom.__path__):
        if module.name not in ("_lissom", "__main__"):
            failed, _ = doctest.testmod(importlib.import_module(f"lissom.{module.name}"))
            assert not failed, module.name


def test_types_are_complete() -> None:
    strict = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", os.devnull, "lissom"]
    checked = subprocess.run(strict, cwd=SOURCE, capture_output=True, text=True, check=False)
    assert checked.returncode == 0, checked.stdout


def test_stubs_are_those_of_the_module(tmp_path: Path) -> None:
    stubs = [sys.executable, "-m", "mypy.stubtest", "lissom._lissom", "--ignore-missing-stub"]
    checked = subprocess.run(stubs, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert checked.returncode == 0, checked.stdout
