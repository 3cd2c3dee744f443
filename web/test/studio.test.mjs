// lissom studio in a browser: LISSOM=lissom node --test
import assert from "node:assert/strict";
import { readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { browser } from "./browser.mjs";
import { log, open, studio } from "./server.mjs";

const FORMATS = new URL("../../crates/lissom-formats/tests/files/", import.meta.url).pathname;
let chromium;
before(async () => {
  chromium = await browser();
});
after(() => chromium.close());

const csv = (name, options) => ({ name, mimeType: "text/csv", buffer: log(options) });

/** Identifies with this effort, and waits for the report. */
async function identified(page, effort = "quick") {
  await page.locator("#effort").selectOption(effort);
  await page.locator("#identify:not([disabled])").click();
  await page.locator(".report h1").waitFor({ timeout: 120_000 });
}

/** Goes to the first figure of the report. */
async function drawn(page) {
  await page.locator("figure").first().scrollIntoViewIfNeeded();
  await page.locator("figure canvas").first().waitFor();
}

async function saved(page, action) {
  const [download] = await Promise.all([page.waitForEvent("download"), action()]);
  return [download.suggestedFilename(), readFileSync(await download.path(), "utf8")];
}

test("a first use: sample, identify, read, zoom, save", async (t) => {
  const server = await studio(chromium, t);
  const { page, said } = await server.page();
  assert.equal(new URL(page.url()).hash, "");
  const chooser = page.waitForEvent("filechooser");
  await page.locator("#open").click();
  await chooser;
  await page.locator("#sample").click();
  await identified(page, "normal");
  await page.getByText(/^Coulomb friction 0\.1000/).waitFor();
  const bode = page.locator("figure", { has: page.getByText("Motor: angle per current", { exact: true }) }).first();
  await bode.scrollIntoViewIfNeeded();
  const over = bode.locator(".u-over").first();
  await over.waitFor();
  const box = await over.boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  const before = await bode.locator("output").textContent();
  assert.match(before, /rad\/s · /);
  await page.mouse.down();
  await page.mouse.move(x + 100, y, { steps: 4 });
  await page.mouse.up();
  await page.mouse.move(x, y);
  assert.notEqual(await bode.locator("output").textContent(), before);
  await page.getByRole("button", { name: "Hz", exact: true }).click();
  await page.getByText("Save files").click();
  for (const name of ["result.json", "campaign.toml", "arm.py", "report.html", "lissom_feedforward.c"]) {
    const [file, text] = await saved(page, () => page.locator(`[id="file-${name}"]`).click());
    assert.equal(file, name);
    assert.ok(text.length > 100, name);
  }
  assert.match(await page.locator("#command-line").textContent(), /^lissom identify campaign\.toml/);
  assert.deepEqual(said, []);
});

test("files of each format are opened", async (t) => {
  const server = await studio(chromium, t);
  const { page, said } = await server.page();
  const files = readdirSync(FORMATS);
  assert.ok(files.length > 20);
  await open(page, csv("log.csv"));
  await page.locator(".files").waitFor();
  await open(page, ...files.map((name) => join(FORMATS, name)));
  await page.locator(".files tbody tr").nth(files.length).waitFor({ timeout: 60_000 });
  const rows = await page.locator(".files tbody tr").allTextContents();
  for (const word of ["text", "MATLAB", "Parquet", "HDF5", "MCAP", "TDMS", "wpilog", "Excel", "NumPy"]) {
    assert.ok(rows.some((row) => row.toLowerCase().includes(word.toLowerCase())), `${word}: ${rows.join("; ")}`);
  }
  assert.equal(await page.locator(".files .wrong").count(), 0);
  assert.deepEqual(said, []);
});

test("what is missing is asked for, and roles and units are selects", async (t) => {
  const server = await studio(chromium, t);
  const { page, said } = await server.page();
  await open(page, csv("bare.csv", { names: ["a", "b", "c"] }));
  await page.locator("#missing li").first().waitFor();
  assert.ok(await page.locator("#identify").isDisabled());
  const choose = async (role, channel, unit) => {
    await page.locator(`#${role}-channel`).selectOption(channel);
    await page.locator(`#${role}-unit`).waitFor();
    await page.locator(`#${role}-unit`).selectOption(unit);
    await page.waitForLoadState("networkidle");
  };
  await choose("time", "a", "s");
  await choose("command", "b", "A");
  await choose("motor", "c", "deg");
  await page.locator("#identify:not([disabled])").waitFor();
  await page.getByText("campaign.toml of this").click();
  const text = await page.locator("details[open] pre").textContent();
  for (const line of [/time = \{ column = "a", unit = "s"/, /current = \{ column = "b", unit = "A"/, /motor = \{ column = "c", unit = "deg"/]) {
    assert.match(text, line);
  }
  await identified(page);
  assert.deepEqual(said, []);
});

test("a bad file is refused with the reason, and nothing is added", async (t) => {
  const server = await studio(chromium, t);
  const { page, said } = await server.page();
  await open(page, { name: "words.csv", mimeType: "text/csv", buffer: Buffer.from("these are words\nand more\n") });
  await page.locator(".problem").waitFor();
  assert.match(await page.locator(".problem").textContent(), /^words\.csv: /);
  assert.equal(await page.locator(".files").count(), 0);
  await open(page, csv("good.csv"));
  await page.locator(".files").waitFor();
  assert.equal(await page.locator(".problem").count(), 0);
  assert.deepEqual(said, []);
});

test("thirty runs are opened, identified and shown one by one", async (t) => {
  const server = await studio(chromium, t);
  const { page, said } = await server.page();
  await open(page, ...Array.from({ length: 30 }, (_, k) => csv(`run-${k + 1}.csv`, { rows: 2500, omega: 2 + 0.4 * k })));
  await page.locator("#use-30").waitFor({ timeout: 60_000 });
  await page.locator("#identify:not([disabled])").waitFor();
  await identified(page);
  await page.locator(".report h1", { hasText: "run-1.csv and 29 more" }).waitFor();
  // Figures are built when the reader comes near.
  for (const figure of await page.locator("figure").all()) await figure.scrollIntoViewIfNeeded();
  const motion = page.locator("figure", { has: page.locator("select option:nth-child(30)") }).first();
  await motion.locator("canvas").first().waitFor();
  await motion.locator("select").selectOption({ index: 29 });
  await motion.locator("canvas").first().waitFor();
  assert.deepEqual(said, []);
});

test("what the server does not get is sent again", async (t) => {
  const server = await studio(chromium, t);
  const { page } = await server.page();
  await open(page, csv("a.csv"));
  await page.locator("#use-1").waitFor();
  await page.route("**/api/setup", (route) => route.abort());
  await page.locator("#effort").selectOption("quick");
  await page.getByText("lissom studio does not answer").waitFor();
  assert.equal(await page.locator("#effort").inputValue(), "quick");
  await page.unroute("**/api/setup");
  await page.locator("#again-send").click();
  await page.locator("#again-send").waitFor({ state: "detached" });
  await page.reload();
  await page.locator("#effort").waitFor();
  assert.equal(await page.locator("#effort").inputValue(), "quick");
});

test("Back leads to the tab before, and a result is removed by two presses", async (t) => {
  const server = await studio(chromium, t);
  const { page, said } = await server.page();
  await open(page, csv("a.csv"));
  await identified(page);
  await page.goBack();
  await page.locator("#use-1").waitFor();
  await page.goForward();
  await page.locator("#remove-result").click();
  await page.locator("#remove-result", { hasText: "Remove for good?" }).click();
  await page.getByText("There is no result yet").waitFor();
  assert.deepEqual(said, []);
});

test("a search is stopped with the best so far, and two results are compared", async (t) => {
  const server = await studio(chromium, t);
  const { page, said } = await server.page();
  await page.locator("#sample").click();
  await page.locator("#effort").selectOption("thorough");
  await page.locator("#identify:not([disabled])").click();
  await page.getByText("First result, without the search").waitFor();
  await page.locator("#stop").click();
  await page.locator(".report h1").waitFor({ timeout: 60_000 });
  await page.locator("#tab-Logs").click();
  await page.locator("#use-2").uncheck();
  await page.waitForLoadState("networkidle");
  await identified(page);
  await page.locator("#tab-Compare").click();
  await page.locator("#comparison").waitFor();
  const table = await page.locator("#comparison").textContent();
  assert.match(table, /Coulomb friction/);
  assert.match(await page.locator("section[aria-label=Compare]").textContent(), /Settings that differ: effort \(thorough → quick\), left out/);
  assert.deepEqual(said, []);
});

test("the next experiment is planned and tried on the virtual rig", async (t) => {
  const server = await studio(chromium, t);
  const { page, said } = await server.page();
  await page.locator("#sample").click();
  await identified(page);
  await page.locator("#tab-Plan").click();
  await page.waitForFunction(() => document.querySelector("#arm")?.value.includes("[rig]"));
  await page.locator("#precision").fill("2%");
  await page.locator("#plan").click();
  await page.locator("#expected").waitFor({ timeout: 60_000 });
  assert.match(await page.locator("#expected").textContent(), /Coulomb friction/);
  await page.locator("#try").click();
  await page.locator(".report h1", { hasText: "virtual rig" }).waitFor({ timeout: 60_000 });
  await page.getByText("truth", { exact: false }).first().waitFor();
  assert.deepEqual(said, []);
});

test("a stretch is chosen by zooming and left out; the state survives a reload", async (t) => {
  const server = await studio(chromium, t);
  const { page, said } = await server.page();
  await page.locator("#sample").click();
  const over = page.locator(".u-over").first();
  await over.waitFor();
  await over.scrollIntoViewIfNeeded();
  const box = await over.boundingBox();
  const asked = page.waitForRequest(/trace\/\d+\?pixels=\d+&from=/);
  await page.mouse.move(box.x + box.width * 0.4, box.y + 50);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width * 0.5, box.y + 50, { steps: 4 });
  await page.mouse.up();
  await asked;
  await page.locator("#leave-out").click();
  await page.getByText(/^Left out: /).waitFor();
  assert.match(await page.locator("#trimmed").textContent(), /^Left out: [78](\.\d+)? s to (9\.\d+|10(\.\d+)?) s\.$/);
  await page.locator("#draw-2").check();
  await page.getByText("2 logs", { exact: true }).waitFor();
  await page.reload();
  await page.locator("#trimmed").waitFor();
  assert.match(await page.locator("#trimmed").textContent(), /^Left out: /);
  assert.equal(await page.locator(".files tbody tr").count(), 4);
  assert.deepEqual(said, []);
});

test("the runs of a file become logs, and the file again", async (t) => {
  const server = await studio(chromium, t);
  const { page, said } = await server.page();
  const [names, ...rows] = String(log({})).trimEnd().split("\n");
  const table = [`trial,${names}`, ...[1, 2, 3].flatMap((trial) => rows.map((row) => `${trial},${row}`))].join("\n");
  await open(page, { name: "all.csv", mimeType: "text/csv", buffer: Buffer.from(table) });
  await page.locator("#apart-1").click();
  await page.locator(".files tbody tr").nth(2).waitFor();
  const shown = await page.locator(".files .name").allTextContents();
  assert.deepEqual(shown, ["all.csv::trial=1", "all.csv::trial=2", "all.csv::trial=3"]);
  await page.locator("fieldset label", { hasText: "all.csv::trial=3" }).click();
  await page.getByText("2 logs", { exact: true }).waitFor();
  await page.getByRole("button", { name: "Put runs together" }).click();
  await page.locator(".files .name", { hasText: /^all\.csv$/ }).waitFor();
  assert.equal(await page.locator(".files tbody tr").count(), 1);
  assert.deepEqual(said, []);
});

test("a page that is behind is told so and changes nothing", async (t) => {
  const server = await studio(chromium, t);
  const first = await server.page();
  await first.page.locator("#sample").click();
  await first.page.locator("#use-1").waitFor();
  const second = await server.page({}, server.next());
  await second.page.locator("#use-1").waitFor();
  await first.page.locator("#use-1").uncheck();
  await first.page.waitForLoadState("networkidle");
  await second.page.locator("#use-2").click();
  await second.page.getByText("another page has changed this session meanwhile").waitFor();
  assert.equal(await second.page.locator("#use-1").isChecked(), false);
  assert.equal(await second.page.locator("#use-2").isChecked(), true);
  // The address of the first page opens no other one.
  const stranger = await (await chromium.newContext()).newPage();
  await stranger.goto(server.next().replace(/#.*/, ""));
  await stranger.getByText("this page has no key").waitFor();
  assert.deepEqual([...first.said, ...second.said], []);
});

test("text of logs is shown and never run", async (t) => {
  const server = await studio(chromium, t);
  const { page, said } = await server.page();
  const evil = '<img src=x onerror="alert(1)">';
  const names = ["t [s]", `i${evil} [A]`, `q</script><script>alert(2)</script> [rad]`];
  await open(page, csv("<svg onload=alert(3)>.csv", { names }));
  await page.locator("#identify:not([disabled])").waitFor();
  await identified(page);
  await drawn(page);
  assert.equal(await page.locator("img").count(), 0);
  const [, text] = await saved(page, async () => {
    await page.getByText("Save files").click();
    await page.locator('[id="file-report.html"]').click();
  });
  assert.ok(!text.includes(evil) && !text.includes("<svg onload"));
  assert.deepEqual(said, []);
});

for (const colorScheme of ["light", "dark"]) {
  for (const width of [360, 1280]) {
    test(`all tabs are accessible, ${colorScheme}, ${width} pixels wide`, async (t) => {
      const server = await studio(chromium, t);
      // axe-core is a script of the test: the page's own policy would not let it run.
      const { page } = await server.page({ colorScheme, viewport: { width, height: 900 }, bypassCSP: true });
      const check = async (where) => {
        assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= width, `${where} is wider than the page`);
        await page.addScriptTag({ path: new URL("../node_modules/axe-core/axe.min.js", import.meta.url).pathname });
        const { violations } = await page.evaluate(() => globalThis.axe.run(document));
        const found = violations.map(({ id, nodes }) => `${where} ${id}: ${nodes.slice(0, 3).map((node) => node.html.slice(0, 160)).join(" | ")}`);
        assert.deepEqual(found, []);
      };
      await check("welcome");
      await page.locator("#sample").click();
      await page.locator(".uplot").first().waitFor();
      for (const details of await page.locator("details > summary").all()) await details.click();
      await check("logs");
      await identified(page);
      await drawn(page);
      await check("results");
      await page.locator("#tab-Logs").click();
      await page.locator("#use-2").uncheck();
      await page.waitForLoadState("networkidle");
      await identified(page);
      await page.locator("#tab-Compare").click();
      await page.locator("#comparison").waitFor();
      await check("compare");
      await page.locator("#tab-Plan").click();
      await page.locator("#arm").waitFor();
      await check("plan");
    });
  }
}
