// Results: the report of one, its files, and the comparison of several.

import { enlivenReport } from "../report";
import { get, getFile, getText, send } from "./api";
import { button, counted, h, put } from "./dom";
import type { Store } from "./store";
import type { Compared, Result, State } from "./types";

const FILE_WORDS: Record<string, string> = {
  "report.html": "report page",
  "result.json": "all numbers",
  "campaign.toml": "description of the logs",
  "arm.py": "python-control",
  "arm.m": "MATLAB script",
  "arm.mat": "MATLAB file",
  "arm.xml": "MuJoCo",
  "lissom_feedforward.h": "C header",
  "lissom_feedforward.c": "C source",
};

export class Results {
  readonly element = h("section", { "aria-label": "Results" });
  private readonly report = h("article", { class: "report" });
  private shown = 0;
  /** What is on the page. */
  private key = "";

  constructor(private readonly store: Store) {}

  /** Shows a result. */
  show(id: number): void {
    this.shown = id;
  }

  render(): void {
    const { results } = this.store.state;
    const result = results.find(({ id }) => id === this.shown) ?? results.at(-1);
    if (!result) {
      put(this.element, h("p", {}, "There is no result yet: open logs and identify them."));
      this.report.replaceChildren();
      this.key = "";
      return;
    }
    this.shown = result.id;
    // A list that is open stays so while nothing else is to be shown.
    const key = JSON.stringify([results.map(({ id }) => id), result.id]);
    if (key === this.key) return;
    this.key = key;
    const isNew = this.report.dataset["id"] !== String(result.id);
    const select = h("select", { id: "result", "aria-label": "result" });
    for (const each of [...results].reverse()) select.append(new Option(title(each), String(each.id)));
    select.value = String(result.id);
    select.addEventListener("change", () => {
      this.shown = Number(select.value);
      this.render();
    });
    const again = button("Use its settings again", () => void this.store.say((setup) => Object.assign(setup, structuredClone(result.setup))), { id: "again" });
    const remove = button("Remove", () => void this.remove(result), { "aria-label": "remove this result" });
    put(this.element, h("div", { class: "row" }, select, again, remove), this.files(result), this.report);
    if (isNew) void this.load(result);
  }

  private async load(result: Result): Promise<void> {
    this.report.dataset["id"] = String(result.id);
    put(this.report, h("p", {}, "…"));
    await this.store.during("", async () => {
      const text = await getText(`/api/results/${result.id}/report`);
      if (this.shown !== result.id) return;
      // The server has escaped all text of logs; the policy of this page runs no script of it either.
      this.report.innerHTML = text;
      enlivenReport(this.report);
    });
  }

  private files(result: Result): HTMLElement {
    const command = `lissom identify campaign.toml${result.effort === "normal" ? "" : ` --effort ${result.effort}`} --report report.html --json result.json`;
    const links = this.store.state.files.map((name) =>
      h("li", {}, button(name, () => void this.save(result, name), { id: `file-${name}` }), ` ${FILE_WORDS[name] ?? ""}`),
    );
    return h(
      "details",
      { class: "files-of" },
      h("summary", {}, "Save files"),
      h("ul", {}, ...links),
      h("p", {}, "The same from the command line, with campaign.toml beside the logs: ", h("code", { id: "command-line" }, command)),
    );
  }

  private async save(result: Result, name: string): Promise<void> {
    await this.store.during("", async () => {
      const address = URL.createObjectURL(await getFile(`/api/results/${result.id}/files/${name}`));
      h("a", { href: address, download: name }).click();
      setTimeout(() => URL.revokeObjectURL(address), 60_000);
    });
  }

  private async remove(result: Result): Promise<void> {
    await this.store.during("", async () => this.store.take(await send<State>("DELETE", `/api/results/${result.id}`)));
  }
}

export class Compare {
  readonly element = h("section", { "aria-label": "Compare" });
  private readonly place = h("div");
  private chosen: number[] = [];
  private key = "";

  constructor(private readonly store: Store) {}

