// Takes pictures of pages in chromium, as scripts/studies/gallery/gallery.py asks for them on standard input:
// [{page, file, width, height, scheme, seek, frames, keys}]. `seek` is a share of the drive that a replay is
// moved to, `keys` are pressed then; with `frames` that many pictures are taken from there to its end,
// as FILE-000.png and so on.
//
// Usage: node screenshots.mjs WEB_FOLDER CHROMIUM    WEB_FOLDER: <build>/web, which holds the npm packages
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";
import { pathToFileURL } from "node:url";

const [webFolder, executablePath] = process.argv.slice(2);
const { chromium } = createRequire(path.join(path.resolve(webFolder), "package.json"))("playwright-core");
// No sandbox: runs as root in containers, and opens only pages that rockyard wrote.
const args = ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];

const moveTo = (page, share) =>
  page.evaluate((s) => {
    const { duration } = window.rockyardReplay;
    window.rockyardReplay.seek(window.rockyardReplay.sample(0).t + s * duration);
    window.rockyardReplay.pose();
  }, share);

async function take(page, { file, seek, frames, keys = [] }) {
  if (seek !== undefined) await moveTo(page, seek);
  for (const key of keys) await page.keyboard.press(key);
  await page.waitForTimeout(700);
  if (frames === undefined) return page.screenshot({ path: file });
  const picture = page.locator(".picture .frame");
  for (let i = 0; i < frames; ++i) {
    await moveTo(page, seek + ((1 - seek) * i) / frames);
    await picture.screenshot({ path: file.replace(/\.png$/, `-${String(i).padStart(3, "0")}.png`) });
  }
}

const browser = await chromium.launch({ executablePath, args });
for (const shot of JSON.parse(readFileSync(0, "utf8"))) {
  const { width, height, scheme = "light" } = shot;
  const context = await browser.newContext({ viewport: { width, height }, colorScheme: scheme, reducedMotion: "reduce" });
  const page = await context.newPage();
  const [file, anchor = ""] = shot.page.split("#");
  await page.goto(`${pathToFileURL(file).href}#${anchor}`);
  await page.waitForFunction(() => window.rockyardReplay || document.querySelector("main h1"));
  await take(page, shot);
  await context.close();
}
await browser.close();
