// Draws what is over one pair of axes.

import type uPlot from "uplot";
import { type Colours, dashOf, markerOf, outline } from "./colours";
import type { BandData, RegionData } from "./figure_data";
import type { ShownTrace } from "./units";

export interface PanelView {
  readonly traces: readonly ShownTrace[];
  readonly bands: readonly BandData[];
  readonly regions: readonly RegionData[];
  /** Converts the bounds of bands and of regions. */
  readonly convertX: (x: number) => number;
  readonly convertY: (y: number) => number;
  isShown(label: string, role: string): boolean;
}

const LINE_WIDTH = 1.6;
const MARKER_RADIUS = 3.6;
const SHADE = 0.16;
/** Pixels up and down for each pixel to the right, in the mean, from which a line is drawn in columns. */
const DENSE = 8;
/** The part of the distance between neighbours that a column fills. */
const COLUMN_FILL = 0.7;

export function draw(u: uPlot, view: PanelView, colours: Colours): void {
  const { ctx, bbox } = u;
  const ratio = devicePixelRatio || 1;
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  const toX = (x: number) => u.valToPos(x, "x", true);
  const toY = (y: number) => u.valToPos(y, "y", true);
  shade(ctx, view, colours, bbox, toX, toY);
  const shown = view.traces.filter((trace) => view.isShown(trace.of.label, trace.of.role));
  for (const trace of shown) {
    ctx.strokeStyle = ctx.fillStyle = colours.of(trace.of.role);
    ctx.lineWidth = LINE_WIDTH * ratio;
    const style = trace.of.style;
    if (style === "columns") columns(ctx, trace, toX, toY, colours);
    else if (style !== "points") {
      if (trace.low.length > 0) ribbon(ctx, trace, toX, toY);
      ctx.setLineDash(dashOf(trace.of.role, style).map((length) => length * ratio));
      const [from, to] = shownPoints(trace, u);
      const path = trace.x.slice(from, to).map((x, k): Point => {
        const y = trace.y[from + k];
        return [toX(x), y == null ? null : toY(y)];
      });
      if (style === "line" && trace.rises && isDense(path, bbox.width)) denseLine(ctx, path, bbox, ratio);
      else line(ctx, path, style === "steps");
      ctx.setLineDash([]);
    }
  }
  for (const trace of shown) {
    if (trace.of.style === "points" || trace.of.style === "columns") bars(ctx, trace, toX, toY, colours, ratio);
    if (trace.of.style === "points") points(ctx, trace, toX, toY, colours, ratio);
  }
  ctx.restore();
}

type Place = (value: number) => number;

function shade(
  ctx: CanvasRenderingContext2D,
  view: PanelView,
  colours: Colours,
  bbox: uPlot.BBox,
  toX: Place,
  toY: Place,
): void {
  for (const region of view.regions) {
    if (!view.isShown(region.label, region.role)) continue;
    const [left, right] = [toX(view.convertX(region.from)), toX(view.convertX(region.to))];
    ctx.globalAlpha = SHADE;
    ctx.fillStyle = colours.of(region.role);
    ctx.fillRect(left, bbox.top, right - left, bbox.height);
    ctx.globalAlpha = 1;
  }
  for (const band of view.bands) {
    if (!view.isShown(band.label, band.role)) continue;
    const [low, middle, high] = [band.low, band.middle, band.high].map((y) => toY(view.convertY(y))) as [
      number,
      number,
      number,
    ];
    ctx.fillStyle = ctx.strokeStyle = colours.of(band.role);
    ctx.globalAlpha = SHADE;
    ctx.fillRect(bbox.left, high, bbox.width, low - high);
    ctx.globalAlpha = 1;
    ctx.beginPath();
    ctx.moveTo(bbox.left, middle);
    ctx.lineTo(bbox.left + bbox.width, middle);
    ctx.lineWidth = devicePixelRatio || 1;
    ctx.stroke();
  }
}

/** A point of a line on the screen; a line stops where one is missing. */
type Point = readonly [number, number | null];

function line(ctx: CanvasRenderingContext2D, path: readonly Point[], steps: boolean): void {
  ctx.beginPath();
  let before: number | null = null;
  for (const [px, py] of path) {
    if (py === null) {
      before = null;
      continue;
    }
    if (before === null) ctx.moveTo(px, py);
    else {
      if (steps) ctx.lineTo(px, before);
      ctx.lineTo(px, py);
    }
    before = py;
  }
  ctx.stroke();
}

/** Places of the points of a line that are shown, with one more on either side; all of a line that does not rise. */
function shownPoints(trace: ShownTrace, u: uPlot): [number, number] {
  const { min, max } = u.scales["x"] ?? {};
  if (!trace.rises || min == null || max == null) return [0, trace.x.length];
  return [Math.max(firstFrom(trace.x, min) - 1, 0), Math.min(firstFrom(trace.x, max) + 1, trace.x.length)];
}

