// An interactive figure: panels one above the other over one horizontal axis.

import uPlot from "uplot";
import { colours } from "./colours";
import { type PanelView, draw } from "./draw";
import { csv, fileName, save } from "./export";
import type { FigureData } from "./figure_data";
import { Legend, entries } from "./legend";
import type { Follower, Links } from "./links";
import { type Range, padded, rangeX, rangeY } from "./range";
import { tables } from "./table";
import { type UnitChoice, digits, shownAxis, shownTrace, unitOf } from "./units";

/** Heights of the frame of a panel that is alone, and of one of several [px]. */
const [ALONE, STACKED] = [300, 210];
/** Height of the labels below the last panel [px]. */
const LABELS = 48;
const LABEL_FONT = "12px system-ui, sans-serif";
/** Steps of an axis of degrees. */
const DEGREES = [0.1, 0.2, 0.5, 1, 2, 5, 10, 15, 30, 45, 90, 180, 360, 720];
/** Smallest part of the axis that can be shown. */
const ZOOM_MOST = 1e-6;
let figures = 0;

/** Gives the points of a part of the horizontal axis, for so many pixels; null if there are none. */
export type Refine = (range: Range, pixels: number) => Promise<FigureData | null>;

/** What a figure can have in addition to its data. */
export interface Extras {
  /** Gives the points of the part that is shown; the horizontal axis must then have one unit. */
  readonly refine?: Refine;
  /** The part that is shown at first; all if absent. */
  readonly first?: Range | null;
  /** The figures of the page that can be linked. */
  readonly links?: Links;
}

export class Figure implements Follower {
  private data: FigureData;
  private readonly choice: UnitChoice;
  private readonly legend: Legend;
  private readonly frames = document.createElement("div");
  private readonly readout = document.createElement("output");
  private readonly reset: HTMLButtonElement;
  private plots: uPlot[] = [];
  private views: PanelView[] = [];
  private full: Range = [0, 1];
  private shown: Range = [0, 1];
  private log = false;
  private width = 0;
  private readonly key = `figure-${++figures}`;
  /** What ends with the figure. */
  private readonly ends: (() => void)[] = [];

  private knowsFull = false;
  /** Whether the points are not those of what is shown, whether they are asked for, and whether the figure has ended. */
  private outdated = false;
  private isAsking = false;
  private hasEnded = false;

  private readonly refine: Refine | null;
  private first: Range | null;
  private readonly links: Links | null;

  /** `picture` is the same figure as SVG. */
  constructor(
    place: HTMLElement,
    data: FigureData,
    choice: UnitChoice,
    picture: Element | null,
    extras: Extras = {},
  ) {
    [this.data, this.choice] = [data, choice];
    this.refine = extras.refine ?? null;
    this.links = (data.linked && extras.links) || null;
    this.first = extras.first ?? (data.linked && this.links ? this.links.shownBy(data.linked) : null);
    this.legend = new Legend(entries(data), () => this.restore());
    this.reset = this.button("All", "show the whole axis (double click, or key 0)", () => this.show(this.full));
    const head = document.createElement("div");
    head.className = "figure-head";
    const title = document.createElement("strong");
    title.textContent = data.title;
    head.append(title);
    if (data.subtitle) {
      const subtitle = document.createElement("span");
      subtitle.className = "subtitle";
      subtitle.textContent = data.subtitle;
      head.append(subtitle);
    }
    this.frames.className = "frames";
    this.frames.tabIndex = 0;
    this.frames.setAttribute("role", "group");
    this.frames.setAttribute(
      "aria-label",
      `Plot: ${data.title}. Arrow keys move the cutout, + and − change it, 0 shows all; a table is below.`,
    );
    this.frames.addEventListener("keydown", (event) => this.pressed(event));
    const tools = document.createElement("div");
    tools.className = "tools";
    tools.append(this.reset, this.button("CSV", this.csvTitle(), () => this.saveCsv()));
    if (picture) {
      tools.append(
        this.button("SVG", "save the picture", () => {
          save(fileName(data.title, "svg"), "image/svg+xml", new XMLSerializer().serializeToString(picture));
        }),
      );
    }
    tools.append(this.readout);
    place.append(head, this.legend.element, this.frames, tools, this.table());
    this.readout.setAttribute("aria-live", "off");
    if (data.linked && this.links) this.ends.push(this.links.join(data.linked, this));
    this.ends.push(choice.listen(() => this.restore(true)));
    const sizes = new ResizeObserver(() => {
      if (Math.abs(this.frames.clientWidth - this.width) >= 1) this.restore(true);
    });
    sizes.observe(this.frames);
    const scheme = matchMedia("(prefers-color-scheme: dark)");
    const recolour = () => {
      this.legend.redraw();
      this.restore(true);
    };
    scheme.addEventListener("change", recolour);
    this.ends.push(
      () => sizes.disconnect(),
      () => scheme.removeEventListener("change", recolour),
    );
  }

