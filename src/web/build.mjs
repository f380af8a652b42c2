// Bundles each page into one HTML file with everything in it, and writes them as C++ literals too;
// and trace_to_mcap.mjs, which node runs.
// Usage: node build.mjs OUT    (run where node_modules lies beside this file)
//
// A page keeps two marks that web/page.cc fills in: where its title and its data go.
import { createHash } from "node:crypto";
import { mkdir, readFile, writeFile } from "node:fs/promises";
import path from "node:path";
import { build } from "esbuild";

const PAGES = ["report", "replay"];

const out = process.argv[2];
if (!out) {
  console.error("build.mjs: name the folder that the pages go to");
  process.exit(2);
}

async function bundle(page) {
  const result = await build({
    entryPoints: [`${page}/main.ts`],
    outfile: `${page}.js`,
    bundle: true,
    write: false,
    minify: true,
    format: "iife",
    target: ["es2022"],
    charset: "utf8",
    legalComments: "inline",
    logLevel: "warning",
  });
  const text = (ending) =>
    result.outputFiles.filter((file) => file.path.endsWith(ending)).map((file) => file.text).join("");
  return { script: text(".js"), style: text(".css") };
}

// Nothing but the script of the page may run, and nothing may be fetched: a page stays what it was
// when it was written, whatever the names in its data look like.
function policy(script) {
  const hash = createHash("sha256").update(script, "utf8").digest("base64");
  return `default-src 'none'; script-src 'sha256-${hash}'; style-src 'unsafe-inline'; img-src data: blob:`;
}

// A replacement function, because a string would be searched for $ signs.
const fill = (text, mark, value) => text.replace(`<!-- ${mark} -->`, () => value);

async function makePage(page) {
  const { script, style } = await bundle(page);
  let html = await readFile(`${page}/page.html`, "utf8");
  html = fill(html, "policy", `<meta http-equiv="Content-Security-Policy" content="${policy(script)}">`);
  html = fill(html, "style", `<style>${style}</style>`);
  return fill(html, "script", `<script>${script}</script>`);
}

const DELIMITER = "rockyard_page";

// In parts, because compilers limit the length of one literal.
function literal(html) {
  if (html.includes(`)${DELIMITER}"`)) throw new Error("a page holds the end of a C++ literal");
  const parts = html.match(/[^]{1,16000}/gu);
  return parts.map((part) => `R"${DELIMITER}(${part})${DELIMITER}"`).join("\n");
}

// Some of its packages are CommonJS and call require, which a module lacks.
const REQUIRE = `import { createRequire } from "node:module"; const require = createRequire(import.meta.url);`;

await mkdir(out, { recursive: true });
await build({
  entryPoints: ["mcap/main.ts"],
  outfile: path.join(out, "trace_to_mcap.mjs"),
  bundle: true,
  platform: "node",
  format: "esm",
  target: ["node18"],
  banner: { js: REQUIRE },
  legalComments: "inline",
  logLevel: "warning",
});
const definitions = [];
for (const page of PAGES) {
  const html = await makePage(page);
  await writeFile(path.join(out, `${page}.html`), html);
  const name = `k${page[0].toUpperCase()}${page.slice(1)}Page`;
  definitions.push(`const std::string_view ${name} =\n${literal(html)};`);
}
await writeFile(
  path.join(out, "bundled_pages.cc"),
  `// Written by src/web/build.mjs.\n#include "web/bundled_pages.h"\n\nnamespace rockyard::web {\n\n` +
    `${definitions.join("\n\n")}\n\n}  // namespace rockyard::web\n`,
);
