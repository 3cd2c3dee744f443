// Ranges of axes.

import type { PanelView } from "./draw";

export type Range = readonly [number, number];

/** Part of the span that is free above and below. */
const PAD = 0.05;
/** How far an error bar may stretch an axis, as a part of the span of the points. */
const BAR_STRETCH = 0.35;

function forward(log: boolean, value: number): number {
  return log ? Math.log10(value) : value;
}

function back(log: boolean, value: number): number {
  return log ? 10 ** value : value;
}

/** `range` with a margin; a point gets one of its own size. */
export function padded(range: Range, log: boolean, part = PAD): Range {
  let [low, high] = [forward(log, range[0]), forward(log, range[1])];
  if (!(high - low > 1e-9 * Math.max(Math.abs(low), Math.abs(high), 1e-300))) {
    const half = log ? 0.3 : Math.max(0.1 * Math.abs(low), low === 0 ? 1 : 0);
    [low, high] = [low - half, high + half];
  }
  const pad = part * (high - low);
  return [back(log, low - pad), back(log, high + pad)];
}

/** The horizontal range of all traces, without a margin. */
export function rangeX(views: readonly PanelView[], log: boolean): Range {
  let [low, high] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
  for (const trace of views.flatMap((view) => view.traces)) {
    for (const x of trace.x) {
      if (log && x <= 0) continue;
      [low, high] = [Math.min(low, x), Math.max(high, x)];
    }
  }
  return low <= high ? [low, high] : log ? [1, 10] : [0, 1];
}

/** The vertical range of what is shown between two abscissae. */
export function rangeY(view: PanelView, [from, to]: Range, log: boolean): Range {
  let [low, high] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
  let [bottom, top] = [low, high];
  const all = view.traces.filter((trace) => view.isShown(trace.of.label, trace.of.role));
  for (const trace of all) {
    trace.y.forEach((y, k) => {
      const x = trace.x[k] as number;
      if (y === null || x < from || x > to || (log && y <= 0)) return;
      [low, high] = [Math.min(low, y), Math.max(high, y)];
      const ends = [trace.low[k], trace.high[k]];
      for (const end of ends) {
        if (end == null || trace.flagged.has(k) || (log && end <= 0)) continue;
        [bottom, top] = [Math.min(bottom, end), Math.max(top, end)];
      }
    });
    if (trace.of.style === "columns" && !log) [low, high] = [Math.min(low, 0), Math.max(high, 0)];
  }
  for (const band of view.bands.filter((band) => view.isShown(band.label, band.role))) {
    for (const end of [view.convertY(band.low), view.convertY(band.high)]) {
      if (!log || end > 0) [low, high] = [Math.min(low, end), Math.max(high, end)];
    }
  }
  if (!(low <= high)) return log ? [1, 10] : [0, 1];
  const stretch = BAR_STRETCH * (high - low);
  if (log) {
    const [less, more] = [Math.max(bottom, low / 3), Math.min(top, high * 3)];
    return padded([Math.min(low, less), Math.max(high, more)], log);
  }
  const least = high > low ? low - stretch : bottom;
  const most = high > low ? high + stretch : top;
  return padded([Math.min(low, Math.max(bottom, least)), Math.max(high, Math.min(top, most))], log);
}