  /** Ends the figure: its place is free for another one. */
  end(): void {
    this.hasEnded = true;
    for (const end of this.ends) end();
    for (const plot of this.plots) plot.destroy();
    this.plots = [];
  }

  /** The part of the horizontal axis that is shown. */
  shownRange(): Range {
    return this.shown;
  }

  /** Takes other points of the same series, and draws them. */
  private take(data: FigureData): void {
    this.data = data;
    this.views = this.viewsOf(data);
    this.fit();
  }

  /** Asks for the points of what is shown, one question at a time. */
  private async refineSoon(): Promise<void> {
    const { refine } = this;
    this.outdated = true;
    if (!refine || this.isAsking) return;
    this.isAsking = true;
    try {
      while (this.outdated && !this.hasEnded) {
        this.outdated = false;
        const data = await refine(this.shown, Math.ceil(this.width));
        if (data && !this.outdated && !this.hasEnded) this.take(data);
      }
    } finally {
      this.isAsking = false;
    }
  }

  private button(text: string, title: string, action: () => void): HTMLButtonElement {
    const made = document.createElement("button");
    made.type = "button";
    [made.textContent, made.title] = [text, title];
    made.addEventListener("click", action);
    return made;
  }

  private csvTitle(): string {
    const thinned = this.data.panels.some((panel) => panel.traces.some((trace) => trace.points !== undefined));
    return thinned ? "save what is drawn here; long lines are thinned to what a screen shows" : "save the values";
  }

  private saveCsv(): void {
    save(fileName(this.data.title, "csv"), "text/csv", csv(this.data, this.choice.units));
  }

  private table(): HTMLElement {
    const details = document.createElement("details");
    const summary = document.createElement("summary");
    summary.textContent = "Table";
    details.append(summary);
    const place = document.createElement("div");
    place.className = "wide";
    place.tabIndex = 0;
    place.setAttribute("role", "group");
    place.setAttribute("aria-label", `Values of the plot: ${this.data.title}`);
    details.append(place);
    const fill = () => place.replaceChildren(...(details.open ? tables(this.data, this.choice.units) : []));
    details.addEventListener("toggle", fill);
    this.ends.push(this.choice.listen(fill));
    return details;
  }

  /** Draws again: all of it with `anew`, and else only what is within the frames. */
  private restore(anew = false): void {
    // What it says is in the units before.
    if (anew) this.readout.textContent = "";
    if (anew || this.plots.length === 0) this.build();
    else this.move(this.shown);
  }

  private build(): void {
    const part = this.part();
    for (const plot of this.plots) plot.destroy();
    this.width = this.frames.clientWidth;
    if (this.width < 50) return;
    const { units } = this.choice;
    const x = shownAxis(this.data.x, units);
    this.log = x.log;
    this.views = this.viewsOf(this.data);
    const lines = this.data.panels.every((panel) =>
      panel.traces.every((trace) => trace.style !== "points" && trace.style !== "columns"),
    );
    const all = rangeX(this.views, this.log);
    // Points that are asked for later are those of a part.
    if (!this.refine || !this.knowsFull) this.full = x.range ?? padded(all, this.log, lines && !this.log ? 0 : 0.04);
    this.knowsFull = true;
    const first = this.first && this.within(this.first);
    this.shown = first && first[0] < first[1] ? first : this.whole(part);
    if (first) void this.refineSoon();
    this.first = null;
    const last = this.views.length - 1;
    this.plots = this.views.map((_, k) => this.plot(k, k === last));
  }

