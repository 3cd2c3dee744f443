// The session as the server has it, and changes of it.

import { Refused, get, send } from "./api";
import type { Problem, Setup, State } from "./types";

export class Store {
  private known: State | null = null;
  private readonly listeners: (() => void)[] = [];
  private changes: Promise<void> = Promise.resolve();
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
    this.known = state;
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
      this.problem = error instanceof Refused ? error.problem : { error: String(error) };
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

  /** Changes what is said about the logs, after the changes that are on their way. */
  say(change: (setup: Setup) => void): Promise<void> {
    this.changes = this.changes.then(() => this.sayNow(change));
    return this.changes;
  }

  /** Waits for the changes that are on their way. */
  settled(): Promise<void> {
    return this.changes;
  }

  private async sayNow(change: (setup: Setup) => void): Promise<void> {
    const setup = structuredClone(this.state.setup);
    change(setup);
    await this.during("", async () => {
      this.take(await send<State>("PUT", "/api/setup", { revision: this.state.revision, setup }));
    });
  }
}
