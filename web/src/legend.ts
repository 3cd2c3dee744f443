// The legend of a figure: a button for each series, which shows or hides it.

import { colours, dashOf, markerOf, outline } from "./colours";
import type { FigureData } from "./figure_data";

export interface Entry {
  readonly label: string;
  readonly role: string;
  readonly kind: "line" | "points" | "columns" | "area" | "flagged";
  readonly style: string;
}

/** What can be shown and hidden; entries that are alike are one. */
export function entries(data: FigureData): Entry[] {
  const found: Entry[] = [];
  const add = (entry: Entry) => {
    const known = found.some((other) => other.label === entry.label && other.role === entry.role);
    if (entry.label !== "" && !known) found.push(entry);
  };
  for (const panel of data.panels) {
    for (const { label, role, style } of panel.traces) {
      add({ label, role, style, kind: style === "points" || style === "columns" ? style : "line" });
    }
    for (const { label, role } of [...panel.bands, ...panel.regions]) add({ label, role, style: "", kind: "area" });
  }
  const isFlagged = data.panels.some(({ traces }) => traces.some(({ flagged }) => flagged && flagged.length > 0));
  if (isFlagged) add({ label: "flagged: a finding affects the point", role: "flagged", style: "", kind: "flagged" });
  return found;
}

export class Legend {
  readonly element = document.createElement("div");
  private readonly hidden = new Set<string>();
  private readonly swatches: (() => void)[] = [];

  constructor(all: readonly Entry[], changed: () => void) {
    this.element.className = "legend";
    for (const entry of all) {
      if (entry.kind === "flagged") {
        // Flagged points belong to their series.
        const note = document.createElement("span");
        const canvas = document.createElement("canvas");
        canvas.setAttribute("aria-hidden", "true");
        note.append(canvas, entry.label);
        this.swatches.push(() => swatch(canvas, entry));
        this.element.append(note);
        continue;
      }
      const button = document.createElement("button");
      button.type = "button";
      button.setAttribute("aria-pressed", "true");
      button.title = "show or hide";
      const canvas = document.createElement("canvas");
      canvas.setAttribute("aria-hidden", "true");
      button.append(canvas, entry.label);
      const key = `${entry.role} ${entry.label}`;
      button.addEventListener("click", () => {
        const isHidden = this.hidden.delete(key) ? false : (this.hidden.add(key), true);
        button.setAttribute("aria-pressed", String(!isHidden));
        changed();
      });
      this.swatches.push(() => swatch(canvas, entry));
      this.element.append(button);
    }
    this.redraw();
  }

  isShown(label: string, role: string): boolean {
    return !this.hidden.has(`${role} ${label}`);
  }

  redraw(): void {
    for (const draw of this.swatches) draw();
  }
}

function swatch(canvas: HTMLCanvasElement, entry: Entry): void {
  const ratio = devicePixelRatio || 1;
  const [width, height] = [28, 14];
  [canvas.width, canvas.height] = [width * ratio, height * ratio];
  const ctx = canvas.getContext("2d");
  if (!ctx) return;
  ctx.scale(ratio, ratio);
  ctx.fillStyle = ctx.strokeStyle = colours().of(entry.role);
  ctx.lineWidth = 2;
  if (entry.kind === "line") {
    ctx.setLineDash([...dashOf(entry.role, entry.style)]);
    ctx.beginPath();
    ctx.moveTo(1, height / 2);
    ctx.lineTo(width - 1, height / 2);
    ctx.stroke();
  } else if (entry.kind === "points" || entry.kind === "flagged") {
    const marker = markerOf(entry.role);
    ctx.beginPath();
    outline(ctx, marker, width / 2, height / 2, 4);
    if (entry.kind === "flagged") ctx.strokeStyle = colours().flagged;
    if (entry.kind === "flagged" || marker === "ring") ctx.stroke();
    else ctx.fill();
  } else {
    ctx.globalAlpha = entry.kind === "area" ? 0.3 : 1;
    ctx.fillRect(4, 2, width - 8, height - 4);
  }
}
