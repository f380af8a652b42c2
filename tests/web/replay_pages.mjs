// What the tests of the replay share: pages as the command writes them, and looking into them.
import { test } from "node:test";
import * as browser from "./browser.mjs";
import { at, csv, rockyard } from "./harness.mjs";
import { withPayload } from "./page_payload.mjs";

/** What a page of a trial may have. */
export const MOST_BYTES = 3_000_000;

/** Runs two trials of a scenario and writes the page of the second. */
export function replayOf(scenario, name) {
  const run = at(name);
  rockyard(["run", `scenarios/${scenario}.json`, "--trials", "2", "--seed", "1", "--threads", "1", "--out", run]);
  const file = at(`${name}.html`);
  rockyard(["replay", run, "--trial", "1", "--out", file, "--svg", at(`${name}.svg`)]);
  return { file, stored: csv(at(name, "trials.csv")).find(({ trial }) => trial === "1") };
}

/** The same page with other data. */
export const changed = (file, name, change) => withPayload(file, at(name), (payload) => void change(payload));

// Small, because drawing in software takes its time by the pixel.
export async function open(file, options) {
  const opened = await browser.open(file, { width: 1000, height: 640, ...options });
  await opened.page.waitForFunction(() => window.rockyardReplay);
  return opened;
}

/** A test with a page open. */
export const pageTest = (name, file, check, options) => test(name, async () => check((await open(file, options)).page));

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
