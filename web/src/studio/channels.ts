// What the channels of the logs are: roles and units by selects, constants of the drive.

import { button, h, put } from "./dom";
import type { Store } from "./store";
import type { Channel, CommandKind, InspectedLog, Pick, Setup } from "./types";

const UNITS: Record<string, readonly string[]> = {
  time: ["s", "ms", "us", "ns", "min"],
  current: ["A", "mA", "1"],
  voltage: ["V", "mV", "1"],
  torque: ["N*m", "mN*m", "N", "1"],
  goal: ["rad", "deg", "m", "mm"],
  motor: ["rad", "deg", "m", "mm", "rpm", "rad/s", "deg/s", "m/s", "mm/s"],
  speed: ["rad/s", "deg/s", "rpm", "m/s", "mm/s"],
  tip: ["rad", "deg", "m", "mm", "m/s^2", "rad/s^2", "1"],
};
const OTHER = "other…";
const EMPTY: Pick = { column: "", unit: "", scale: "", quantity: "", radius: "" };
const SPEEDS = ["rpm", "rad/s", "deg/s", "m/s", "mm/s"];

interface Row {
  readonly id: string;
  readonly label: string;
  readonly role: string;
  readonly pick: Pick | null;
  readonly set: (setup: Setup, pick: Pick | null) => void;
  /** What else belongs to it. */
  readonly more?: readonly HTMLElement[];
}

export class Channels {
  readonly element = h("section", { "aria-label": "Channels" });

  constructor(private readonly store: Store) {}

  render(): void {
    const { logs, setup, campaign } = this.store.state;
    const first = logs.find((log) => log.kind === "log" && log.used && log.log)?.log;
    if (campaign.given || !first) {
      const given = campaign.given
        ? [h("h2", {}, "Channels"), h("p", {}, "The campaign.toml describes the logs."), h("details", {}, h("summary", {}, "campaign.toml"), h("pre", { tabindex: 0, role: "group", "aria-label": "campaign.toml" }, campaign.text))]
        : [];
      put(this.element, ...given);
      return;
    }
    const open = [...this.element.querySelectorAll("details")].map((details) => details.open);
    put(
      this.element,
      h("h2", {}, "Channels"),
      h("div", { class: "form" }, ...this.roles(first, setup)),
      this.constants(setup),
      this.more(first, setup),
      h("details", {}, h("summary", {}, "campaign.toml of this"), h("pre", { tabindex: 0, role: "group", "aria-label": "campaign.toml" }, campaign.text)),
      first.notes.length > 0 ? h("ul", { class: "notes" }, ...first.notes.map((note) => h("li", {}, note))) : null,
    );
    for (const [k, details] of this.element.querySelectorAll("details").entries()) details.open = open[k] ?? false;
  }

  private roles(log: InspectedLog, setup: Setup): HTMLElement[] {
    const kind = setup.command?.kind ?? guessedKind(log);
    const rows: Row[] = [
      { id: "time", label: "Time", role: "time", pick: setup.time, set: (to, pick) => (to.time = pick) },
      {
        id: "command",
        label: "Input of the drive",
        role: kind,
        pick: setup.command?.channel ?? null,
        set: (to, pick) => (to.command = pick && { kind, channel: pick }),
        more: [this.kind(kind, log), this.hold(setup)],
      },
      { id: "motor", label: "Motor", role: "motor", pick: setup.motor, set: (to, pick) => (to.motor = pick && ofMotor(pick)) },
      { id: "speed", label: "Speed of the motor, only compared", role: "speed", pick: setup.speed, set: (to, pick) => (to.speed = pick) },
      ...setup.tips.map((tip, k) => ({
        id: `tip-${k}`,
        label: `Point of the arm ${k + 1}`,
        role: "tip",
        pick: tip,
        set: (to: Setup, pick: Pick | null) => {
          if (pick) to.tips[k] = pick;
          else to.tips.splice(k, 1);
        },
        more: this.tip(tip, k),
      })),
    ];
    const add = button(
      "Add a point of the arm",
      () => void this.store.say((to) => to.tips.push({ ...EMPTY, column: firstFree(log, setup)?.asked ?? "" })),
      { id: "add-tip" },
    );
    return [...rows.map((row) => this.row(row, log)), h("div", { class: "row" }, add)];
  }

