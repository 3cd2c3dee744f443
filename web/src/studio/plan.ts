// The next experiment: planned with the arm that was found, and tried on the virtual rig.

import { getText, send } from "./api";
import { button, counted, h, put, seconds } from "./dom";
import type { Identify } from "./identify";
import type { Store } from "./store";
import type { Job, PlanView } from "./types";

/** Where the arm of a result is kept that the reader has edited. */
function edited(result: number): string {
  return `lissom-arm-${result}`;
}

export class Plan {
  readonly element = h("section", { "aria-label": "Plan" });
  private readonly place = h("div");
  private readonly arm = h("textarea", { id: "arm", rows: 18, spellcheck: "false", "aria-label": "arm.toml", wrap: "off" });
  private readonly precision = h("input", { id: "precision", type: "text", placeholder: "e.g. 1%" });
  private readonly within = h("input", { id: "within", type: "text", value: "5 min" });
  private chosen = 0;
  private key = "";
  private readonly tried = h("div", { "aria-live": "polite" });
  private plan: PlanView | null = null;

  constructor(
    private readonly store: Store,
    private readonly identify: Identify,
  ) {
    // A plan is for the arm that it was made for.
    for (const input of [this.arm, this.precision, this.within]) {
      input.addEventListener("input", () => {
        this.plan = null;
        this.renderPlan();
      });
    }
    this.arm.addEventListener("input", () => sessionStorage.setItem(edited(this.chosen), this.arm.value));
  }

  render(): void {
    const { results } = this.store.state;
    const result = results.find(({ id }) => id === this.chosen) ?? results.at(-1);
    if (!result) {
      put(this.element, h("p", {}, "A plan needs an arm: identify one first."));
      this.key = "";
      return;
    }
    const key = JSON.stringify([results.map(({ id }) => id), result.id]);
    if (key !== this.key) {
      this.key = key;
      if (this.chosen !== result.id) void this.load(result.id);
      this.chosen = result.id;
      this.build();
    }
    this.identify.renderProgressIn(this.tried);
  }

  private build(): void {
    const select = h("select", { id: "plan-of", "aria-label": "result" });
    for (const { id, name } of [...this.store.state.results].reverse()) select.append(new Option(`${id}: ${name}`, String(id)));
    select.value = String(this.chosen);
    select.addEventListener("change", () => {
      this.chosen = Number(select.value);
      this.plan = null;
      this.renderPlan();
      void this.load(this.chosen);
    });
    const field = (name: string, input: HTMLElement) => h("div", { class: "field" }, h("label", { for: input.id }, name), input);
    put(
      this.element,
      h("h2", {}, "Plan the next experiment"),
      h("p", {}, "Runs that reach a wanted precision in the least time, for the arm of a result. Numbers of the rig may be changed."),
      h("div", { class: "row" }, h("label", { for: "plan-of" }, "Arm of result"), select),
      this.arm,
      h("div", { class: "form" }, field("Standard error of each parameter", this.precision), field("Time of all runs", this.within)),
      h("div", { class: "row" }, button("Plan", () => void this.make(), { id: "plan", class: "main" })),
      this.place,
      this.tried,
    );
    this.renderPlan();
  }

  private async load(id: number): Promise<void> {
    this.arm.value = sessionStorage.getItem(edited(id)) ?? "";
    const isThere =
      this.arm.value !== "" ||
      (await this.store.during("", async () => {
        this.arm.value = await getText(`/api/results/${id}/files/arm.toml`);
      }));
    // Without an arm there is nothing to plan; the message says why.
    document.getElementById("plan")?.toggleAttribute("disabled", !isThere);
  }

  private async make(): Promise<void> {
    await this.store.during("simulating motions", async () => {
      const wanted = { arm: this.arm.value, precision: this.precision.value.trim(), within: this.within.value.trim() };
      this.plan = await send<PlanView>("POST", "/api/plan", wanted);
    });
    this.renderPlan();
  }

  private async tryIt(): Promise<void> {
    const started = await this.store.during("", async () => {
      this.identify.follow(await send<Job>("POST", "/api/virtual"));
    });
    if (started) this.store.changed();
  }

  private renderPlan(): void {
    const { plan } = this;
    if (!plan) {
      put(this.place);
      return;
    }
    const head = ["standard error of", "expected", "wanted"].map((text) => h("th", { scope: "col" }, text));
    const rows = plan.expected.map(({ name, expected, wanted, reached }) =>
      h("tr", {}, h("td", {}, name), h("td", { class: reached ? "n" : "n wrong" }, expected), h("td", { class: "n" }, wanted)),
    );
    put(
      this.place,
      h("h3", {}, `${counted(plan.runs.length, "run")} in ${seconds(plan.time_s)}`),
      h("ol", { id: "runs" }, ...plan.runs.map((run) => h("li", {}, run))),
      h("table", { id: "expected" }, h("thead", {}, h("tr", {}, ...head)), h("tbody", {}, ...rows)),
      plan.notes.length > 0 ? h("ul", { class: "notes" }, ...plan.notes.map((note) => h("li", {}, note))) : null,
      h("details", {}, h("summary", {}, "plan.toml"), h("pre", { tabindex: 0, role: "group", "aria-label": "plan.toml" }, plan.text)),
      h("div", { class: "row" }, button("Try it on the virtual rig", () => void this.tryIt(), { id: "try" })),
    );
  }
}
