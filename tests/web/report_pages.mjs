// What the tests of the report page share.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { openPage } from "./harness.mjs";

/** Columns of trials and steps of curves hold six digits. */
export const SIX_DIGITS = 1e-5;

/** A CSV file without quoted fields before the last column, as rows by column name. */
export function csv(file) {
  const [head, ...lines] = readFileSync(file, "utf8").trim().split("\n");
  const columns = head.split(",");
  return lines.map((line) => Object.fromEntries(line.split(",").map((field, i) => [columns[i], field])));
}

/** Opens a report and waits until it is built, and its first chart drawn where it has one. */
export async function openReport(browser, file, options) {
  const opened = await openPage(browser, file, options);
  await opened.page.waitForFunction(() => document.documentElement.dataset.ready);
  if ((await opened.page.locator("figure .chart").count()) > 0) {
    await opened.page.locator("figure .chart svg").first().waitFor({ state: "attached" });
  }
  return opened;
}

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
