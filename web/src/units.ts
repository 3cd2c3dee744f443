// Units that a reader can choose: rad/s or Hz, dB or ratio, phase continuous or within half a turn.

import type { AxisData, PanelData, TraceData } from "./figure_data";

export interface Units {
  frequency: "rad/s" | "Hz";
  magnitude: "dB" | "ratio";
  phase: "continuous" | "wrapped";
}

type Listener = () => void;

/** The units of all figures of a page. */
export class UnitChoice {
  readonly units: Units = { frequency: "rad/s", magnitude: "dB", phase: "continuous" };
  private readonly listeners = new Set<Listener>();

  /** Calls `listener` after every choice, until the function that is given is called. */
  listen(listener: Listener): () => void {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }

  choose<K extends keyof Units>(key: K, value: Units[K]): void {
    this.units[key] = value;
    for (const listener of this.listeners) listener();
  }
}

export interface ShownAxis {
  readonly label: string;
  readonly log: boolean;
  readonly range: readonly [number, number] | null;
}

const TURN = 2 * Math.PI;

function converter(axis: AxisData, units: Units): (value: number) => number {
  if (axis.quantity === "frequency" && units.frequency === "Hz") return (value) => value / TURN;
  if (axis.quantity === "decibels" && units.magnitude === "ratio") return (value) => 10 ** (value / 20);
  return (value) => value;
}

/** An axis in the chosen units. */
export function shownAxis(axis: AxisData, units: Units): ShownAxis {
  const convert = converter(axis, units);
  const range: readonly [number, number] | null = axis.range && [convert(axis.range[0]), convert(axis.range[1])];
  const log = axis.scale === "log";
  if (axis.quantity === "frequency" && units.frequency === "Hz") {
    return { label: axis.label.replace("rad/s", "Hz"), log, range };
  }
  if (axis.quantity === "decibels" && units.magnitude === "ratio") {
    const label = axis.label.replace("dB re 1 ", "").replace(" (dB)", "");
    return { label, log: true, range };
  }
  return { label: axis.label, log, range };
}

/** A trace in the chosen units. */
export interface ShownTrace {
  readonly of: TraceData;
  readonly x: readonly number[];
  readonly y: readonly (number | null)[];
  readonly low: readonly (number | null)[];
  readonly high: readonly (number | null)[];
  readonly left: readonly (number | null)[];
  readonly right: readonly (number | null)[];
  readonly flagged: ReadonlySet<number>;
  /** Whether the abscissae do not fall. */
  readonly rises: boolean;
}

/** Degrees from −180 up to 180. */
function wrapped(degrees: number): number {
  return degrees - 360 * Math.floor((degrees + 180) / 360);
}

export function shownTrace(trace: TraceData, x: AxisData, panel: PanelData, units: Units): ShownTrace {
  const ofX = converter(x, units);
  const ofY = converter(panel.y, units);
  const each = (values: readonly (number | null)[] | undefined) =>
    (values ?? []).map((value) => (value === null ? null : ofY(value)));
  const across = (values: readonly (number | null)[] | undefined) =>
    (values ?? []).map((value) => (value === null ? null : ofX(value)));
  let xs: number[] = trace.x.map(ofX);
  let ys = each(trace.y);
  let [lows, highs] = [each(trace.low), each(trace.high)];
  let flagged = [...(trace.flagged ?? [])];
  if (panel.y.quantity === "degrees" && units.phase === "wrapped") {
    const shift = ys.map((y) => (y === null ? 0 : wrapped(y) - y));
    const moved = (values: (number | null)[]) => values.map((v, k) => (v === null ? null : v + (shift[k] ?? 0)));
    [ys, lows, highs] = [moved(ys), moved(lows), moved(highs)];
    if (trace.style === "line" || trace.style === "dashes") {
      // A line stops where it leaves the range.
      const broken: [number[], (number | null)[]] = [[], []];
      ys.forEach((y, k) => {
        const before = k > 0 ? shift[k - 1] : undefined;
        if (before !== undefined && Math.abs(before - (shift[k] ?? 0)) > 1) {
          broken[0].push(xs[k] ?? 0);
          broken[1].push(null);
        }
        broken[0].push(xs[k] ?? 0);
        broken[1].push(y);
      });
      [xs, ys] = broken;
      [lows, highs, flagged] = [[], [], []];
    }
  }
  const rises = xs.every((value, k) => k === 0 || value >= (xs[k - 1] ?? value));
  const [left, right] = [across(trace.left), across(trace.right)];
  return { of: trace, x: xs, y: ys, low: lows, high: highs, left, right, flagged: new Set(flagged), rises };
}

/** What is in the last parentheses of a label. */
export function unitOf(label: string): string {
  return /\(([^()]*)\)\s*$/.exec(label)?.[1] ?? "";
}

/** A number with four digits. */
export function digits(value: number): string {
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size < 1e5 && size >= 1e-3) return String(Number(value.toPrecision(4))).replace("-", "−");
  const [mantissa, power] = value.toExponential(3).split("e");
  return `${Number(mantissa)}e${Number(power)}`.replaceAll("-", "−");
}
