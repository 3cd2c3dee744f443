// The session as the server has it, and changes of it.

import { Refused, get, send } from "./api";
import type { Problem, Setup, State } from "./types";

type Change = (setup: Setup) => void;

/** The words of anything that was thrown. */
function problemOf(error: unknown): Problem {
  return error instanceof Refused ? error.problem : { error: String(error) };
}

export class Store {
  private known: State | null = null;
  /** The session as the server has it: without what is unsent. */
  private confirmed: State | null = null;
  private readonly listeners: (() => void)[] = [];
  private changes: Promise<void> = Promise.resolve();
  /** Changes that the server has not got. */
  private unsent: Change[] = [];
  problem: Problem | null = null;
  busy = "";

  get state(): State {
    if (!this.known) throw new Error("no state");
    return this.known;
  }

  get isReady(): boolean {
    return this.known !== null;
  }

  listen(listener: () => void): void {
    this.listeners.push(listener);
  }

  changed(): void {
    for (const listener of this.listeners) listener();
  }

  take(state: State): void {
    for (const channels of state.logs.map(({ log }) => log?.channels ?? [])) {
      for (const channel of channels) {
        const isOnly = channel.name !== "" && channels.every((other) => other === channel || other.name !== channel.name);
        channel.asked = isOnly ? channel.name : String(channel.number);
      }
    }
    [this.known, this.confirmed] = [state, state];
  }

  async load(): Promise<void> {
    await this.during("", async () => this.take(await get<State>("/api/state")));
  }

  /** Does something that may fail; the page shows why. */
  async during(what: string, action: () => Promise<void>): Promise<boolean> {
    this.busy = what;
    this.problem = null;
    if (what) this.changed();
    let done = true;
    try {
      await action();
    } catch (error) {
      done = false;
      this.problem = problemOf(error);
      // Another page has changed the session: this one shows what is there now.
      if (error instanceof Refused && error.status === 409) {
        try {
          this.take(await get<State>("/api/state"));
        } catch {
          // The first problem says enough.
        }
      }
    }
    this.busy = "";
    this.changed();
    return done;
  }

  /** Shows an error. */
  fail(error: unknown): void {
    this.problem = problemOf(error);
    this.changed();
  }

  /** Loads the session again if another page has changed it. */
  async refresh(): Promise<void> {
    if (!this.isReady || this.busy || this.unsent.length > 0) return;
    const state = await get<State>("/api/state");
    if (state.revision === this.state.revision && state.results.length === this.state.results.length) return;
    this.take(state);
    this.changed();
  }

  /** Changes what is said about the logs, after the changes that are on their way. */
  say(change: Change): Promise<void> {
    this.unsent.push(change);
    return this.sendAll();
  }

  /** Sends the changes that the server has not got. */
  sendAll(): Promise<void> {
    this.changes = this.changes.then(() => this.sendNow());
    return this.changes;
  }

  /** Whether changes wait for a server that does not answer. */
  get waits(): boolean {
    return this.unsent.length > 0 && this.problem !== null;
  }

  /** Waits for the changes that are on their way. */
  settled(): Promise<void> {
    return this.changes;
  }

  private async sendNow(): Promise<void> {
    const changes = [...this.unsent];
    if (changes.length === 0) return;
    const setup = structuredClone((this.confirmed ?? this.state).setup);
    for (const change of changes) change(setup);
    await this.during("", async () => {
      try {
        this.take(await send<State>("PUT", "/api/setup", { revision: this.state.revision, setup }));
      } catch (error) {
        // What was not refused is sent again when the reader asks for it; until then the page shows it.
        if (error instanceof Refused && error.status === 0) this.known = { ...this.state, setup };
        else this.unsent = this.unsent.filter((change) => !changes.includes(change));
        throw error;
      }
      this.unsent = this.unsent.filter((change) => !changes.includes(change));
    });
  }
}
