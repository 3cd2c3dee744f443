// A lissom studio for a test, with a state of its own. LISSOM names the program.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

const program = process.env.LISSOM;

/** Starts a studio with these arguments for a test; `page()` opens a page of it, whose console must say nothing. */
export async function studio(chromium, t, ...args) {
  assert.ok(program, "LISSOM names the program lissom");
  const folder = mkdtempSync(join(tmpdir(), "lissom-studio-"));
  const child = spawn(program, ["studio", ...args, "--folder", join(folder, "state"), "--no-browser"]);
  let said = "";
  const address = await new Promise((resolve, reject) => {
    child.stdout.on("data", (data) => {
      said += data;
      const found = /http\S+/.exec(said);
      if (found) resolve(found[0]);
    });
    child.stderr.on("data", (data) => (said += data));
    child.on("exit", () => reject(new Error(said)));
  });
  const contexts = [];
  t.after(async () => {
    for (const context of contexts) await context.close();
    child.removeAllListeners("exit");
    child.kill();
    rmSync(folder, { recursive: true, force: true });
  });
  return {
    folder,
    /** The address for one more page. */
    next: () => /http:[^"]+/.exec(readFileSync(join(folder, "state", "open.html"), "utf8"))[0],
    async page(options = {}, at = address) {
      const context = await chromium.newContext({ viewport: { width: 1280, height: 900 }, acceptDownloads: true, ...options });
      contexts.push(context);
      const page = await context.newPage();
      const said = [];
      // The browser reports every answer that is an error; the tests of errors expect those.
      const isAnswer = (text) => /the server responded with a status of 4\d\d/.test(text);
      page.on("console", (message) => isAnswer(message.text()) || said.push(message.text()));
      page.on("pageerror", (error) => said.push(String(error)));
      page.on("dialog", (dialog) => {
        said.push(`dialog: ${dialog.message()}`);
        void dialog.dismiss();
      });
      page.on("request", (request) => {
        if (!/^(blob|data):|^http:\/\/127\.0\.0\.1:/.test(request.url())) said.push(`request of ${request.url()}`);
      });
      await page.goto(at);
      await page.locator("#tab-Logs").waitFor();
      return { page, said };
    },
  };
}

/** Chooses files, as a user does. */
export async function open(page, ...files) {
  await page.locator("#choose").setInputFiles(files);
}

/** A text with a motor that follows sines, as a log. */
export function log({ names = ["t [s]", "i [A]", "q [rad]"], rows = 5000, omega = 3 } = {}) {
  const lines = [names.join(",")];
  for (let k = 0; k < rows; k++) {
    const t = k * 0.002;
    const [q, speed] = [Math.sin(omega * t), omega * Math.cos(omega * t)];
    lines.push([t.toFixed(3), (0.1 * Math.sign(speed) - 0.02 * omega * omega * q + 0.01 * speed).toFixed(6), q.toFixed(6)].join(","));
  }
  return Buffer.from(`${lines.join("\n")}\n`);
}
