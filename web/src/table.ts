// The values of a figure as a table, for those who cannot see it.

import type { FigureData } from "./figure_data";
import { type Units, digits, shownAxis, shownTrace } from "./units";

/** Most rows for each series; CSV has all. */
const ROWS_MOST = 50;

function row(cells: readonly string[], tag: "th" | "td"): HTMLTableRowElement {
  const made = document.createElement("tr");
  cells.forEach((text, k) => {
    const cell = document.createElement(tag);
    cell.textContent = text;
    if (tag === "th") cell.setAttribute("scope", "col");
    if (k > 0) cell.className = "n";
    made.append(cell);
  });
  return made;
}

export function tables(data: FigureData, units: Units): HTMLElement[] {
  const made: HTMLElement[] = [];
  const x = shownAxis(data.x, units).label;
  for (const panel of data.panels) {
    const y = shownAxis(panel.y, units).label;
    for (const trace of panel.traces) {
      const shown = shownTrace(trace, data.x, panel, units);
      const known = [...shown.x.keys()].filter((k) => shown.y[k] != null);
      const step = Math.max(1, Math.ceil(known.length / ROWS_MOST));
      const table = document.createElement("table");
      const caption = document.createElement("caption");
      const some = step > 1 ? `, one of ${step} of ${known.length} points` : "";
      caption.textContent = `${trace.label || y}${some}`;
      const bars = shown.low.length > 0;
      const head = document.createElement("thead");
      head.append(row(bars ? [x, y, "bar from", "to"] : [x, y], "th"));
      const body = document.createElement("tbody");
      for (const k of known.filter((_, place) => place % step === 0)) {
        const cells = bars ? [shown.x[k], shown.y[k], shown.low[k], shown.high[k]] : [shown.x[k], shown.y[k]];
        body.append(
          row(
            cells.map((value) => (value == null ? "" : digits(value))),
            "td",
          ),
        );
      }
      table.append(caption, head, body);
      made.push(table);
    }
  }
  return made;
}
