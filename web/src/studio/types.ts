// What the server sends and takes; see lissom-studio.

export interface Problem {
  readonly error: string;
  readonly hint?: string;
}

export interface Channel {
  /** How it is named to the server: by its name if no other one has it. */
  asked: string;
  readonly number: number;
  readonly name: string;
  readonly unit: string | null;
  readonly values: number;
  readonly missing: number;
  readonly min: number | null;
  readonly max: number | null;
  readonly constant: boolean;
}

export interface InspectedLog {
  readonly format: string;
  readonly clock: { readonly step: number; readonly gaps: number; readonly length: number } | null;
  readonly channels: readonly Channel[];
  readonly roles: readonly { readonly role: string; readonly channel: number; readonly why: string }[];
  readonly notes: readonly string[];
}

export interface LogView {
  readonly id: number;
  readonly name: string;
  readonly kind: "log" | "campaign" | "other";
  readonly used: boolean;
  readonly log: InspectedLog | null;
  /** Seconds for one unit of its time stamps, or for one row; none if that is not known. */
  readonly stamp_s: number | null;
  /** What its runs are known by, if each can be a log of its own. */
  readonly runs_by: string | null;
  /** Whether it is one run of its file. */
  readonly is_run: boolean;
  readonly problem: Problem | null;
}

export interface Pick {
  column: string;
  unit: string;
  scale: string;
  quantity: string;
  radius: string;
}

export type CommandKind = "current" | "voltage" | "torque" | "goal";

export interface Trim {
  log: number;
  skip: string;
  until: string;
  leave_out: [string, string][];
}

export interface Setup {
  time: Pick | null;
  sample_time: string;
  run: string;
  header_row: number | null;
  skip_rows: number;
  command: { kind: CommandKind; channel: Pick } | null;
  hold: string;
  motor: Pick | null;
  speed: Pick | null;
  tips: Pick[];
  torque_constant: string;
  resistance: string;
  back_emf: string;
  gear_ratio: string;
  gravity: boolean;
  mgl: string;
  skip: string;
  window: string;
  effort: "quick" | "normal" | "thorough";
  left_out: number[];
  trims: Trim[];
}

export interface Job {
  readonly step: string;
  readonly done: number | null;
  readonly elapsed_s: number;
  readonly at_most_s: number | null;
  readonly first: readonly { readonly name: string; readonly value: string; readonly unit: string }[];
  readonly finished: boolean;
  readonly result: number | null;
  readonly problem: Problem | null;
}

export interface Result {
  readonly id: number;
  readonly name: string;
  readonly made_s: number;
  readonly effort: string;
  readonly runs: number;
  readonly warnings: number;
  readonly refusals: number;
  readonly interrupted: boolean;
  readonly planned: boolean;
  readonly files: readonly string[];
  readonly setup: Setup;
}

export interface State {
  readonly version: string;
  readonly folder: string;
  readonly revision: number;
  readonly logs: readonly LogView[];
  readonly setup: Setup;
  readonly campaign: {
    readonly text: string;
    readonly given: boolean;
    readonly problems: readonly Problem[];
  };
  readonly job: Job | null;
  readonly results: readonly Result[];
}

export interface Trace {
  readonly x_label: string;
  readonly x: readonly number[];
  readonly y: readonly (number | null)[];
  /** Number of samples of what is shown. */
  readonly samples: number;
}

export interface PlanView {
  readonly text: string;
  readonly time_s: number;
  readonly runs: readonly string[];
  readonly expected: readonly { readonly name: string; readonly expected: string; readonly wanted: string; readonly reached: boolean }[];
  readonly notes: readonly string[];
}
