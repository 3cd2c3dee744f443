// The data of a figure, as `FigureData` of lissom-report gives it.

export interface AxisData {
  readonly label: string;
  readonly scale: "linear" | "log";
  readonly quantity: "plain" | "frequency" | "decibels" | "degrees";
  readonly range: readonly [number, number] | null;
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
  readonly panels: readonly PanelData[];
  readonly skipped: number;
}