  private row(row: Row, log: InspectedLog): HTMLElement {
    const guess = log.roles.find(({ role }) => role === row.role);
    const guessed = guess && log.channels.find(({ number }) => number === guess.channel);
    const found = row.role === "speed" ? "none" : "choose…";
    const none = row.role === "tip" ? "none: remove" : guessed ? `found: ${label(guessed)}` : found;
    const channel = h("select", { id: `${row.id}-channel`, "aria-label": `${row.label}: channel` }, new Option(none, ""));
    for (const each of log.channels) channel.append(new Option(label(each), each.asked));
    const picked = log.channels.find((each) => [each.asked, String(each.number)].includes(row.pick?.column ?? ""));
    channel.value = picked ? picked.asked : "";
    channel.addEventListener("change", () => {
      const chosen = log.channels.find((each) => each.asked === channel.value);
      void this.store.say((setup) => {
        row.set(setup, chosen ? { ...EMPTY, column: chosen.asked, unit: chosen.unit ?? "" } : null);
      });
    });
    const shown = picked ?? (row.role === "speed" ? undefined : guessed);
    const scale = text(`${row.id}-scale`, `${row.label}: factor`, row.pick?.scale ?? "", "factor 1", (value) => {
      void this.store.say((setup) => row.set(setup, { ...pickOf(row, shown), scale: value }));
    });
    const unit = this.unit(row, shown);
    const replaced = row.role === "time" && this.store.state.setup.sample_time !== "";
    const words = replaced ? "not used: a sample time is given below" : !row.pick && guess ? (row.role === "speed" ? "compared if it is the rate of the motor's angle" : guess.why) : "";
    const why = words ? h("span", { class: "why" }, words) : null;
    const parts = shown ? [unit, scale, ...(row.more ?? [])] : [...(row.more ?? [])];
    const name = h("label", { for: `${row.id}-channel` }, row.label);
    return h("div", { class: "field" }, name, h("div", { class: "row" }, channel, ...parts, why));
  }

  private unit(row: Row, channel: Channel | undefined): HTMLElement {
    const stated = channel?.unit ?? "";
    const current = row.pick?.unit || stated;
    const known = UNITS[row.role] ?? [];
    const all = [...new Set([...(stated ? [stated] : []), ...(current ? [current] : []), ...known])];
    const select = h("select", { id: `${row.id}-unit`, "aria-label": `${row.label}: unit` });
    if (!current) select.append(new Option("unit…", ""));
    for (const unit of all) select.append(new Option(unit, unit));
    select.append(new Option(OTHER, OTHER));
    select.value = current;
    const set = (unit: string) => void this.store.say((setup) => row.set(setup, { ...pickOf(row, channel), unit }));
    select.addEventListener("change", () => {
      if (select.value !== OTHER) {
        set(select.value);
        return;
      }
      const other = text(`${row.id}-unit`, `${row.label}: unit`, "", "such as mN*m", set);
      select.replaceWith(other);
      other.addEventListener("blur", () => other.isConnected && other.value === "" && other.replaceWith(select));
      select.value = current;
      other.focus();
    });
    return select;
  }

  private kind(kind: CommandKind, log: InspectedLog): HTMLElement {
    const names: Record<CommandKind, string> = { current: "current", voltage: "voltage", torque: "torque, or unknown", goal: "position reference" };
    const select = h("select", { id: "command-kind", "aria-label": "what the input is" });
    for (const [value, name] of Object.entries(names)) select.append(new Option(name, value));
    select.value = kind;
    select.addEventListener("change", () => {
      const chosen = select.value as CommandKind;
      void this.store.say((setup) => {
        const guess = log.roles.find(({ role }) => role === kind)?.channel;
        const channel = log.channels.find(({ number }) => number === guess) ?? log.channels[0];
        const now = setup.command?.channel ?? { ...EMPTY, column: channel?.asked ?? "" };
        setup.command = { kind: chosen, channel: { ...now, unit: UNITS[chosen]?.[0] ?? "" } };
      });
    });
    return select;
  }

  private hold(setup: Setup): HTMLElement {
    const select = h("select", { id: "hold", "aria-label": "how the input was logged" });
    select.append(new Option("found from the motion", ""), new Option("commanded by the controller", "sampled"), new Option("measured by a sensor", "measured"));
    select.value = setup.hold;
    select.addEventListener("change", () => void this.store.say((to) => (to.hold = select.value)));
    return select;
  }

  private tip(tip: Pick, k: number): HTMLElement[] {
    const quantity = h("select", { id: `tip-${k}-quantity`, "aria-label": `Point of the arm ${k + 1}: quantity` });
    quantity.append(new Option("by its unit", ""), new Option("angle", "angle"), new Option("deflection", "deflection"), new Option("acceleration", "acceleration"));
    quantity.value = tip.quantity;
    quantity.addEventListener("change", () => void this.store.say((to) => ((to.tips[k] as Pick).quantity = quantity.value)));
    const radius = text(`tip-${k}-radius`, `Point of the arm ${k + 1}: distance from the joint`, tip.radius, "distance, e.g. 0.4 m", (value) => {
      void this.store.say((to) => ((to.tips[k] as Pick).radius = value));
    });
    return [quantity, radius];
  }

