// Elements in one expression.

type Child = Node | string | null;

interface Properties {
  readonly [name: string]: string | number | boolean | ((event: never) => void) | null;
}

/** An element with attributes, listeners (`onclick`) and children. */
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  properties: Properties = {},
  ...children: readonly Child[]
): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (typeof value === "function") made.addEventListener(name.slice(2), value as EventListener);
    else if (value === true) made.setAttribute(name, "");
    else if (value !== false && value !== null) made.setAttribute(name, String(value));
  }
  made.append(...children.filter((child) => child !== null));
  return made;
}

export function button(text: string, action: () => void, properties: Properties = {}): HTMLButtonElement {
  return h("button", { type: "button", onclick: action, ...properties }, text);
}

/** Time in which a second press confirms the first one [ms]. */
const CONFIRM_MS = 4000;

/** A button that acts when it is pressed twice: what it does cannot be undone. */
export function confirmed(text: string, action: () => void, properties: Properties = {}): HTMLButtonElement {
  let timer = 0;
  const made = button(
    text,
    () => {
      if (timer !== 0) {
        clearTimeout(timer);
        action();
        return;
      }
      made.textContent = `${text} for good?`;
      timer = window.setTimeout(() => {
        timer = 0;
        made.textContent = text;
      }, CONFIRM_MS);
    },
    properties,
  );
  return made;
}

/** Replaces the content of a place; what had the focus has it again. */
export function put(place: Element, ...children: readonly Child[]): void {
  const focused = document.activeElement?.id;
  place.replaceChildren(...children.filter((child) => child !== null));
  if (focused && document.activeElement === document.body) document.getElementById(focused)?.focus();
}

/** A duration for people. */
export function seconds(value: number): string {
  if (value >= 90) return `${Math.round(value / 60)} min`;
  return value >= 9.95 ? `${Math.round(value)} s` : `${Number(value.toPrecision(2))} s`;
}

export function counted(count: number, what: string): string {
  return `${count} ${what}${count === 1 ? "" : "s"}`;
}
