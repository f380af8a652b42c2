// What the tests of the replay share: pages as the command writes them, and looking into them.
import { readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { after, before } from "node:test";
import { gunzipSync, gzipSync } from "node:zlib";
import { launch, openPage, rockyard, temporaryFolder } from "./harness.mjs";

export const folder = temporaryFolder();

/** What a page of a trial may have. */
export const MOST_BYTES = 3_000_000;

/** The browser of a test file: started before its tests, closed after them. */
let browser;

export const testBrowser = () => browser;

before(async () => {
  browser = await launch();
});

after(async () => {
  await browser?.close();
});

/** Runs two trials of a scenario and writes the page of the second. */
export function replayOf(scenario, name) {
  const run = path.join(folder, name);
  rockyard(["run", `scenarios/${scenario}.json`, "--trials", "2", "--seed", "1", "--threads", "1", "--out", run]);
  const file = path.join(folder, `${name}.html`);
  rockyard(["replay", run, "--trial", "1", "--out", file, "--svg", path.join(folder, `${name}.svg`)]);
  const lines = readFileSync(path.join(run, "trials.csv"), "utf8").trim().split("\n").map((line) => line.split(","));
  const row = lines.find((fields, i) => i > 0 && fields[lines[0].indexOf("trial")] === "1");
  const stored = Object.fromEntries(lines[0].map((column, i) => [column, row[i]]));
  return { file, stored };
}

export const PAYLOAD = /(<script type="application\/octet-stream" id="payload">)([^<]*)/;

export const payloadOf = (file) => JSON.parse(gunzipSync(Buffer.from(readFileSync(file, "utf8").match(PAYLOAD)[2], "base64")));

/** The same page with other data. */
export function changed(file, name, change) {
  const payload = payloadOf(file);
  change(payload);
  const text = gzipSync(JSON.stringify(payload)).toString("base64");
  const target = path.join(folder, name);
  writeFileSync(target, readFileSync(file, "utf8").replace(PAYLOAD, (_, mark) => mark + text));
  return target;
}

// Small, because drawing in software takes its time by the pixel.
export async function open(file, options) {
  const opened = await openPage(browser, file, { width: 1000, height: 640, ...options });
  await opened.page.waitForFunction(() => window.rockyardReplay);
  return opened;
}

/** Every fourth colour of the picture, as one list. */
export const pixels = (page) =>
  page.evaluate(() => {
    window.paints = true;
    rockyardReplay.pose();
    window.paints = false;
    const canvas = document.querySelector(".picture canvas");
    const copy = document.createElement("canvas");
    copy.width = canvas.width / 4;
    copy.height = canvas.height / 4;
    const context = copy.getContext("2d");
    context.drawImage(canvas, 0, 0, copy.width, copy.height);
    return [...new Uint32Array(context.getImageData(0, 0, copy.width, copy.height).data.buffer)];
  });

/** Share of the pixels that differ. */
export const difference = (a, b) => a.filter((colour, i) => colour !== b[i]).length / a.length;

export const time = (page) => page.evaluate(() => rockyardReplay.time);
export const seekShare = (page, share) => page.evaluate((s) => rockyardReplay.seek(rockyardReplay.sample(0).t + s * rockyardReplay.duration), share);
