// The motion of the logs: one or several over each other, and what of them is left out.

import { Figure } from "../figure";
import type { AxisData, FigureData, RegionData, TraceData } from "../figure_data";
import type { Range } from "../range";
import { UnitChoice } from "../units";
import { get } from "./api";
import { label } from "./channels";
import { button, h, put } from "./dom";
import type { Store } from "./store";
import type { Channel, InspectedLog, LogView, Setup, Trace, Trim } from "./types";

/** Pixels of a plot before its width is known. */
const PIXELS = 1200;
const PANELS_MOST = 4;
const plain = (name: string): AxisData => ({ label: name, scale: "linear", quantity: "plain", range: null });

export class Motion {
  readonly element = h("section", { "aria-label": "Motion" });
  private readonly place = h("div", { class: "live" });
  private readonly table = h("div");
  private readonly choice = new UnitChoice();
  private figure: Figure | null = null;
  /** Logs that are drawn; the first is the one that is trimmed. */
  private drawn: number[] = [];
  private channels: string[] = [];
  private key = "";
  /** First time of each log, in the unit of its stamps. */
  private readonly starts = new Map<number, number>();
  private asked = 0;

  constructor(private readonly store: Store) {}

  render(): void {
    const logs = this.logs();
    if (logs.length === 0) {
      this.clear();
      return;
    }
    this.drawn = this.drawn.filter((id) => logs.some((log) => log.id === id));
    if (this.drawn.length === 0) this.drawn = logs.slice(0, 1).map(({ id }) => id);
    if (this.element.childElementCount === 0) {
      put(this.element, h("h2", {}, "Motion"), this.place, this.table);
    }
    this.renderTable(logs);
    void this.draw();
  }

  private clear(): void {
    this.figure?.end();
    [this.figure, this.key] = [null, ""];
    put(this.element);
  }

  private logs(): LogView[] {
    return this.store.state.logs.filter((log) => log.kind === "log" && log.log);
  }

  private main(): LogView | undefined {
    return this.logs().find(({ id }) => id === this.drawn[0]);
  }

  /** Channels that are drawn: those with a role. */
  private shown(log: InspectedLog): Channel[] {
    const { setup } = this.store.state;
    const of = (pick: { column: string } | null | undefined, role: string) => {
      const guess = log.roles.find((known) => known.role === role)?.channel;
      return log.channels.find((each) => (pick?.column ? [each.asked, String(each.number)].includes(pick.column) : each.number === guess));
    };
    const input = of(setup.command?.channel, "current") ?? of(null, "torque") ?? of(null, "voltage");
    const all = [of(setup.motor, "motor"), input, ...setup.tips.map((tip) => of(tip, "none"))];
    const found = [...new Set(all.filter((each) => each !== undefined))];
    const time = of(setup.time, "time");
    return (found.length > 0 ? found : log.channels.filter((each) => each !== time && !each.constant)).slice(0, PANELS_MOST);
  }

  /** The log of the figure, the first one of several. */
  private shownLog = 0;

  private async draw(): Promise<void> {
    const main = this.main();
    if (!main?.log) return;
    this.channels = this.shown(main.log).map((channel) => channel.asked);
    const { setup } = this.store.state;
    const trims = JSON.stringify(setup.trims.filter((trim) => this.drawn.includes(trim.log)));
    const key = JSON.stringify([this.drawn, this.channels, trims, setup.header_row, setup.skip_rows, setup.time, setup.sample_time]);
    if (key === this.key) return;
    this.key = key;
    const turn = ++this.asked;
    try {
      const data = await this.points(null, PIXELS);
      if (turn !== this.asked) return;
      // The part that is shown stays for the same log.
      const shown = this.shownLog === main.id ? (this.figure?.shownRange() ?? null) : null;
      this.shownLog = main.id;
      this.figure?.end();
      this.place.replaceChildren();
      this.figure = new Figure(this.place, data, this.choice, null, {
        refine: async (range, pixels) => {
          try {
            return await this.points(range, pixels);
          } catch (error) {
            this.store.fail(error);
            return null;
          }
        },
        first: shown,
      });
    } catch (error) {
      put(this.place, h("p", { class: "wrong" }, String(error)));
    }
  }

  /** The points of all channels and logs in a range of time from the start of each log. */
  private async points(range: Range | null, pixels: number): Promise<FigureData> {
    const logs = this.logs().filter(({ id }) => this.drawn.includes(id));
    const main = this.main();
    const panels = await Promise.all(
      this.channels.map(async (name) => {
        const traces = await Promise.all(logs.map((log, k) => this.trace(log, name, range, pixels, k)));
        const known = traces.filter((trace) => trace !== null);
        const shown = main?.log?.channels.find((each) => each.asked === name);
        return { label: shown ? label(shown) : name, x: known[0]?.[0].x_label ?? "", traces: known.map(([, trace]) => trace) };
      }),
    );
    const regions = main ? this.regions(main) : [];
    return {
      title: logs.length === 1 ? (logs[0]?.name ?? "") : `${logs.length} logs`,
      subtitle: null,
      x: plain(panels.find(({ x }) => x !== "")?.x ?? "time"),
      panels: panels.map(({ label: name, traces }) => ({ y: plain(name), traces, bands: [], regions })),
      skipped: 0,
    };
  }