  render(): void {
    const { results } = this.store.state;
    if (results.length < 2) {
      put(this.element, h("p", {}, "Identify twice to compare: with another effort, without a run, with gravity, …"));
      return;
    }
    this.chosen = this.chosen.filter((id) => results.some((result) => result.id === id));
    if (this.chosen.length < 2) this.chosen = results.slice(-2).map(({ id }) => id);
    const boxes = results.map((result) => {
      const box = h("input", { type: "checkbox", id: `compare-${result.id}` });
      box.checked = this.chosen.includes(result.id);
      box.addEventListener("change", () => {
        this.chosen = box.checked ? [...this.chosen, result.id] : this.chosen.filter((id) => id !== result.id);
        this.render();
      });
      return h("label", { class: "check" }, box, title(result));
    });
    put(this.element, h("fieldset", {}, h("legend", {}, "Results; the first one is the reference"), ...boxes), this.place);
    const key = this.chosen.join(",");
    if (key === this.key) return;
    this.key = key;
    if (this.chosen.length < 2) put(this.place, h("p", {}, "Choose two or more."));
    else void this.load(key);
  }

  private async load(key: string): Promise<void> {
    await this.store.during("", async () => {
      const found = await get<Compared>(`/api/compare?results=${key}`);
      if (key === this.key) put(this.place, ...this.changes(), table(found));
    });
  }

  /** What was said differently. */
  private changes(): HTMLElement[] {
    const chosen = this.chosen.map((id) => this.store.state.results.find((result) => result.id === id));
    const [first, ...others] = chosen.filter((result) => result !== undefined);
    if (!first) return [];
    const differ = Object.keys(first.setup).filter((key) => {
      const text = (result: Result) => JSON.stringify(result.setup[key as keyof Result["setup"]]);
      return others.some((other) => text(other) !== text(first));
    });
    const words = differ.length > 0 ? `Settings that differ: ${differ.map((key) => key.replaceAll("_", " ")).join(", ")}.` : "The settings are the same.";
    const same = " Results of the same logs share their noise: differences are then smaller than their standard errors say.";
    return [h("p", {}, words + same)];
  }
}

function table(found: Compared): HTMLElement {
  const head = ["quantity", "unit", ...found.results.map(({ file }) => file), ...found.results.slice(1).map(({ file }) => `change: ${file}`)];
  const rows = found.parameters.map((parameter) => {
    const values = parameter.values.map((value, k) => {
      const doubtful = (parameter.warnings[k]?.length ?? 0) > 0;
      return h("td", { class: "n" }, value ? `${digits(value.value, value.std)}${doubtful ? " *" : ""}` : "–");
    });
    const differences = parameter.differences.map((difference) => {
      if (!difference) return h("td", { class: "n" }, "–");
      const part = difference.relative === null ? "" : `${signed(100 * difference.relative)} %`;
      const errors = difference.standard_errors === null ? "" : ` (${signed(difference.standard_errors)} s.e.)`;
      return h("td", { class: difference.clear ? "n clear" : "n" }, part + errors);
    });
    return h("tr", {}, h("th", { scope: "row" }, parameter.name), h("td", {}, parameter.unit), ...values, ...differences);
  });
  const headings = head.map((text) => h("th", { scope: "col" }, text));
  return h(
    "div",
    { class: "wide", tabindex: 0, role: "group", "aria-label": "Comparison" },
    h("table", { id: "comparison" }, h("thead", {}, h("tr", {}, ...headings)), h("tbody", {}, ...rows)),
    h("p", { class: "why" }, "s.e.: standard errors. * a finding makes it doubtful."),
  );
}

function signed(value: number): string {
  const text = Number(value.toPrecision(3)).toString().replace("-", "−");
  return value > 0 ? `+${text}` : text;
}

/** A value to two digits of its standard error. */
function digits(value: number, std: number): string {
  const least = std > 0 ? Math.floor(Math.log10(std)) - 1 : Math.floor(Math.log10(Math.abs(value) || 1)) - 5;
  const count = Math.max(1, Math.floor(Math.log10(Math.abs(value) || 1)) - least + 1);
  return `${Number(value.toPrecision(Math.min(count, 15)))} ± ${Number(std.toPrecision(2))}`.replaceAll("-", "−");
}

function title(result: Result): string {
  const made = new Date(1000 * result.made_s).toLocaleString();
  const found = [result.warnings > 0 ? counted(result.warnings, "warning") : "", result.refusals > 0 ? counted(result.refusals, "refusal") : ""];
  const parts = [result.name, counted(result.runs, "run"), result.effort, ...found.filter(Boolean), ...(result.interrupted ? ["stopped early"] : []), made];
  return `${result.id}: ${parts.join(", ")}`;
}
