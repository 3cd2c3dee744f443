// The application: logs and their channels, identification, results.

import { enter, Refused } from "./api";
import { Channels } from "./channels";
import { button, h, put } from "./dom";
import { Files } from "./files";
import { Identify } from "./identify";
import { Motion } from "./motion";
import { Plan } from "./plan";
import { Compare, Results } from "./results";
import { Store } from "./store";

const TAB = "lissom-tab";

interface View {
  readonly element: HTMLElement;
  render(): void;
}

const store = new Store();
const files = new Files(store);
const results = new Results(store);
const identify = new Identify(store, (result) => {
  results.show(result);
  // Whoever reads or compares meanwhile is not disturbed.
  if (chosen === "Logs" || chosen === "Plan") choose("Results");
});
const tabs: Record<string, readonly View[]> = {
  Logs: [files, new Channels(store), identify, new Motion(store)],
  Results: [results],
  Compare: [new Compare(store)],
  Plan: [new Plan(store, identify)],
};
const bar = h("nav", { "aria-label": "Steps", class: "tabs" });
const message = h("div", { role: "alert" });
const content = h("main");
let chosen = sessionStorage.getItem(TAB) ?? "Logs";

function show(tab: string): void {
  chosen = tab;
  sessionStorage.setItem(TAB, tab);
  render();
  scrollTo(0, 0);
}

/** Shows a tab; the browser's Back leads to the one before. */
function choose(tab: string): void {
  if (tab !== chosen) history.pushState({ tab }, "");
  show(tab);
}

function render(): void {
  const { problem, busy } = store;
  const words = problem ? [h("strong", {}, problem.error), problem.hint ? h("p", {}, problem.hint) : null] : [busy ? h("p", {}, `${busy} …`) : null];
  put(message, ...words, store.waits ? button("Send again", () => void store.sendAll(), { id: "again-send" }) : null);
  message.className = problem ? "problem" : busy ? "busy" : "";
  if (!store.isReady) return;
  const views = tabs[chosen] ?? tabs["Logs"] ?? [];
  put(
    bar,
    ...Object.keys(tabs).map((name) => {
      const count = name === "Results" && store.state.results.length > 0 ? ` (${store.state.results.length})` : "";
      return button(name + count, () => choose(name), { id: `tab-${name}`, "aria-current": name === chosen ? "page" : "false" });
    }),
  );
  const elements = views.map(({ element }) => element);
  if (elements.some((element) => element.parentElement !== content) || content.childElementCount !== elements.length) put(content, ...elements);
  for (const view of views) view.render();
}

async function begin(): Promise<void> {
  document.body.append(h("header", {}, h("h1", {}, "lissom studio"), bar), message, content);
  store.listen(render);
  addEventListener("popstate", ({ state }) => {
    const { tab } = (state ?? {}) as { tab?: string };
    if (tab && tab in tabs) show(tab);
  });
  // Without an answer, the next thing that the reader does says so.
  const refresh = () => void (document.visibilityState === "visible" && store.refresh().catch(() => undefined));
  document.addEventListener("visibilitychange", refresh);
  addEventListener("focus", refresh);
  try {
    await enter();
  } catch (error) {
    store.problem = error instanceof Refused ? error.problem : { error: String(error) };
    render();
    return;
  }
  history.replaceState({ tab: chosen }, "");
  await store.load();
}

void begin();
