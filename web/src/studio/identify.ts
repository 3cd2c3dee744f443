// Starts an identification, shows its progress, and stops it.

import { get, send } from "./api";
import { button, h, put, seconds } from "./dom";
import type { Store } from "./store";
import type { Job, Setup } from "./types";

const POLL_MS = 250;

export class Identify {
  readonly element = h("section", { "aria-label": "Identification", class: "identify" });
  private readonly progress = h("div", { "aria-live": "polite" });
  private job: Job | null = null;
  private polling = false;
  private starting = false;
  private stopping = false;
  /** The revision of the session in which the job ended. */
  private ended = 0;

  /** `done` is called with the number of a new result. */
  constructor(
    private readonly store: Store,
    private readonly done: (result: number) => void,
  ) {}

  render(): void {
    const { logs, setup, campaign, job } = this.store.state;
    if (job && !job.finished && !this.polling) {
      this.job = job;
      void this.poll();
    }
    const runs = this.starting || (this.job !== null && !this.job.finished);
    if (logs.length === 0 && !runs) {
      put(this.element);
      return;
    }
    const start = button("Identify", () => void this.start(), { id: "identify", class: "main", disabled: runs || campaign.problems.length > 0 });
    const missing = campaign.problems.map(({ error, hint }) => h("li", {}, error, hint ? h("span", { class: "why" }, ` ${hint}`) : null));
    const needed = missing.length > 0 ? h("div", { class: "missing-list" }, h("p", {}, "Before it can be identified:"), h("ul", { id: "missing" }, ...missing)) : null;
    put(this.element, h("h2", {}, "Identify"), needed, h("div", { class: "row" }, this.effort(setup), start), this.progress);
    this.renderProgress();
  }

  private effort(setup: Setup): HTMLElement {
    const select = h("select", { id: "effort", "aria-label": "effort" });
    select.append(new Option("quick: without a search", "quick"), new Option("normal: a search of about 10 s", "normal"), new Option("thorough: minutes", "thorough"));
    select.value = setup.effort;
    select.addEventListener("change", () => void this.store.say((to) => (to.effort = select.value as Setup["effort"])));
    return select;
  }

  /** Shows the progress of a job that has begun, and its result. */
  follow(job: Job): void {
    this.job = job;
    if (!this.polling) void this.poll();
  }

  /** Shows the progress of what runs, or why it failed, in another place. */
  renderProgressIn(place: Element): void {
    const shown = this.job !== null && (!this.job.finished || this.job.problem !== null);
    if (!shown) put(place);
    else if (this.progress.parentElement !== place) put(place, this.progress);
    this.renderProgress();
  }

  private async start(): Promise<void> {
    if (this.starting) return;
    this.starting = true;
    this.render();
    await this.store.settled();
    const started = await this.store.during("", async () => {
      this.job = await send<Job>("POST", "/api/job", { revision: this.store.state.revision });
    });
    this.starting = false;
    if (started) await this.poll();
    else this.render();
  }

  private async poll(): Promise<void> {
    this.polling = true;
    this.store.changed();
    while (this.job && !this.job.finished) {
      await new Promise((resolve) => setTimeout(resolve, POLL_MS));
      try {
        this.job = await get<Job>("/api/job");
      } catch (error) {
        this.polling = false;
        this.job = null;
        this.store.fail(error);
        return;
      }
      if (this.job.finished) this.ended = this.store.state.revision;
      this.renderProgress();
    }
    [this.polling, this.stopping] = [false, false];
    const result = this.job?.result ?? null;
    await this.store.load();
    if (result !== null) this.done(result);
  }

  private stop(): void {
    this.stopping = true;
    this.renderProgress();
    void this.store.during("", async () => {
      this.job = await send<Job>("DELETE", "/api/job");
    });
  }

  private renderProgress(): void {
    const { job } = this;
    if (!job) {
      put(this.progress);
      return;
    }
    // What ended before a change says nothing about what is there now.
    if (job.finished && this.store.state.revision !== this.ended) {
      this.job = null;
      put(this.progress);
      return;
    }
    if (job.finished) {
      const words = job.problem ? job.problem.error : "Done: see Results.";
      const hint = job.problem?.hint ? h("p", { class: "why" }, job.problem.hint) : null;
      put(this.progress, h("p", job.problem ? { class: "wrong", id: "outcome" } : { id: "outcome" }, words), hint);
      return;
    }
    const bar = h("progress", { max: 1, "aria-label": "progress", ...(job.done === null ? {} : { value: job.done }) });
    const left = job.at_most_s === null ? "" : `, at most ${seconds(job.at_most_s)} more`;
    const known = h("span", { id: "step" }, `${job.step}, ${seconds(job.elapsed_s)}${left}`);
    const stop = button(this.stopping ? "Stopping…" : "Stop with the best so far", () => this.stop(), { id: "stop", disabled: this.stopping });
    const rows = job.first.map(({ name, value, unit }) => h("tr", {}, h("td", {}, name), h("td", { class: "n" }, value), h("td", {}, unit)));
    const table = rows.length > 0 ? h("table", { class: "first" }, h("caption", {}, "First result, without the search"), h("tbody", {}, ...rows)) : null;
    put(this.progress, h("div", { class: "row" }, bar, known, stop), table);
  }
}
