// Files of a figure: its samples as CSV, its picture as SVG.

import type { FigureData } from "./figure_data";
import { type Units, shownAxis, shownTrace } from "./units";

/** A cell of a CSV. Text that a spreadsheet would compute gets a quote before it. */
function cell(value: string | number | null | undefined): string {
  if (typeof value === "number") return String(value);
  const text = /^[=+\-@\t\r]/.test(value ?? "") ? `'${value}` : (value ?? "");
  return /[",\n\r]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

/** The samples of a figure in the chosen units, a row for each. */
export function csv(data: FigureData, units: Units): string {
  const thinned = data.panels.some((panel) => panel.traces.some((trace) => trace.points !== undefined));
  const x = shownAxis(data.x, units).label;
  const head = ["quantity", "series", x, "value", "lower end of bar", "upper end of bar"];
  const rows = [thinned ? [...head, "samples before thinning"] : head];
  for (const panel of data.panels) {
    const { label } = shownAxis(panel.y, units);
    for (const trace of panel.traces) {
      const shown = shownTrace(trace, data.x, panel, units);
      shown.x.forEach((at, k) => {
        const y = shown.y[k];
        if (y === null || y === undefined) return;
        const row = [label, trace.label, at, y, shown.low[k], shown.high[k]].map(cell);
        rows.push(thinned ? [...row, cell(trace.points)] : row);
      });
    }
  }
  const [first, ...rest] = rows;
  return [(first ?? []).map(cell), ...rest].map((row) => `${row.join(",")}\r\n`).join("");
}

/** A name of a file, of letters, digits and hyphens. */
export function fileName(title: string, end: string): string {
  const plain = title.normalize("NFKD").replace(/[^A-Za-z0-9]+/g, "-");
  return `${plain.replace(/^-+|-+$/g, "").toLowerCase().slice(0, 60) || "figure"}.${end}`;
}

/** Gives the reader a file. */
export function save(name: string, type: string, text: string): void {
  const address = URL.createObjectURL(new Blob([text], { type }));
  const link = document.createElement("a");
  [link.href, link.download] = [address, name];
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 1000);
}