  private viewsOf(data: FigureData): PanelView[] {
    const { units } = this.choice;
    const convertX = (value: number) => (data.x.quantity === "frequency" && units.frequency === "Hz" ? value / (2 * Math.PI) : value);
    return data.panels.map((panel) => ({
      traces: panel.traces.map((trace) => shownTrace(trace, data.x, panel, units)),
      bands: panel.bands,
      regions: panel.regions,
      convertX,
      convertY: (value: number) =>
        panel.y.quantity === "decibels" && units.magnitude === "ratio" ? 10 ** (value / 20) : value,
      isShown: (label: string, role: string) => this.legend.isShown(label, role),
    }));
  }

  /** Which part of the axis is shown, from 0 to 1. */
  private part(): Range {
    const place = (value: number) => (this.log ? Math.log10(value) : value);
    const [low, high] = [place(this.full[0]), place(this.full[1])];
    if (this.plots.length === 0 || !(high > low)) return [0, 1];
    return [(place(this.shown[0]) - low) / (high - low), (place(this.shown[1]) - low) / (high - low)];
  }

  private whole([from, to]: Range): Range {
    const place = (value: number) => (this.log ? Math.log10(value) : value);
    const [low, high] = [place(this.full[0]), place(this.full[1])];
    const at = (part: number) => (this.log ? 10 ** (low + part * (high - low)) : low + part * (high - low));
    return from <= 0 && to >= 1 ? this.full : [at(Math.max(from, 0)), at(Math.min(to, 1))];
  }

  private plot(k: number, isLast: boolean): uPlot {
    const palette = colours();
    const { units } = this.choice;
    const [panel, view] = [this.data.panels[k], this.views[k]];
    if (!panel || !view) throw new Error("no panel");
    const y = shownAxis(panel.y, units);
    const height = this.views.length === 1 ? ALONE : STACKED;
    const ticks = (_: uPlot, splits: (number | null)[]) => splits.map((value) => (value == null ? "" : digits(value)));
    const axis = { filter: logTicks, stroke: palette.ink, grid: { stroke: palette.grid, width: 1 }, ticks: { stroke: palette.grid, width: 1 } };
    const rangeOfY = y.range ?? rangeY(view, this.shown, y.log);
    const exact = (_: uPlot, min: number, max: number): [number, number] => [min, max];
    const options: uPlot.Options = {
      width: this.width,
      height: height + (isLast ? LABELS : 8),
      legend: { show: false },
      cursor: {
        sync: { key: this.key, setSeries: false },
        // The figure sets the scales itself, of all panels at once: each is then drawn once.
        drag: { x: true, y: false, setScale: false },
        points: { show: false },
      },
      scales: {
        x: { time: false, distr: this.log ? 3 : 1, auto: false, range: exact, min: this.shown[0], max: this.shown[1] },
        y: { distr: y.log ? 3 : 1, auto: false, range: exact, min: rangeOfY[0], max: rangeOfY[1] },
      },
      series: [{}, { paths: () => null, points: { show: false } }],
      axes: [
        { ...axis, ...(this.log ? { splits: logSplits } : {}), values: ticks, show: true, size: isLast ? LABELS : 8, ...(isLast ? { label: shownAxis(this.data.x, units).label, labelSize: 20, labelFont: LABEL_FONT } : { values: () => [] }) },
        { ...axis, ...(y.log ? { splits: logSplits } : {}), values: ticks, label: y.label, labelSize: 22, labelFont: LABEL_FONT, size: 62, ...(panel.y.quantity === "degrees" ? { incrs: DEGREES } : {}) },
      ],
      padding: [8, 14, 0, 0],
      hooks: {
        draw: [(u) => draw(u, this.views[k] ?? view, palette)],
        setSelect: [(u) => this.selected(u)],
        setScale: [(u, key) => this.scaled(u, key)],
        setCursor: [(u) => this.pointed(u)],
      },
    };
    // The data are the ends of the axes: a double click shows them.
    return new uPlot(options, [[...this.full], [...rangeOfY]], this.frames);
  }

