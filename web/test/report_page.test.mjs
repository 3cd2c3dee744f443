// The report page of `lissom demo` in a browser: LISSOM_PAGE=report.html node --test
import assert from "node:assert/strict";
import { readFileSync, statSync } from "node:fs";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { browser } from "./browser.mjs";

const file = process.env.LISSOM_PAGE;
assert.ok(file, "LISSOM_PAGE names the page");
let chromium;
before(async () => {
  chromium = await browser();
});
after(() => chromium.close());

/** Opens the page; what the console says is a failure. */
async function opened(options = {}) {
  const context = await chromium.newContext({ viewport: { width: 1280, height: 900 }, ...options });
  const page = await context.newPage();
  const said = [];
  page.on("console", (message) => said.push(message.text()));
  page.on("pageerror", (error) => said.push(String(error)));
  page.on("request", (request) => {
    if (!/^(file|blob|data):/.test(request.url())) said.push(`request of ${request.url()}`);
  });
  await page.goto(pathToFileURL(file).href);
  return { page, said, close: () => context.close() };
}

/** Goes through the page, so that all figures are built. */
async function seen(page) {
  for (const figure of await page.locator("figure").all()) {
    await figure.scrollIntoViewIfNeeded();
    await figure.locator("canvas").first().waitFor();
  }
}

const figure = (page, title) => page.locator("figure", { has: page.getByText(title, { exact: true }) }).first();

test("the page is one file of less than 1.5 MB that asks for nothing", async () => {
  assert.ok(statSync(file).size < 1.5e6, `${statSync(file).size} bytes`);
  const { page, said, close } = await opened();
  await seen(page);
  assert.deepEqual(said, []);
  await close();
});

test("figures zoom, and show their values in the chosen units", async () => {
  const { page, said, close } = await opened();
  const bode = figure(page, "Motor: angle per current");
  await bode.scrollIntoViewIfNeeded();
  const over = bode.locator(".u-over").first();
  const box = await over.boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  const readout = bode.locator("output");
  await page.mouse.move(x, y);
  const before = await readout.textContent();
  assert.match(before, /^[\d.]+ rad\/s · .*fitted model −?[\d.]+ dB/);
  await page.mouse.down();
  await page.mouse.move(x + 100, y, { steps: 4 });
  await page.mouse.up();
  await page.mouse.move(x, y);
  const zoomed = await readout.textContent();
  assert.notEqual(zoomed, before);
  await over.dblclick();
  await page.mouse.move(x + 1, y);
  await page.mouse.move(x, y);
  assert.equal(await readout.textContent(), before);
  await page.getByRole("button", { name: "Hz" }).click();
  await page.getByRole("button", { name: "ratio" }).click();
  await page.getByRole("button", { name: "wrapped" }).click();
  await bode.scrollIntoViewIfNeeded();
  const again = await over.boundingBox();
  await page.mouse.move(again.x + again.width / 2, again.y + again.height / 2);
  const hertz = await readout.textContent();
  assert.match(hertz, /^[\d.]+ Hz · .*rad\/A/);
  const value = (text) => Number(/^[\d.]+/.exec(text)[0]);
  assert.ok(Math.abs(value(hertz) * 2 * Math.PI - value(before)) < 0.01 * value(before), `${before}; ${hertz}`);
  assert.deepEqual(said, []);
  await close();
});

test("figures of one kind move together", async () => {
  const { page, said, close } = await opened();
  const [motor, tip] = [figure(page, "Motor: angle per current"), figure(page, "Beam: angle of tip per motor angle")];
  await tip.scrollIntoViewIfNeeded();
  await tip.locator("canvas").first().waitFor();
  await motor.scrollIntoViewIfNeeded();
  const left = async (of) => {
    const box = await of.locator(".u-over").first().boundingBox();
    await page.mouse.move(box.x + 1, box.y + 20);
    return Number.parseFloat(await of.locator("output").textContent());
  };
  const before = await left(tip);
  await motor.locator(".frames").focus();
  await page.keyboard.press("+");
  await page.keyboard.press("+");
  await tip.scrollIntoViewIfNeeded();
  const after = await left(tip);
  assert.ok(after > 1.5 * before, `${before} ${after}`);
  await motor.scrollIntoViewIfNeeded();
  assert.ok(Math.abs((await left(motor)) / after - 1) < 0.05);
  await motor.getByRole("button", { name: "All" }).click();
  await tip.scrollIntoViewIfNeeded();
  assert.ok(Math.abs((await left(tip)) / before - 1) < 0.05);
  assert.deepEqual(said, []);
  await close();
});

