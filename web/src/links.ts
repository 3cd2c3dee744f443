// Figures whose horizontal axes move together.

import type { Range } from "./range";
import type { UnitChoice } from "./units";

/** A figure that shows what another one shows. */
export interface Follower {
  /** Shows a part of the horizontal axis, or with null all of it. */
  follow(range: Range | null): void;
}

export class Links {
  private readonly followers = new Map<string, Set<Follower>>();
  /** What was shown last by the figures of each name. */
  private readonly shown = new Map<string, Range | null>();

  constructor(choice: UnitChoice) {
    // Ranges are in the units of the axes.
    choice.listen(() => this.shown.clear());
  }

  /** Adds a figure, until the function that is given is called. */
  join(name: string, figure: Follower): () => void {
    const all = this.followers.get(name) ?? new Set();
    this.followers.set(name, all.add(figure));
    return () => all.delete(figure);
  }

  /** What the figures of this name show; null if that is all. */
  shownBy(name: string): Range | null {
    return this.shown.get(name) ?? null;
  }

  /** A figure shows another part of its axis. */
  moved(name: string, by: Follower, range: Range | null): void {
    this.shown.set(name, range);
    for (const figure of this.followers.get(name) ?? []) if (figure !== by) figure.follow(range);
  }
}