  /** A part is chosen by dragging; panels that share the cursor repeat it without an event. */
  private selected(u: uPlot): void {
    const { left, width } = u.select;
    if (width <= 0 || u.cursor.event == null) return;
    const range: Range = [u.posToVal(left, "x"), u.posToVal(left + width, "x")];
    queueMicrotask(() => {
      for (const plot of this.plots) plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
      this.show(range);
    });
  }

  private scaled(u: uPlot, key: string): void {
    const { min, max } = u.scales["x"] ?? {};
    if (key !== "x" || min == null || max == null || !this.plots.includes(u)) return;
    // A double click asks for the range of the data, which is the one at the start.
    if (min !== this.shown[0] || max !== this.shown[1]) this.show([min, max]);
  }

  /** Shows a part of the horizontal axis in all panels, and in the figures that are linked. */
  private show(range: Range): void {
    if (!this.move(range) || !this.data.linked) return;
    const isAll = this.shown[0] === this.full[0] && this.shown[1] === this.full[1];
    this.links?.moved(this.data.linked, this, isAll ? null : this.shown);
  }

  follow(range: Range | null): void {
    if (this.plots.length > 0) this.move(range ?? this.full);
  }

  /** Shows a part of the horizontal axis; false if it is too small. */
  private move(asked: Range): boolean {
    const range = this.within(asked);
    const [low, high] = this.full;
    const span = this.log ? Math.log10(high / low) : high - low;
    const wanted = this.log ? Math.log10(range[1] / range[0]) : range[1] - range[0];
    if (!(wanted > ZOOM_MOST * span)) return false;
    this.shown = range;
    this.fit();
    void this.refineSoon();
    return true;
  }

  /** A range within the whole axis. */
  private within(range: Range): Range {
    return [Math.max(range[0], this.full[0]), Math.min(range[1], this.full[1])];
  }

  /** Fits the vertical axes to what is shown. */
  private fit(): void {
    this.plots.forEach((plot, k) => {
      const [view, panel] = [this.views[k], this.data.panels[k]];
      if (!view || !panel) return;
      const y = shownAxis(panel.y, this.choice.units);
      const [bottom, top] = y.range ?? rangeY(view, this.shown, y.log);
      plot.batch(() => {
        plot.setScale("x", { min: this.shown[0], max: this.shown[1] });
        plot.setScale("y", { min: bottom, max: top });
      });
    });
  }