/** Place of the first of rising abscissae that is not below a value. */
function firstFrom(xs: readonly number[], value: number): number {
  let [low, high] = [0, xs.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((xs[middle] as number) < value) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** Whether a line goes up and down so much that it covers columns of pixels: its strokes would take many times as long. */
function isDense(path: readonly Point[], width: number): boolean {
  let travel = 0;
  path.forEach(([, y], k) => {
    const before = path[k - 1]?.[1];
    if (y !== null && before != null) travel += Math.abs(y - before);
  });
  return travel > DENSE * width;
}

/** A dense line: for each column of pixels the range of its values. */
function denseLine(ctx: CanvasRenderingContext2D, path: readonly Point[], bbox: uPlot.BBox, ratio: number): void {
  const half = (LINE_WIDTH / 2) * ratio;
  const [first, count] = [Math.floor(bbox.left), Math.ceil(bbox.width) + 1];
  const low = new Float64Array(count).fill(Number.POSITIVE_INFINITY);
  const high = new Float64Array(count).fill(Number.NEGATIVE_INFINITY);
  const reach = (column: number, a: number, b: number) => {
    if (column < 0 || column >= count) return;
    low[column] = Math.min(low[column] as number, a, b);
    high[column] = Math.max(high[column] as number, a, b);
  };
  path.forEach(([x, y], k) => {
    const [x0, y0] = path[k - 1] ?? [x, y];
    if (y === null || y0 === null) return;
    const [from, to] = [Math.floor(x0) - first, Math.floor(x) - first];
    const at = (place: number) => (x > x0 ? y0 + ((y - y0) * (Math.min(Math.max(place, x0), x) - x0)) / (x - x0) : y);
    if (from === to) reach(to, y0, y);
    else for (let c = Math.max(from, 0); c <= Math.min(to, count - 1); c++) reach(c, at(first + c), at(first + c + 1));
  });
  for (let c = 0; c < count; c++) {
    const [bottom, top] = [low[c] as number, high[c] as number];
    if (bottom <= top) ctx.fillRect(first + c, bottom - half, 1, top - bottom + 2 * half);
  }
}

/** The area between lower and upper ends of a line. */
function ribbon(ctx: CanvasRenderingContext2D, trace: ShownTrace, toX: Place, toY: Place): void {
  const ends = trace.x.map((x, k) => [toX(x), trace.low[k], trace.high[k]] as const);
  const known = ends.filter(([, low, high]) => low != null && high != null);
  if (known.length < 2) return;
  ctx.beginPath();
  for (const [x, low] of known) ctx.lineTo(x, toY(low as number));
  for (const [x, , high] of [...known].reverse()) ctx.lineTo(x, toY(high as number));
  ctx.closePath();
  ctx.globalAlpha = SHADE;
  ctx.fill();
  ctx.globalAlpha = 1;
}

function columns(ctx: CanvasRenderingContext2D, trace: ShownTrace, toX: Place, toY: Place, colours: Colours): void {
  const places = trace.x.map(toX).sort((a, b) => a - b);
  let gap = Number.POSITIVE_INFINITY;
  places.forEach((place, k) => {
    const next = places[k + 1];
    if (next !== undefined && next > place) gap = Math.min(gap, next - place);
  });
  const width = Math.min(Math.max(COLUMN_FILL * gap, 1), 44 * (devicePixelRatio || 1));
  const foot = Math.min(toY(0), 1e6);
  trace.x.forEach((x, k) => {
    const y = trace.y[k];
    if (y === null || y === undefined) return;
    const [px, py] = [toX(x), toY(y)];
    ctx.fillRect(px - width / 2, Math.min(py, foot), width, Math.abs(py - foot));
  });
  ctx.strokeStyle = colours.ink;
  ctx.lineWidth = devicePixelRatio || 1;
  ctx.beginPath();
  ctx.moveTo(0, foot);
  ctx.lineTo(ctx.canvas.width, foot);
  ctx.stroke();
}

function bars(
  ctx: CanvasRenderingContext2D,
  trace: ShownTrace,
  toX: Place,
  toY: Place,
  colours: Colours,
  ratio: number,
): void {
  ctx.strokeStyle = trace.of.style === "columns" ? colours.ink : colours.of(trace.of.role);
  ctx.lineWidth = ratio;
  ctx.beginPath();
  trace.x.forEach((x, k) => {
    const [low, high] = [trace.low[k], trace.high[k]];
    if (low == null && high == null) return;
    const px = toX(x);
    const ends = [low, high].map((end, i) => (end == null ? (i === 0 ? ctx.canvas.height : 0) : toY(end)));
    ctx.moveTo(px, ends[0] as number);
    ctx.lineTo(px, ends[1] as number);
    for (const end of ends) {
      ctx.moveTo(px - 3 * ratio, end);
      ctx.lineTo(px + 3 * ratio, end);
    }
  });
  trace.y.forEach((y, k) => {
    const [left, right] = [trace.left[k], trace.right[k]];
    if (y == null || left == null || right == null) return;
    const py = toY(y);
    ctx.moveTo(toX(left), py);
    ctx.lineTo(toX(right), py);
    for (const end of [toX(left), toX(right)]) {
      ctx.moveTo(end, py - 3 * ratio);
      ctx.lineTo(end, py + 3 * ratio);
    }
  });
  ctx.stroke();
}

function points(
  ctx: CanvasRenderingContext2D,
  trace: ShownTrace,
  toX: Place,
  toY: Place,
  colours: Colours,
  ratio: number,
): void {
  const marker = markerOf(trace.of.role);
  for (const flagged of [false, true]) {
    ctx.beginPath();
    trace.x.forEach((x, k) => {
      const y = trace.y[k];
      if (y == null || trace.flagged.has(k) !== flagged) return;
      outline(ctx, marker, toX(x), toY(y), MARKER_RADIUS * ratio);
    });
    const isHollow = flagged || marker === "ring";
    const colour = flagged ? colours.flagged : colours.of(trace.of.role);
    ctx.lineWidth = isHollow ? 1.6 * ratio : ratio;
    ctx.fillStyle = isHollow ? colours.paper : colour;
    ctx.strokeStyle = isHollow ? colour : colours.paper;
    ctx.fill();
    ctx.stroke();
  }
}
