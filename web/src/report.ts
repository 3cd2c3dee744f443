// The figures of a report become interactive.

import { Figure } from "./figure";
import { type StoredChoices, type StoredFigure, unpacked } from "./figure_data";
import { Links } from "./links";
import { UnitChoice, type Units } from "./units";

function chooser<K extends keyof Units>(choice: UnitChoice, name: string, key: K, values: readonly Units[K][]): HTMLElement {
  const group = document.createElement("div");
  group.className = "choice";
  group.setAttribute("role", "group");
  group.setAttribute("aria-label", name);
  const buttons = values.map((value) => {
    const button = document.createElement("button");
    [button.type, button.textContent] = ["button", value];
    button.addEventListener("click", () => choice.choose(key, value));
    group.append(button);
    return [button, value] as const;
  });
  const mark = () => {
    for (const [button, value] of buttons) button.setAttribute("aria-pressed", String(choice.units[key] === value));
  };
  choice.listen(mark);
  mark();
  return group;
}

type Stored = StoredFigure | StoredChoices;

function figuresOf(stored: Stored): readonly StoredFigure[] {
  return "all" in stored ? stored.all.map(({ figure }) => figure) : [stored];
}

/** Makes a figure interactive. */
function enliven(place: Element, stored: Stored, choice: UnitChoice, links: Links): void {
  const live = document.createElement("div");
  live.className = "live";
  const picture = place.querySelector(".plot > svg");
  place.classList.add("interactive");
  if ("all" in stored) {
    const label = document.createElement("label");
    label.className = "chooser";
    const select = document.createElement("select");
    for (const { name } of stored.all) select.append(new Option(name));
    label.append(stored.choose, " ", select);
    place.prepend(label, live);
    let shown: Figure | null = null;
    const show = () => {
      const chosen = stored.all[select.selectedIndex];
      shown?.end();
      live.replaceChildren();
      // Only of the first figure is there a picture.
      const own = select.selectedIndex === 0 ? picture : null;
      shown = chosen ? new Figure(live, unpacked(chosen.figure), choice, own, { links }) : null;
    };
    select.addEventListener("change", show);
    show();
  } else {
    place.prepend(live);
    new Figure(live, unpacked(stored), choice, picture, { links });
  }
}

/** Makes the figures of a report interactive, those far below when the reader comes near: the page is there at once. */
export function enlivenReport(report: ParentNode): void {
  const choice = new UnitChoice();
  const links = new Links(choice);
  const found: [HTMLElement, Stored][] = [];
  for (const script of report.querySelectorAll('script[type="application/json"].figure-data')) {
    const figure = script.closest("figure");
    if (figure) found.push([figure, JSON.parse(script.textContent ?? "") as Stored]);
  }
  const figures = found.flatMap(([, stored]) => figuresOf(stored));
  const axes = figures.flatMap((figure) => [figure.x, ...figure.panels.map((panel) => panel.y)]);
  const has = (quantity: string) => axes.some((axis) => axis.quantity === quantity);
  const bar = report.querySelector<HTMLElement>("#units");
  if (bar) {
    if (has("frequency")) bar.append(chooser(choice, "frequencies in", "frequency", ["rad/s", "Hz"]));
    if (has("decibels")) bar.append(chooser(choice, "magnitudes", "magnitude", ["dB", "ratio"]));
    if (has("degrees")) bar.append(chooser(choice, "phase", "phase", ["continuous", "wrapped"]));
    bar.hidden = bar.childElementCount === 0;
  }
  const observer = new IntersectionObserver(
    (all) => {
      for (const entry of all.filter((entry) => entry.isIntersecting)) {
        observer.unobserve(entry.target);
        const stored = found.find(([figure]) => figure === entry.target)?.[1];
        if (stored) enliven(entry.target, stored, choice, links);
      }
    },
    { rootMargin: "600px" },
  );
  for (const [figure] of found) observer.observe(figure);
}