  private pressed(event: KeyboardEvent): void {
    const [from, to] = this.part();
    const span = to - from;
    const moved = (by: number) => {
      const step = Math.min(Math.max(by * span, -from), 1 - to);
      this.show(this.whole([from + step, to + step]));
    };
    const middle = (from + to) / 2;
    const scaled = (by: number) => this.show(this.whole([middle - (by * span) / 2, middle + (by * span) / 2]));
    const actions: Record<string, () => void> = {
      ArrowLeft: () => moved(-0.2),
      ArrowRight: () => moved(0.2),
      "+": () => scaled(0.6),
      "=": () => scaled(0.6),
      "-": () => scaled(1 / 0.6),
      "0": () => this.show(this.full),
      Escape: () => this.show(this.full),
    };
    const action = actions[event.key];
    if (!action || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    action();
  }

  /** Says the values at the cursor. */
  private pointed(u: uPlot): void {
    const { left, top } = u.cursor;
    // Of the panels that share a cursor, the one under the pointer says it.
    if (left == null || top == null || left < 0 || top < 0 || !u.over.matches(":hover")) return;
    const x = u.posToVal(left, "x");
    const { units } = this.choice;
    const label = shownAxis(this.data.x, units).label;
    const parts = [`${digits(x)} ${unitOf(label)}`.trim()];
    this.views.forEach((view, k) => {
      const panel = this.data.panels[k];
      const unit = panel ? unitOf(shownAxis(panel.y, units).label) : "";
      for (const trace of view.traces) {
        if (!view.isShown(trace.of.label, trace.of.role)) continue;
        const place = trace.rises ? nearest(trace.x, x) : closest(this.plots[k] ?? u, trace.x, trace.y, left, top);
        const y = place === null ? null : trace.y[place];
        const name = trace.of.label || (panel ? panel.y.label.replace(/ \([^()]*\)$/, "") : "");
        if (y != null) parts.push(`${name} ${digits(y)} ${unit.replace(/^dB re .*/, "dB")}`.trim());
      }
    });
    this.readout.textContent = parts.join(" · ");
  }
}

/** Where a logarithmic axis has lines: at 1 to 9 times each power of ten, or evenly if that is too coarse. */
function logSplits(_: uPlot, __: number, low: number, high: number): number[] {
  const found: number[] = [];
  for (let power = Math.floor(Math.log10(low)); power <= Math.log10(high); power++) {
    for (let digit = 1; digit <= 9; digit++) {
      const value = Number(`${digit}e${power}`);
      if (value >= low && value <= high) found.push(value);
    }
  }
  if (found.length >= 3) return found;
  const power = 10 ** Math.floor(Math.log10((high - low) / 3));
  const step = power * ([5, 2].find((factor) => factor * power * 3 <= high - low) ?? 1);
  const first = Math.ceil(low / step);
  return Array.from({ length: Math.floor(high / step) - first + 1 }, (_unused, k) => (first + k) * step);
}

/** Which ticks of a logarithmic axis have a number: of many, those at 1, 2 and 5, or only the powers of ten. */
function logTicks(u: uPlot, splits: number[], axis: number): (number | null)[] {
  const scale = u.scales[axis === 0 ? "x" : "y"];
  if (scale?.distr !== 3) return splits;
  const decades = Math.log10((scale.max ?? 10) / (scale.min ?? 1));
  const kept = decades <= 0.8 ? [1, 2, 3, 4, 5, 6, 7, 8, 9] : decades <= 2.5 ? [1, 2, 5] : [1];
  const first = (value: number) => value / 10 ** Math.floor(Math.log10(value) + 1e-9);
  const named = (some: readonly number[]) =>
    splits.map((value) => (some.some((digit) => Math.abs(first(value) - digit) < 1e-6) ? value : null));
  // An axis has two numbers at least.
  const enough = [kept, [1, 2, 5], [1, 2, 3, 4, 5, 6, 7, 8, 9]].map(named);
  const isShown = (value: number | null) => value !== null && value >= (scale.min ?? 0) && value <= (scale.max ?? Number.POSITIVE_INFINITY);
  return enough.find((ticks) => ticks.filter(isShown).length >= 2) ?? splits;
}

/** Place of the abscissa that is nearest; the abscissae do not fall. */
function nearest(xs: readonly number[], x: number): number | null {
  if (xs.length === 0) return null;
  let [low, high] = [0, xs.length - 1];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if ((xs[middle] as number) < x) low = middle;
    else high = middle;
  }
  return x - (xs[low] as number) < (xs[high] as number) - x ? low : high;
}

/** Place of the point that is nearest on the screen. */
function closest(
  u: uPlot,
  xs: readonly number[],
  ys: readonly (number | null)[],
  left: number,
  top: number,
): number | null {
  let [best, distance] = [null as number | null, Number.POSITIVE_INFINITY];
  xs.forEach((x, k) => {
    const y = ys[k];
    if (y == null) return;
    const far = Math.hypot(u.valToPos(x, "x") - left, u.valToPos(y, "y") - top);
    if (far < distance) [best, distance] = [k, far];
  });
  return best;
}
