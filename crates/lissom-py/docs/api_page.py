"""Writes the page of the Python package in the book from its docstrings: ``python api_page.py PAGE``."""

from __future__ import annotations

import inspect
import re
import sys
from pathlib import Path
from typing import Any

import lissom
from numpydoc.docscrape import FunctionDoc, NumpyDocString

HEAD = """# Python

<!-- Made from the docstrings by `python crates/lissom-py/docs/api_page.py`; a test compares it with them. -->

`import lissom`. Numbers are in SI units and rad/s. A *Log* is a path, a table of pandas, polars or pyarrow, or a mapping of
column names to arrays. [The guide](../how-to/python.md) shows how to use it.
"""


def code(text: str) -> str:
    """Turns the double backticks of docstrings into those of Markdown."""
    return re.sub(r"``([^`]+)``", r"`\1`", text).replace("{array}", "array")


def rows(entries: list[Any]) -> list[str]:
    """A list of parameters or attributes."""
    made = []
    for entry in entries:
        name = f"`{entry.name}` ({code(entry.type)})" if entry.name else code(entry.type)
        made.append(f"- {name}: {code(' '.join(entry.desc)).strip()}")
    return made


def sections(doc: NumpyDocString) -> list[str]:
    """What a docstring says, as Markdown."""
    lines = [code(" ".join(doc["Summary"])), ""]
    if doc["Extended Summary"]:
        lines += [code("\n".join(doc["Extended Summary"])), ""]
    if doc["Parameters"]:
        lines += [*rows(doc["Parameters"]), ""]
    for title in ("Returns", "Raises"):
        if doc[title]:
            lines += [f"{title}:", "", *rows(doc[title]), ""]
    if doc["Examples"]:
        lines += ["```python", *doc["Examples"], "```", ""]
    return lines


def signature(item: Any, name: str) -> str:
    """A call, with defaults and without types."""
    parameters = []
    found = inspect.signature(item)
    star = False
    for parameter in found.parameters.values():
        if parameter.name in ("self", "cls"):
            continue
        if parameter.kind is parameter.KEYWORD_ONLY and not star:
            parameters.append("*")
            star = True
        prefix = "**" if parameter.kind is parameter.VAR_KEYWORD else ""
        default = "" if parameter.default is parameter.empty else f"={parameter.default!r}"
        parameters.append(f"{prefix}{parameter.name}{default}")
    return f"{name}({', '.join(parameters)})"


def of_class(name: str, item: type) -> list[str]:
    """A class with its members."""
    doc = FunctionDoc(None, doc=inspect.getdoc(item))
    lines = [f"## `{name}`", "", *sections(doc)]
    for key, member in vars(item).items():
        if key.startswith("_"):
            continue
        getter = getattr(member, "fget", getattr(member, "func", None))
        function = getattr(member, "__func__", member)
        if getter is not None and inspect.getdoc(getter):
            lines += [f"- `.{key}`: {code(' '.join(inspect.getdoc(getter).split()))}"]
        elif inspect.isfunction(function):
            inner = FunctionDoc(function)
            lines += ["", f"**`.{signature(function, key)}`**", "", *sections(inner)]
    return [*lines, ""]


def page() -> str:
    """The page."""
    lines = [HEAD]
    items = {name: getattr(lissom, name) for name in lissom.__all__}
    for name, item in items.items():
        if inspect.isfunction(item):
            lines += [f"## `{signature(item, name)}`", "", *sections(FunctionDoc(item))]
    for name, item in items.items():
        if inspect.isclass(item):
            lines += of_class(name, item)
    text = re.sub(r"\n{3,}", "\n\n", "\n".join(lines))
    return text.rstrip() + "\n"


if __name__ == "__main__":
    Path(sys.argv[1]).write_text(page(), encoding="utf-8")