test("figures obey the keyboard, hide series, and have tables and files", async () => {
  const { page, said, close } = await opened({ acceptDownloads: true });
  const bode = figure(page, "Motor: angle per current");
  await bode.scrollIntoViewIfNeeded();
  await bode.locator(".frames").focus();
  const picture = async () => (await bode.locator(".frames canvas").first().screenshot()).toString("base64");
  const whole = await picture();
  await page.keyboard.press("+");
  const part = await picture();
  assert.notEqual(part, whole);
  await page.keyboard.press("ArrowRight");
  assert.notEqual(await picture(), part);
  await page.keyboard.press("0");
  assert.equal(await picture(), whole);
  const series = bode.getByRole("button", { name: "as measured" });
  await series.click();
  assert.equal(await series.getAttribute("aria-pressed"), "false");
  await bode.getByText("Table", { exact: true }).click();
  await bode.locator("table").first().locator("tbody tr").nth(5).waitFor();
  const saved = async (name) => {
    const [download] = await Promise.all([page.waitForEvent("download"), bode.getByRole("button", { name }).click()]);
    return readFileSync(await download.path(), "utf8");
  };
  const csv = await saved("CSV");
  assert.match(csv, /^quantity,series,Frequency \(rad\/s\),value,/);
  assert.ok((await saved("SVG")).startsWith("<svg"));
  assert.deepEqual(said, []);
  await close();
});

test("a list chooses the run of a gallery", async () => {
  const { page, said, close } = await opened();
  await page.locator("#measured-and-predicted-motion").scrollIntoViewIfNeeded();
  const motion = page.locator("#measured-and-predicted-motion + figure");
  await motion.locator(".uplot").first().waitFor();
  const select = motion.locator("select");
  const names = await select.locator("option").allTextContents();
  assert.ok(names.length > 1);
  await select.selectOption(names[1]);
  await motion.getByText(`${names[1]}: measured and predicted`).waitFor();
  await motion.locator(".uplot").nth(4).waitFor();
  assert.equal(await motion.locator(".uplot").count(), 5);
  assert.deepEqual(said, []);
  await close();
});

for (const colorScheme of ["light", "dark"]) {
  for (const width of [360, 1280, 3840]) {
    test(`the page is accessible, ${colorScheme}, ${width} pixels wide`, async () => {
      // axe-core is a script of the test: the page's own policy would not let it run.
      const { page, close } = await opened({ colorScheme, viewport: { width, height: 900 }, bypassCSP: true });
      await seen(page);
      assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= width, "the page is wider");
      await page.addScriptTag({ path: new URL("../node_modules/axe-core/axe.min.js", import.meta.url).pathname });
      const { violations } = await page.evaluate(() => globalThis.axe.run(document));
      const found = violations.map(({ id, nodes }) => `${id}: ${nodes.slice(0, 3).map((node) => node.html.slice(0, 160)).join(" | ")}`);
      assert.deepEqual(found, []);
      await close();
    });
  }
}

test("without scripts and in print the figures are pictures", async () => {
  const { page, close } = await opened({ javaScriptEnabled: false });
  assert.ok((await page.locator("figure .plot > svg:visible").count()) > 5);
  await close();
  const printed = await opened();
  await seen(printed.page);
  await printed.page.emulateMedia({ media: "print" });
  assert.ok((await printed.page.locator("figure .plot > svg:visible").count()) > 5);
  assert.equal(await printed.page.locator(".live:visible").count(), 0);
  await printed.close();
});
