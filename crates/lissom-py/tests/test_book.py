"""The pages of the book about Python are true."""

from __future__ import annotations

import importlib.util
import re
from pathlib import Path

PACKAGE = Path(__file__).parents[1]
BOOK = PACKAGE.parents[1] / "docs" / "src"


def test_the_programs_of_the_guide_run() -> None:
    text = (BOOK / "how-to" / "python.md").read_text(encoding="utf-8")
    programs = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    assert len(programs) >= 3
    exec(compile("\n".join(programs), "python.md", "exec"), {})


def test_the_reference_is_that_of_the_docstrings() -> None:
    spec = importlib.util.spec_from_file_location("api_page", PACKAGE / "docs" / "api_page.py")
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    written = (BOOK / "reference" / "python.md").read_text(encoding="utf-8")
    assert module.page() == written, "run: python crates/lissom-py/docs/api_page.py docs/src/reference/python.md"
