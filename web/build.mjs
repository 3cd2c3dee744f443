// Builds the scripts into the crates that embed them: node build.mjs [--check]
import { createHash } from "node:crypto";
import { readFileSync, writeFileSync } from "node:fs";
import { build } from "esbuild";

const CHECK = process.argv.includes("--check");
const PAGE = "../crates/lissom-report/src/page";
// A script that stands in a page is named by its hash in the page's policy.
const TARGETS = [
  { entry: "src/page.ts", out: `${PAGE}/page.js`, inPage: true },
  { entry: "src/studio/main.ts", out: "../crates/lissom-studio/src/page/studio.js", inPage: false },
];
const NOTICE = "/* uPlot 1.6.32, Copyright (c) 2022 Leon Sorokin, MIT License */\n";

let differs = false;
const put = (file, text) => {
  if (CHECK) {
    if (readFileSync(file, "utf8") !== text) {
      console.error(`${file} is not what the sources give: npm run build`);
      differs = true;
    }
  } else writeFileSync(file, text);
};
for (const { entry, out, inPage } of TARGETS) {
  const made = await build({
    entryPoints: [entry],
    bundle: true,
    minify: true,
    format: "iife",
    target: "es2020",
    charset: "ascii",
    legalComments: "none",
    write: false,
  });
  // The page puts this between <script> tags, as CDATA for readers of XML: it must hold neither end.
  const code = made.outputFiles[0].text.replaceAll("</script", "<\\/script").replaceAll("]]>", "]]\\u003e");
  const script = `//<![CDATA[\n${NOTICE}${code}//]]>`;
  put(out, script);
  if (inPage) put(`${out}.sha256`, createHash("sha256").update(script).digest("base64"));
}
const css = readFileSync("node_modules/uplot/dist/uPlot.min.css", "utf8");
put(`${PAGE}/uplot.css`, css.trimEnd() + "\n");
process.exit(differs ? 1 : 0);
