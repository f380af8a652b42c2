// The page of a benchmark in a browser: what it shows is what its tables hold, also on a phone; its commands run.
import assert from "node:assert/strict";
import { execSync } from "node:child_process";
import { existsSync, writeFileSync } from "node:fs";
import { test } from "node:test";
import { graveIn } from "./accessibility_pages.mjs";
import { at, commandLine, csv, loadModule, rockyard, sourceFolder } from "./harness.mjs";
import { numbersOf, open, pageTest, values } from "./report_pages.mjs";

const scenario = `${sourceFolder}/scenarios/bench/points_athena_sdm.json`;
const cell = (name, k) => ({ name, scenario, set: { "terrain.rocks.k_per_m2": k } });
writeFileSync(at("suite.json"), JSON.stringify({
  name: "small", trials: 4, seed: 3, common_random_numbers: true, set: { "course.goal_x_m": 4 }, design: { kind: "list" },
  cells: [cell("abundance/k=0.004", 0.004), cell("abundance/k=0.02", 0.02), cell("more/k=0.013", 0.013)],
}));
for (const [name, navigator] of [["base", "gestalt"], ["other", "enav"]]) {
  writeFileSync(at(`${name}.json`), JSON.stringify({ name, navigator }));
  rockyard(["bench", "run", at(`${name}.json`), "--suite", at("suite.json"), "--out", at(name), "--quiet"]);
}
rockyard(["bench", "report", at("base"), at("other"), "--out", at("table")]);
const page = () => open("table/index.html");
const near = (text, expected) => assert.ok(text === expected || Math.abs(Number(text) - Number(expected)) < 1e-12, `${text}, not ${expected}`);

pageTest("standings, regrets and cells are those of the tables", "table/index.html", async (shown) => {
  const rows = csv(at("table", "standings.csv"));
  const table = await values(shown.locator("#standings table"));
  rows.forEach((row, i) => {
    near(table[i][1], row.score);
    near(table[i][3], row.best_rank);
    near(table[i][4], row.regret);
    assert.equal(table[i][2], row.entry === "base" ? "baseline" : row.verdict);
  });
  const heat = await values(shown.locator("#where table"));
  assert.equal(heat.length, 5, "two groups, three cells");
  for (const { entry, cell: name, arrived } of csv(at("table", "cells.csv"))) {
    const column = 1 + rows.findIndex((row) => row.entry === entry);
    near(heat.find(([head]) => head === name.split("/")[1])[column], arrived);
  }
  const numbers = await values((await numbersOf(shown, "critical-differences")).first());
  assert.deepEqual(numbers.map(([name]) => name), rows.map(({ entry }) => entry));
  assert.equal(await shown.locator("#critical-differences circle.cd-score").count(), 2);
});

test("it breaks no rule badly on a phone, and asks for nothing else", async () => {
  const { page: shown, requests, url } = await open("table/index.html", { width: 390, height: 844 });
  for (const summary of await shown.locator("summary:visible").all()) await summary.click();
  assert.deepEqual(await graveIn(shown), []);
  assert.deepEqual(requests, [url]);
  assert.ok(await shown.evaluate(() => document.documentElement.scrollWidth <= innerWidth), "no wider than the phone");
});

test("the command of a layout writes the page of both drives", async () => {
  const { page: shown } = await page();
  await shown.locator("#split-other > summary").click();
  const button = shown.locator("#split-other .layouts button").last();
  const trial = await button.innerText();
  await button.click();
  const command = await shown.locator("#split-other code").first().innerText();
  assert.match(command, new RegExp(`--trial ${trial} --with`));
  execSync(`${command.replace("rockyard", commandLine)} --out ${at("pair.html")}`, { cwd: sourceFolder, stdio: "pipe" });
  assert.ok(existsSync(at("pair.html")));
});

test("bars join the largest sets without a difference", async () => {
  const { together } = await loadModule("bench/sections/differences.ts");
  const entry = (name, ...others) => ({ name, not_told_from: others });
  // a-b, b-c and c-d, but not a-c: three bars; e stands alone.
  assert.deepEqual(together([entry("a", "b"), entry("b", "a", "c"), entry("c", "b", "d"), entry("d", "c"), entry("e")]), [[0, 1], [1, 2], [2, 3]]);
  assert.deepEqual(together([entry("a", "b", "c"), entry("b", "a", "c"), entry("c", "a", "b")]), [[0, 1, 2]]);
  assert.deepEqual(together([entry("a"), entry("b")]), []);
});
