// Bundles each page into one HTML file with everything in it, also the notices of the packages in it;
// THIRD_PARTY.txt has those of both.
// Usage: node build.mjs OUT    (run where node_modules lies beside this file)
//
// A page keeps two marks that web/page.cc fills in: where its title and its data go.
import { createHash } from "node:crypto";
import { mkdir, readFile, writeFile } from "node:fs/promises";
import path from "node:path";
import { build } from "esbuild";
import { notices } from "./notices.mjs";

const PAGES = ["report", "replay", "bench"];

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
    legalComments: "none",  // notices() has them all
    metafile: true,
    logLevel: "warning",
  });
  const text = (ending) =>
    result.outputFiles.filter((file) => file.path.endsWith(ending)).map((file) => file.text).join("");
  return { script: text(".js"), style: text(".css"), metafile: result.metafile };
}

// Nothing but the script of the page may run, and nothing may be fetched: a page stays what it was
// when it was written, whatever the names in its data look like.
function policy(script) {
  const hash = createHash("sha256").update(script, "utf8").digest("base64");
  return `default-src 'none'; script-src 'sha256-${hash}'; style-src 'unsafe-inline'; img-src data: blob:; ` +
    `base-uri 'none'; form-action 'none'`;
}

// A replacement function, because a string would be searched for $ signs.
const fill = (text, mark, value) => text.replace(`<!-- ${mark} -->`, () => value);

async function makePage(page) {
  const { script, style, metafile } = await bundle(page);
  let html = await readFile("shared/page.html", "utf8");
  html = fill(html, "policy", `<meta http-equiv="Content-Security-Policy" content="${policy(script)}">`);
  html = fill(html, "style", `<style>${style}</style>`);
  html = fill(html, "notices", comment(await notices([metafile])));
  return { html: fill(html, "script", `<script>${script}</script>`), metafile };
}

function comment(text) {
  if (text.includes("-->")) throw new Error("a licence holds the end of a comment");
  return `<!--\n${text}\n-->`;
}

await mkdir(out, { recursive: true });
const metafiles = [];
for (const page of PAGES) {
  const { html, metafile } = await makePage(page);
  metafiles.push(metafile);
  await writeFile(path.join(out, `${page}.html`), html);
}
await writeFile(path.join(out, "THIRD_PARTY.txt"), `${await notices(metafiles)}\n`);
