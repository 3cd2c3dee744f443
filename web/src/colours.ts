// Colours of figures, from the style sheet of the page, which has a light and a dark set.

export interface Colours {
  readonly ink: string;
  readonly faint: string;
  readonly grid: string;
  readonly paper: string;
  readonly flagged: string;
  of(role: string): string;
}

export function colours(): Colours {
  const style = getComputedStyle(document.documentElement);
  const read = (name: string, otherwise: string) => style.getPropertyValue(`--${name}`).trim() || otherwise;
  const ink = read("ink", "#1a1a1a");
  return {
    ink,
    faint: read("faint", "#595959"),
    grid: read("grid", "#e2e2e2"),
    paper: read("paper", "#fff"),
    flagged: read("flagged", "#8a8a8a"),
    of: (role) => read(`role-${role}`, ink),
  };
}

const DASHES: Readonly<Record<string, readonly number[]>> = {
  truth: [8, 4],
  other1: [2, 3],
  other2: [10, 3, 2, 3],
  other3: [5, 3],
};

/** The dash of a line, in pixels of the page. */
export function dashOf(role: string, style: string): readonly number[] {
  return style === "dashes" ? [6, 4] : (DASHES[role] ?? []);
}

export type Marker = "circle" | "square" | "diamond" | "up" | "down" | "cross" | "ring";

const MARKERS: Readonly<Record<string, Marker>> = {
  raw: "square",
  corrected: "circle",
  fitted: "diamond",
  truth: "up",
  pole: "cross",
  zero: "ring",
  other0: "down",
  other1: "diamond",
  other2: "up",
  other3: "circle",
};

export function markerOf(role: string): Marker {
  return MARKERS[role] ?? "circle";
}

/** Adds the outline of a marker of about radius `r` to the path. */
export function outline(ctx: CanvasRenderingContext2D, marker: Marker, x: number, y: number, r: number): void {
  if (marker === "circle" || marker === "ring") {
    ctx.moveTo(x + r, y);
    ctx.arc(x, y, r, 0, 2 * Math.PI);
    return;
  }
  const side = 0.88 * r;
  const tip = 1.2 * r;
  const [arm, width] = [1.1 * r, 0.42 * r];
  const corners: Record<Exclude<Marker, "circle" | "ring">, readonly (readonly [number, number])[]> = {
    square: [
      [-side, -side],
      [side, -side],
      [side, side],
      [-side, side],
    ],
    diamond: [
      [0, -tip],
      [tip, 0],
      [0, tip],
      [-tip, 0],
    ],
    up: [
      [0, -tip],
      [1.1 * r, 0.8 * r],
      [-1.1 * r, 0.8 * r],
    ],
    cross: [
      [-arm, width - arm],
      [width - arm, -arm],
      [0, -width],
      [arm - width, -arm],
      [arm, width - arm],
      [width, 0],
      [arm, arm - width],
      [arm - width, arm],
      [0, width],
      [width - arm, arm],
      [-arm, arm - width],
      [-width, 0],
    ],
    down: [
      [0, tip],
      [1.1 * r, -0.8 * r],
      [-1.1 * r, -0.8 * r],
    ],
  };
  corners[marker].forEach(([dx, dy], k) => (k === 0 ? ctx.moveTo(x + dx, y + dy) : ctx.lineTo(x + dx, y + dy)));
  ctx.closePath();
}
