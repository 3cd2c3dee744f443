// The files of the session: open, drop, choose which are used.

import { send, sendFile } from "./api";
import { button, counted, h, put, seconds } from "./dom";
import type { Store } from "./store";
import type { LogView, Problem, State } from "./types";

export class Files {
  readonly element = h("section", { "aria-label": "Logs" });
  private readonly input: HTMLInputElement;

  constructor(private readonly store: Store) {
    this.input = h("input", { type: "file", multiple: true, class: "unseen", id: "choose", tabindex: -1, "aria-label": "choose logs" });
    this.input.addEventListener("change", () => {
      void this.add([...(this.input.files ?? [])]);
      this.input.value = "";
    });
    document.addEventListener("dragover", (event) => {
      event.preventDefault();
      document.body.classList.add("dragging");
    });
    document.addEventListener("dragleave", (event) => {
      if (!event.relatedTarget) document.body.classList.remove("dragging");
    });
    document.addEventListener("drop", (event) => {
      event.preventDefault();
      document.body.classList.remove("dragging");
      void this.add([...(event.dataTransfer?.files ?? [])]);
    });
  }

  /** Sends files, one after the other, and names those that cannot be read. */
  private async add(files: readonly File[]): Promise<void> {
    // A campaign comes last: it describes what is there then.
    const refused: Problem[] = [];
    const last = (file: File) => Number(file.name.toLowerCase().endsWith(".toml"));
    for (const file of [...files].sort((a, b) => last(a) - last(b))) {
      const done = await this.store.during(`reading ${file.name}`, async () => {
        this.store.take(await sendFile<State>(file));
      });
      if (!done && this.store.problem) refused.push(this.store.problem);
    }
    const [first, ...others] = refused;
    if (!first) return;
    const hint = [first.hint, ...others.map(({ error }) => error)].filter(Boolean).join("; ");
    this.store.problem = { error: first.error, hint };
    this.store.changed();
  }

  private sample(): void {
    void this.store.during("simulating logs", async () => {
      this.store.take(await send<State>("POST", "/api/sample", { revision: this.store.state.revision }));
    });
  }

  private remove(log: LogView): void {
    void this.store.during("", async () => {
      const path = `/api/logs/${log.id}?revision=${this.store.state.revision}`;
      this.store.take(await send<State>("DELETE", path));
    });
  }

  /** Each run of a file becomes a log, or all become the file again. */
  private runs(log: LogView, apart: boolean): void {
    void this.store.during("reading runs", async () => {
      const { revision } = this.store.state;
      this.store.take(await send<State>("PUT", `/api/logs/${log.id}/runs`, { revision, apart }));
    });
  }

  render(): void {
    const { logs } = this.store.state;
    const choose = button(logs.length > 0 ? "Add logs…" : "Open logs…", () => this.input.click(), { id: "open", class: "main" });
    const welcome = (open: HTMLElement) => h(
      "div",
      { class: "welcome" },
      h("p", {}, "Open or drop logs of a drive: CSV, MATLAB, Parquet, HDF5, MCAP, TDMS, wpilog, xlsx and others. They stay on this machine."),
      h("div", { class: "row" }, open, button("Try it with a sample", () => this.sample(), { id: "sample" })),
    );
    // An element has one place: the button is in the one that is shown.
    const shown = logs.length > 0 ? [this.table(logs), h("div", { class: "row" }, choose)] : [welcome(choose)];
    put(this.element, h("h2", {}, "Logs"), this.input, ...shown);
  }

  private table(logs: readonly LogView[]): HTMLElement {
    const rows = logs.map((log) => {
      const use = h("input", { type: "checkbox", id: `use-${log.id}`, "aria-label": `use ${log.name}`, disabled: log.kind !== "log" });
      use.checked = log.used;
      use.addEventListener("change", () => {
        void this.store.say((setup) => {
          setup.left_out = setup.left_out.filter((id) => id !== log.id);
          if (!use.checked) setup.left_out.push(log.id);
        });
      });
      const what = log.problem ? log.problem.error : described(log);
      const apart = log.runs_by
        ? button("Take runs apart", () => this.runs(log, true), {
            id: `apart-${log.id}`,
            title: `Each run becomes a log, to be drawn, trimmed or left out alone. Its runs are known by: ${log.runs_by}.`,
          })
        : null;
      const file = log.name.split("::")[0];
      const isFirst = logs.find((other) => other.is_run && other.name.split("::")[0] === file) === log;
      const whole = isFirst ? button("Put runs together", () => this.runs(log, false), { id: `together-${log.id}`, title: `Use ${file} as one log again.` }) : null;
      return h(
        "tr",
        {},
        h("td", {}, use),
        h("td", { class: "name" }, log.name),
        h("td", log.problem ? { class: "wrong" } : {}, what),
        h("td", {}, h("div", { class: "row" }, apart, whole, button("Remove", () => this.remove(log), { id: `remove-${log.id}`, "aria-label": `remove ${log.name}` }))),
      );
    });
    const head = ["use", "log", "content", ""].map((text) => (text ? h("th", { scope: "col" }, text) : h("td", {})));
    return h(
      "div",
      { class: "wide", tabindex: 0, role: "group", "aria-label": "Logs" },
      h("table", { class: "files" }, h("thead", {}, h("tr", {}, ...head)), h("tbody", {}, ...rows)),
    );
  }
}

function described(log: LogView): string {
  if (log.kind === "campaign") return "describes the logs";
  if (!log.log) return "";
  const { format, channels, clock } = log.log;
  const samples = Math.max(0, ...channels.map((channel) => channel.values));
  const time = channels.find((channel) => channel.number === log.log?.roles.find(({ role }) => role === "time")?.channel);
  const unit = time?.unit ?? "";
  const length = clock && unit === "s" ? `, ${seconds(clock.length)}` : "";
  const gaps = clock && clock.gaps > 0 ? `, ${counted(clock.gaps, "gap")}` : "";
  return `${format}: ${counted(channels.length, "channel")}, ${counted(samples, "sample")}${length}${gaps}`;
}
