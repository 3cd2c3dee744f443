"""Results in notebooks."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ._finding import Finding
    from ._lissom import _Row as Row

_CELL = "text-align:left"
#: The figures that are shown.
_SHOWN = ("bode-motor", "friction-curve")


def result_html(findings: Sequence[Finding], rows: list[Row], figures: list[tuple[str, str]]) -> str:
    """Write the table, the findings and two figures of a result as HTML, without a script.

    Parameters
    ----------
    findings : sequence of Finding
        Its findings.
    rows : list
        Its parameters.
    figures : list
        Its figures: names and SVG.

    Returns
    -------
    str
        HTML.
    """
    lines = ["<table><thead><tr>"]
    lines += [f'<th style="{_CELL}">{head}</th>' for head in ("parameter", "value", "± 1.96 σ", "unit", "warnings")]
    lines.append("</tr></thead><tbody>")
    for _, name, unit, found, warnings in rows:
        value, margin = ("refused", "") if found is None else (f"{found[0]:.6g}", f"{1.96 * found[1]:.2g}")
        cells = (name, value, margin, unit, ", ".join(warnings))
        lines.append("<tr>" + "".join(f'<td style="{_CELL}">{escape(cell)}</td>' for cell in cells) + "</tr>")
    lines.append("</tbody></table>")
    matter = [finding for finding in findings if finding.severity != "info"]
    if matter:
        lines.append("<ul>")
        for finding in matter:
            run = f"{escape(finding.run)}: " if finding.run else ""
            hint = f"<br><i>{escape(finding.hint)}</i>" if finding.hint else ""
            lines.append(f"<li><b>{finding.severity}</b> [{escape(finding.code)}] {run}{escape(finding.message)}{hint}</li>")
        lines.append("</ul>")
    lines += [f"<div>{svg}</div>" for name, svg in figures if name in _SHOWN]
    return "".join(lines)
