// What the tests of the report page share.
import assert from "node:assert/strict";
import { test } from "node:test";
import * as browser from "./browser.mjs";
import { at, rockyard, set } from "./harness.mjs";

/** Columns of trials and steps of curves hold six digits. */
export const SIX_DIGITS = 1e-5;

/** Runs quick trials of the nominal scenario into a folder of that name. */
export const runNominal = (name, trials, seed, ...settings) => rockyard(["run", "scenarios/pathfinder/nominal.json",
  "--trials", `${trials}`, "--seed", `${seed}`, "--out", at(name), ...set("rover.fidelity=quasi_static", ...settings)]);

/** Opens a report and waits until it is built, and its first chart drawn where it has one. */
export async function open(name, options) {
  const opened = await browser.open(at(name), options);
  await opened.page.waitForFunction(() => document.documentElement.dataset.ready);
  if ((await opened.page.locator("figure .chart").count()) > 0) {
    await opened.page.locator("figure .chart svg").first().waitFor({ state: "attached" });
  }
  return opened;
}

/** One page, one.html, for the tests that leave it as it is. */
let shared;
export const look = () => (shared ??= open("one.html", { kept: true }));

/** A test with a page open: of that name, or `look`. */
export const pageTest = (name, of, check, options) =>
  test(name, async () => check((await (of === look ? look() : open(of, options))).page));

/** The table of trials is made when it comes near the window. */
export async function openTrials(page) {
  await page.locator("#trials").scrollIntoViewIfNeeded();
  await page.waitForSelector("#trials .tabulator-row");
}

/** Exact values of a table's cells, row by row. */
export const values = (locator) =>
  locator.locator("tbody tr").evaluateAll((rows) =>
    rows.map((row) => [...row.children].map((cell) => cell.dataset.value ?? cell.textContent)));

/** The tables behind a chart. */
export async function numbersOf(page, figure) {
  await page.locator(`#${figure} > details > summary`).click();
  await page.locator(`#${figure} > details table`).first().waitFor();
  return page.locator(`#${figure} > details table`);
}

export function assertNear(actual, expected, tolerance, what) {
  const scale = Math.max(Math.abs(expected), 1e-12);
  assert.ok(Math.abs(Number(actual) - expected) <= tolerance * scale, `${what}: ${actual}, not ${expected}`);
}
