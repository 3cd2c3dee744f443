// The data of a figure, as `FigureData` of lissom-report gives it.

export interface AxisData {
  readonly label: string;
  readonly scale: "linear" | "log";
  readonly quantity: "plain" | "frequency" | "decibels" | "degrees";
  readonly range: readonly [number, number] | null;
}

/** A line over regular abscissae. */
export interface Packed {
  readonly from: number;
  readonly step: number;
  readonly low: number;
  readonly high: number;
  /** 16-bit numbers, low byte first, in Base64; 65535 for a missing one. */
  readonly y: string;
}

/** A trace as the page has it. */
export interface StoredTrace extends Omit<TraceData, "x" | "y"> {
  readonly x?: readonly number[];
  readonly y?: readonly (number | null)[];
  readonly packed?: Packed;
}

export interface StoredPanel extends Omit<PanelData, "traces"> {
  readonly traces: readonly StoredTrace[];
}

/** A figure as the page has it. */
export interface StoredFigure extends Omit<FigureData, "panels"> {
  readonly panels: readonly StoredPanel[];
}

/** Figures of which the reader chooses one. */
export interface StoredChoices {
  readonly choose: string;
  readonly all: readonly { readonly name: string; readonly figure: StoredFigure }[];
}

export interface TraceData {
  readonly label: string;
  readonly role: string;
  readonly style: "line" | "dashes" | "steps" | "points" | "columns";
  readonly x: readonly number[];
  /** A line stops where one is missing. */
  readonly y: readonly (number | null)[];
  readonly low?: readonly (number | null)[];
  readonly high?: readonly (number | null)[];
  /** Ends of error bars of the abscissae. */
  readonly left?: readonly (number | null)[];
  readonly right?: readonly (number | null)[];
  /** Places of points with which something is wrong. */
  readonly flagged?: readonly number[];
  /** Number of points before some were left out. */
  readonly points?: number;
}

export interface BandData {
  readonly label: string;
  readonly role: string;
  readonly middle: number;
  readonly low: number;
  readonly high: number;
}

export interface RegionData {
  readonly label: string;
  readonly role: string;
  readonly from: number;
  readonly to: number;
}

export interface PanelData {
  readonly y: AxisData;
  readonly traces: readonly TraceData[];
  readonly bands: readonly BandData[];
  readonly regions: readonly RegionData[];
}

export interface FigureData {
  readonly title: string;
  readonly subtitle: string | null;
  readonly x: AxisData;
  /** Figures with the same name here show the same part of the horizontal axis. */
  readonly linked?: string;
  readonly panels: readonly PanelData[];
  readonly skipped: number;
}

const MISSING = 65535;

function ordinates(packed: Packed): (number | null)[] {
  const bytes = atob(packed.y);
  const scale = (packed.high - packed.low) / (MISSING - 1);
  const found: (number | null)[] = [];
  for (let k = 0; k + 1 < bytes.length; k += 2) {
    const value = bytes.charCodeAt(k) + 256 * bytes.charCodeAt(k + 1);
    found.push(value === MISSING ? null : packed.low + scale * value);
  }
  return found;
}

/** A figure with all of its points. */
export function unpacked(stored: StoredFigure): FigureData {
  const trace = ({ packed, x, y, ...rest }: StoredTrace): TraceData => {
    if (!packed) return { ...rest, x: x ?? [], y: y ?? [] };
    const values = ordinates(packed);
    return { ...rest, x: values.map((_, k) => packed.from + k * packed.step), y: values };
  };
  return { ...stored, panels: stored.panels.map((panel) => ({ ...panel, traces: panel.traces.map(trace) })) };
}
