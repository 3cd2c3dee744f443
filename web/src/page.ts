// The report page: its figures become interactive.

import { Figure } from "./figure";
import type { FigureData } from "./figure_data";
import { UnitChoice, type Units } from "./units";

const choice = new UnitChoice();

function chooser<K extends keyof Units>(name: string, key: K, values: readonly Units[K][]): HTMLElement {
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

function begin(): void {
  const found: [HTMLElement, FigureData][] = [];
  for (const script of document.querySelectorAll('script[type="application/json"].figure-data')) {
    const figure = script.closest("figure");
    if (figure) found.push([figure, JSON.parse(script.textContent ?? "") as FigureData]);
  }
  const axes = found.flatMap(([, data]) => [data.x, ...data.panels.map((panel) => panel.y)]);
  const has = (quantity: string) => axes.some((axis) => axis.quantity === quantity);
  const bar = document.getElementById("units");
  if (bar) {
    if (has("frequency")) bar.append(chooser("frequencies in", "frequency", ["rad/s", "Hz"]));
    if (has("decibels")) bar.append(chooser("magnitudes", "magnitude", ["dB", "ratio"]));
    if (has("degrees")) bar.append(chooser("phase", "phase", ["continuous", "wrapped"]));
    bar.hidden = bar.childElementCount === 0;
  }
  // Figures far below are built when the reader comes near: the page is there at once.
  const observer = new IntersectionObserver(
    (all) => {
      for (const entry of all.filter((entry) => entry.isIntersecting)) {
        observer.unobserve(entry.target);
        const data = found.find(([figure]) => figure === entry.target)?.[1];
        const picture = entry.target.querySelector(".plot > svg");
        const place = document.createElement("div");
        place.className = "live";
        if (!data) continue;
        entry.target.classList.add("interactive");
        entry.target.prepend(place);
        new Figure(place, data, choice, picture);
      }
    },
    { rootMargin: "600px" },
  );
  for (const [figure] of found) observer.observe(figure);
}

begin();
