// How long a zoom takes in lissom studio, for a log of 10⁷ samples and, as the baseline, one of 10⁴:
// LISSOM=lissom node bench/interaction.mjs [ZOOMS]
// The first frame after the zoom has the points that are there; the points of the part follow.
import { closeSync, mkdtempSync, openSync, rmSync, writeSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { browser } from "../test/browser.mjs";
import { studio } from "../test/server.mjs";

const ZOOMS = Number(process.argv[2] ?? 15);
const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];

/** A NumPy file of time, input and angle as float32. */
function write(file, rows) {
  const text = `{'descr': [('t [s]', '<f4'), ('i [A]', '<f4'), ('q [rad]', '<f4')], 'fortran_order': False, 'shape': (${rows},), }`;
  const length = Math.ceil((text.length + 11) / 64) * 64 - 10;
  const head = Buffer.alloc(10 + length, " ");
  head.write("\x93NUMPY\x01\x00", 0, "latin1");
  head.writeUInt16LE(length, 8);
  head.write(text, 10);
  head.write("\n", head.length - 1);
  const out = openSync(file, "w");
  writeSync(out, head);
  const block = 100_000;
  for (let first = 0; first < rows; first += block) {
    const values = new Float32Array(3 * Math.min(block, rows - first));
    for (let k = 0; 3 * k < values.length; k++) {
      const t = (first + k) * (1e4 / rows);
      values.set([t, Math.cos(t), Math.sin(t)], 3 * k);
    }
    writeSync(out, Buffer.from(values.buffer));
  }
  closeSync(out);
}

/** Times of zooms into the plot of a log [ms]. */
async function times(chromium, file) {
  const ends = [];
  const server = await studio(chromium, { after: (end) => ends.push(end) }, file);
  const { page } = await server.page();
  const over = page.locator(".u-over").first();
  await over.waitFor({ timeout: 120_000 });
  await over.scrollIntoViewIfNeeded();
  await page.evaluate(() => {
    const own = window.fetch;
    window.answers = [];
    window.fetch = async (...asked) => {
      const started = performance.now();
      const answer = await own(...asked);
      if (String(asked[0]).includes("/trace/")) window.answers.push([started, performance.now()]);
      return answer;
    };
  });
  const found = { frame: [], points: [] };
  for (let k = 0; k < ZOOMS; k++) {
    const box = await over.boundingBox();
    const at = box.x + box.width * (0.2 + (0.4 * k) / ZOOMS);
    await page.mouse.move(at, box.y + 50);
    await page.mouse.down();
    await page.mouse.move(at + box.width * 0.2, box.y + 50, { steps: 3 });
    const [frame, points] = await Promise.all([
      page.evaluate(
        () =>
          new Promise((resolve) => {
            window.addEventListener("mouseup", () => {
              const started = performance.now();
              window.zoomed = started;
              requestAnimationFrame(() => setTimeout(() => resolve(performance.now() - started)));
            }, { once: true, capture: true });
          }),
      ),
      page.waitForResponse(/trace\/\d+\?pixels=\d+&from=/).then(() => page.evaluate(() => new Promise((resolve) => {
        const look = () => {
          const last = window.answers.at(-1);
          if (last && last[0] > window.zoomed) requestAnimationFrame(() => setTimeout(() => resolve(performance.now() - window.zoomed)));
          else setTimeout(look, 2);
        };
        look();
      }))),
      page.waitForTimeout(20).then(() => page.mouse.up()),
    ]);
    found.frame.push(frame);
    found.points.push(points);
    await over.dblclick();
    await page.waitForTimeout(400);
  }
  for (const end of ends) await end();
  return found;
}

const folder = mkdtempSync(join(tmpdir(), "lissom-bench-"));
const chromium = await browser();
const rows = [1e4, 1e7];
const found = [];
for (const count of rows) {
  const file = join(folder, `rows-${count}.npy`);
  write(file, count);
  found.push(await times(chromium, file));
}
for (const what of ["frame", "points"]) {
  const [base, long] = found.map((times) => median(times[what]));
  console.log(`${what}: ${base.toFixed(1)} ms of 10⁴ samples, ${long.toFixed(1)} ms of 10⁷, ratio ${(long / base).toFixed(2)} (medians of ${ZOOMS})`);
}
await chromium.close();
rmSync(folder, { recursive: true });
