// Results: the report of one, its files, and the comparison of several.

import { enlivenReport } from "../report";
import { getFile, getText, send } from "./api";
import { button, confirmed, counted, h, put } from "./dom";
import type { Store } from "./store";
import type { Result, State } from "./types";

const FILE_WORDS: Record<string, string> = {
  "report.html": "report page",
  "result.json": "all numbers",
  "campaign.toml": "description of the logs",
  "plan.toml": "the planned runs",
  "arm.toml": "the arm, for plans and virtual experiments",
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
    const remove = confirmed("Remove", () => void this.remove(result), { id: "remove-result" });
    put(this.element, h("div", { class: "row" }, select, again, remove), this.files(result), this.report);
    if (isNew) void this.load(result);
  }

  private async load(result: Result): Promise<void> {
    this.report.dataset["id"] = String(result.id);
    put(this.report, h("p", {}, "…"));
    const done = await this.store.during("", async () => {
      const text = await getText(`/api/results/${result.id}/report`);
      if (this.shown !== result.id) return;
      // The server has escaped all text of logs; the policy of this page runs no script of it either.
      this.report.innerHTML = text;
      enlivenReport(this.report);
    });
    if (!done) put(this.report, h("p", {}, "The report is not here. "), button("Load it again", () => void this.load(result)));
  }

  private files(result: Result): HTMLElement {
    const effort = result.effort === "normal" ? "" : ` --effort ${result.effort}`;
    const identify = (campaign: string) => `lissom identify ${campaign}${effort} --report report.html --json result.json`;
    // The rig writes the logs of a plan, and their campaign.toml.
    const simulate = "lissom rig arm.toml --campaign plan.toml --out virtual";
    const command = result.planned ? `${simulate} && ${identify("virtual/campaign.toml")}` : identify("campaign.toml");
    const beside = result.planned ? "plan.toml and the arm.toml that it was planned for" : "campaign.toml beside the logs";
    const links = result.files.map((name) =>
      h("li", {}, button(name, () => void this.save(result, name), { id: `file-${name}` }), ` ${FILE_WORDS[name] ?? ""}`),
    );
    return h(
      "details",
      { class: "files-of" },
      h("summary", {}, "Save files"),
      h("ul", {}, ...links),
      h("p", {}, `The same from the command line, with ${beside}: `, h("code", { id: "command-line" }, command)),
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
    if (this.chosen.length === 0) this.chosen = results.slice(-2).map(({ id }) => id);
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
    put(this.place, ...(this.chosen.length < 2 ? [h("p", {}, "Choose two or more.")] : []));
    if (this.chosen.length >= 2) void this.load(key);
  }

  private async load(key: string): Promise<void> {
    await this.store.during("", async () => {
      const text = await getText(`/api/compare?results=${key}`);
      if (key !== this.key) return;
      const page = h("div", { id: "comparison", class: "report" });
      // The server has escaped all text, as in a report.
      page.innerHTML = text;
      put(this.place, ...this.changes(), page);
      enlivenReport(page);
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
    const values = (key: string) => {
      const all = [first, ...others].map(({ setup }) => setup[key as keyof Result["setup"]] ?? "none");
      const isShort = all.every((value) => typeof value !== "object");
      return `${key.replaceAll("_", " ")}${isShort ? ` (${all.join(" → ")})` : ""}`;
    };
    const words = differ.length > 0 ? `Settings that differ: ${differ.map(values).join(", ")}.` : "The settings are the same.";
    const same = " Results of the same logs share their noise: differences are then smaller than their standard errors say.";
    return [h("p", {}, words + same)];
  }
}

function title(result: Result): string {
  const made = new Date(1000 * result.made_s).toLocaleString();
  const found = [result.warnings > 0 ? counted(result.warnings, "warning") : "", result.refusals > 0 ? counted(result.refusals, "refusal") : ""];
  const parts = [result.name, counted(result.runs, "run"), result.effort, ...found.filter(Boolean), ...(result.interrupted ? ["stopped early"] : []), made];
  return `${result.id}: ${parts.join(", ")}`;
}
