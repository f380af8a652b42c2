// Pages held against the rules of axe-core (WCAG 2.2 A and AA): none may be broken badly on a report.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { before, test } from "node:test";
import * as browser from "./browser.mjs";
import { at, requirePackage, rockyard, set } from "./harness.mjs";
import { open, openTrials, runNominal } from "./report_pages.mjs";

const GRAVE = ["serious", "critical"];
const RULES = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa"];
const PHONE = { width: 390, height: 844 };
// As tall as the page: what the player at the lower edge covers, until one scrolls, counts as too small.
const UNROLLED_PHONE = { ...PHONE, height: 8000 };
const WINDOW = { width: 1000, height: 640 };
export const LOOKS = ["light", "dark", "phone"];

const axe = readFileSync(requirePackage.resolve("axe-core/axe.min.js"), "utf8");
export const openRun = () => open("run.html");
export const openReplay = async (name, options) => {
  const opened = await browser.open(at(name), { ...WINDOW, ...options });
  await opened.page.waitForFunction(() => window.rockyardReplay);
  return opened;
};

const report = (page, ...runs) => rockyard(["report", ...runs.map((each) => at(each)), "--out", at(page), "--replays", "1", "--tracks", "10"]);
const replay = (page, ...of) => rockyard(["replay", ...of, "--trial", "0", "--out", at(page)]);
/** Pages by the campaigns that they show. */
const MAKE = {
  "run.html": () => report("run.html", "nominal"),
  "comparison.html": () => {
    runNominal("dense", 20, 1, "terrain.rocks.k_per_m2=0.008");
    report("comparison.html", "nominal", "dense");
  },
  "sweep.html": () => {
    rockyard(["sweep", "scenarios/sweeps/abundance.json", "--trials", "6", "--out", at("sweep"), "--set", "rover.fidelity=quasi_static"]);
    report("sweep.html", "sweep");
  },
  "replay.html": () => replay("replay.html", at("nominal")),
  "pair.html": () => replay("pair.html", at("nominal"), "--with-trial", "1"),
  // With images, so that every panel is there.
  "steps.html": () =>
    replay("steps.html", "scenarios/gestalt/narrow_course.json", ...set("sensors.stereo.fidelity=image", "sensors.stereo.images.pyramid_level=0")),
};

/** Rules of these that the page breaks: "name (impact): what, at how many places, the first of them". */
async function broken(page, runOnly) {
  // The page's policy forbids scripts of others: this one comes from the browser's side.
  await page.evaluate(`${axe}; void 0`);
  const { violations } = await page.evaluate((only) => window.axe.run(document, { runOnly: only }), runOnly);
  return violations.map(({ id, impact, help, nodes }) =>
    ({ impact, text: `${id} (${impact}): ${help}, ${nodes.length} times, as ${nodes[0].target.join(" ")}: ${nodes[0].html.slice(0, 120)}` }));
}

export const graveIn = async (page, runOnly = RULES) => (await broken(page, runOnly)).filter(({ impact }) => GRAVE.includes(impact)).map(({ text }) => text);

async function reportIsUsable(name, look) {
  const { page } = await open(name, look === "dark" ? { scheme: "dark" } : look === "phone" ? PHONE : {});
  await openTrials(page);
  for (const summary of await page.locator("summary:visible").all()) await summary.click();
  assert.deepEqual(await graveIn(page), []);
}

// At the start, and at the end with its card.
async function replayIsUsable(name, look) {
  const { page } = await openReplay(name, look === "dark" ? { scheme: "dark" } : look === "phone" ? UNROLLED_PHONE : {});
  await page.locator("details").evaluateAll((all) => all.forEach((each) => (each.open = true)));
  assert.deepEqual(await graveIn(page), []);
  await page.keyboard.press("End");
  await page.locator(".ending:visible").first().waitFor();
  assert.deepEqual(await graveIn(page), []);
}

/** Tests that pages break no rule badly: [page, look], made before them from that many trials. */
export function testUse(reports, replays, trials = 20) {
  before(() => {
    runNominal("nominal", trials, 1);
    for (const name of new Set([...reports, ...replays].map(([page]) => page))) MAKE[name]();
  });
  for (const [name, look] of reports) test(`${name} breaks no rule badly: ${look}`, () => reportIsUsable(name, look));
  for (const [name, look] of replays) test(`${name} breaks no rule badly: ${look}`, () => replayIsUsable(name, look));
}