  /** Fields of one text each. */
  private fields(setup: Setup, fields: readonly (readonly [keyof Setup & string, string, string])[]): HTMLElement[] {
    return fields.map(([key, name, example]) => {
      const input = text(key, name, String(setup[key] ?? ""), example, (value) => {
        void this.store.say((to) => Object.assign(to, { [key]: value }));
      });
      return h("div", { class: "field" }, h("label", { for: key }, name), input);
    });
  }

  private constants(setup: Setup): HTMLElement {
    const fields = this.fields(setup, [
      ["torque_constant", "Torque constant", "0.1 N*m/A"],
      ["resistance", "Resistance", "1.2 ohm"],
      ["back_emf", "Back-EMF constant", "0.1 V*s/rad"],
      ["gear_ratio", "Gear ratio", "50"],
      ["mgl", "Known m·g·l of the load", "2.1 N*m"],
    ]);
    const gravity = h("input", { type: "checkbox", id: "gravity" });
    gravity.checked = setup.gravity;
    gravity.addEventListener("change", () => void this.store.say((to) => (to.gravity = gravity.checked)));
    const label = h("label", { class: "check" }, gravity, "gravity of an unbalanced load acts");
    return h("details", {}, h("summary", {}, "Drive and load, where you know them"), h("div", { class: "form" }, ...fields, label));
  }

  private more(log: InspectedLog, setup: Setup): HTMLElement {
    const fields = this.fields(setup, [
      ["skip", "Beginning of every log to leave out", "1 s"],
      ["sample_time", "Sample time, without time stamps", "1 ms"],
      ["window", "Window of the regression", "0.3 s"],
    ]);
    const number = (key: "header_row" | "skip_rows", name: string) => {
      const input = h("input", { id: key, type: "number", min: key === "skip_rows" ? 0 : 1, value: setup[key] ?? "" });
      input.addEventListener("change", () => {
        const value = Number.parseInt(input.value, 10);
        void this.store.say((to) => {
          if (key === "skip_rows") to.skip_rows = Number.isFinite(value) && value > 0 ? value : 0;
          else to.header_row = Number.isFinite(value) && value > 0 ? value : null;
        });
      });
      return h("div", { class: "field" }, h("label", { for: key }, name), input);
    };
    const run = h("select", { id: "run" }, new Option("none", ""));
    for (const channel of log.channels) run.append(new Option(label(channel), channel.asked));
    run.value = setup.run;
    run.addEventListener("change", () => void this.store.say((to) => (to.run = run.value)));
    const labels = h("div", { class: "field" }, h("label", { for: "run" }, "Column with the run of each row"), run);
    const texts = [number("header_row", "Row with the names of the columns"), number("skip_rows", "Rows at the top to skip")];
    return h("details", {}, h("summary", {}, "How logs are read"), h("div", { class: "form" }, ...fields, labels, ...texts));
  }
}

function text(id: string, name: string, value: string, example: string, set: (value: string) => void): HTMLInputElement {
  const input = h("input", { id, type: "text", value, placeholder: example, "aria-label": name });
  input.addEventListener("change", () => set(input.value.trim()));
  return input;
}

/** The pick of a row, or the one that is found. */
function pickOf(row: Row, channel: Channel | undefined): Pick {
  return row.pick ?? { ...EMPTY, column: channel?.asked ?? "", unit: channel?.unit ?? "" };
}

/** A motor that is measured by its speed says so. */
function ofMotor(pick: Pick): Pick {
  return { ...pick, quantity: SPEEDS.includes(pick.unit) ? "speed" : "" };
}

function guessedKind(log: InspectedLog): CommandKind {
  const kinds: readonly CommandKind[] = ["current", "torque", "voltage"];
  return kinds.find((kind) => log.roles.some(({ role }) => role === kind)) ?? "current";
}

function firstFree(log: InspectedLog, setup: Setup): Channel | undefined {
  const taken = [setup.time, setup.motor, setup.command?.channel, ...setup.tips].map((pick) => pick?.column);
  const roles = log.roles.map(({ channel }) => channel);
  return log.channels.find((channel) => !taken.includes(channel.asked) && !roles.includes(channel.number)) ?? log.channels[0];
}

export function label(channel: Channel): string {
  const name = channel.name || `column ${channel.number}`;
  return channel.unit && !name.includes(channel.unit) ? `${name} [${channel.unit}]` : name;
}