  private async trace(log: LogView, name: string, range: Range | null, pixels: number, k: number): Promise<[Trace, TraceData] | null> {
    const channel = log.log?.channels.find((each) => each.asked === name);
    if (!channel) return null;
    const start = this.starts.get(log.id) ?? 0;
    const part = range ? `&from=${range[0] + start}&to=${range[1] + start}` : "";
    const found = await get<Trace>(`/api/logs/${log.id}/trace/${channel.number}?pixels=${pixels}${part}`);
    if (!range) this.starts.set(log.id, found.x[0] ?? 0);
    const from = this.starts.get(log.id) ?? 0;
    const several = this.drawn.length > 1;
    const data: TraceData = {
      label: several ? log.name : label(channel),
      role: several ? `other${k % 4}` : "raw",
      style: "line",
      x: found.x.map((x) => x - from),
      y: found.y,
      ...(found.x.length < found.samples ? { points: found.samples } : {}),
    };
    return [found, data];
  }

  /** What of a log is left out, in the unit of its stamps. */
  private regions(log: LogView): RegionData[] {
    const trim = this.store.state.setup.trims.find((each) => each.log === log.id);
    const unit = log.stamp_s;
    if (!trim || unit === null) return [];
    const at = (text: string) => Number.parseFloat(text) / unit;
    const region = (from: number, to: number): RegionData => ({ label: "left out", role: "other3", from, to });
    const end = (log.log?.clock?.length ?? 0) + (log.log?.clock?.step ?? 0);
    return [
      ...(trim.skip ? [region(0, at(trim.skip))] : []),
      ...(trim.until ? [region(at(trim.until), end)] : []),
      ...trim.leave_out.map(([from, to]) => region(at(from), at(to))),
    ];
  }

  /** Changes which stretches of the first drawn log are excluded. */
  private trim(change: (trim: Trim, shown: Range, end: number) => void): void {
    const log = this.main();
    const unit = log?.stamp_s;
    const shown = this.figure?.shownRange();
    if (!log || !unit || !shown) return;
    const end = log.log?.clock?.length ?? 0;
    void this.store.say((setup) => {
      const known = setup.trims.find((each) => each.log === log.id) ?? { log: log.id, skip: "", until: "", leave_out: [] };
      change(known, [Math.max(0, shown[0] * unit), shown[1] * unit], end * unit);
      setup.trims = [...setup.trims.filter((each) => each.log !== log.id), known].filter(
        (each) => each.skip || each.until || each.leave_out.length > 0,
      );
    });
  }

  private renderTable(logs: readonly LogView[]): void {
    const main = this.main();
    const overlay = h("fieldset", { class: "row" }, h("legend", {}, "Draw"));
    for (const log of logs) {
      const box = h("input", { type: "checkbox", id: `draw-${log.id}` });
      box.checked = this.drawn.includes(log.id);
      box.addEventListener("change", () => {
        this.drawn = box.checked ? [...this.drawn, log.id] : this.drawn.filter((id) => id !== log.id);
        this.render();
      });
      overlay.append(h("label", { class: "check" }, box, log.name));
    }
    const parts: (Node | string | null)[] = [logs.length > 1 ? overlay : null];
    if (main && main.stamp_s !== null) {
      const time = (value: number) => `${Number(value.toPrecision(6))} s`;
      parts.push(
        h("p", { class: "why" }, `Zoom by dragging; then, of ${main.name}:`),
        h(
          "div",
          { class: "row" },
          button("Leave out what is shown", () => this.trim((trim, range, end) => this.leaveOut(trim, range, end, time)), { id: "leave-out" }),
          button("Keep only what is shown", () => this.trim((trim, [from, to], end) => this.keep(trim, from, to, end, time)), { id: "keep-only" }),
          button("Use all again", () => this.trim((trim) => Object.assign(trim, { skip: "", until: "", leave_out: [] })), { id: "use-all" }),
          h("span", { id: "trimmed" }, words(this.store.state.setup, main.id)),
        ),
      );
    }
    put(this.table, ...parts);
  }

  private leaveOut(trim: Trim, [from, to]: Range, end: number, time: (value: number) => string): void {
    if (from <= 0 && to >= end) {
      this.store.problem = { error: "this is the whole log", hint: "Zoom into the stretch first, or take the log out of use above." };
      return;
    }
    trim.leave_out.push([time(from), time(to)]);
  }

  private keep(trim: Trim, from: number, to: number, end: number, time: (value: number) => string): void {
    trim.skip = from > 0 ? time(from) : "";
    trim.until = to < end ? time(to) : "";
  }
}

function words(setup: Setup, log: number): string {
  const trim = setup.trims.find((each) => each.log === log);
  if (!trim) return "Nothing of it is left out.";
  const number = (text: string) => `${Number(Number.parseFloat(text).toPrecision(5))} s`;
  const parts = [
    ...(trim.skip ? [`before ${number(trim.skip)}`] : []),
    ...(trim.until ? [`after ${number(trim.until)}`] : []),
    ...trim.leave_out.map(([from, to]) => `${number(from)} to ${number(to)}`),
  ];
  return `Left out: ${parts.join(", ")}.`;
}
