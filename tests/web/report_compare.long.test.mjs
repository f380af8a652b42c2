// The report page of two runs: their differences, and which run is which.
import assert from "node:assert/strict";
import { test } from "node:test";
import { at, csv, rockyard } from "./harness.mjs";
import { payloadOf, withPayload } from "./page_payload.mjs";
import { assertNear, open, pageTest, runNominal, SIX_DIGITS, values } from "./report_pages.mjs";

const TRIALS = 12;

const run = (name, ...settings) => runNominal(name, TRIALS, 1, ...settings);
run("nominal");
run("sparse", "terrain.rocks.k_per_m2=0.002");
rockyard(["report", at("nominal"), at("sparse"), "--out", at("two.html"), "--replays", "0"]);

test("differences are those that rockyard compare writes", async () => {
  rockyard(["compare", at("nominal"), at("sparse"), "--csv", at("differences.csv")]);
  const { page } = await open("two.html");
  const expected = csv(at("differences.csv")).filter((row) => row.trials === "all");
  const { comparisons } = payloadOf(at("two.html"));
  const shown = (await values(page.locator("#comparison > .section-body > .table-box table"))).filter((row) => row[1] === "all");
  assert.ok(expected.length > 10);
  assert.equal(shown.length, expected.length);
  expected.forEach((row, i) => {
    assert.equal(comparisons[0].columns[i].name, row.column);
    // What no trial of a run tells (the belief of a rover that keeps none) has no difference.
    if (row.difference === "") assert.equal(shown[i][5], "–", row.column);
    else assertNear(shown[i][5], Number(row.difference), SIX_DIGITS, row.column);
  });
});

pageTest("a run leaves the charts and comes back in its own colour", "two.html", async (page) => {
  const lines = page.locator("#distance-cdf svg g[data-mark=line] path");
  const strokes = () => page.locator("#distance-cdf svg g[data-mark=line]").evaluateAll((all) => all.map((each) => each.getAttribute("stroke")));
  assert.equal(await lines.count(), 2);
  const before = await strokes();
  const boxes = page.locator("#runs input");
  // Charts are drawn with the next frame.
  await boxes.nth(0).uncheck();
  await lines.first().waitFor();
  assert.equal(await lines.count(), 1);
  assert.deepEqual(await strokes(), [before[1]]);
  await boxes.nth(0).check();
  await lines.first().waitFor();
  assert.deepEqual(await strokes(), before);
});

pageTest("a count of one run's outcome shows that run's trials alone", "two.html", async (page) => {
  const button = page.locator("#outcomes button.count").last();
  const { outcome, run: label, value } = await button.evaluate(({ dataset }) => ({ ...dataset }));
  await button.click();
  await page.waitForSelector("#trials .tabulator-row");
  assert.equal(await page.locator("#trials-found").innerText(), `${value} of ${2 * TRIALS} trials`);
  const runs = new Set(await page.locator("#trials .tabulator-row [tabulator-field=run]").allInnerTexts());
  const outcomes = new Set(await page.locator("#trials .tabulator-row [tabulator-field=outcome]").allInnerTexts());
  assert.deepEqual([...runs], [label]);
  assert.deepEqual([...outcomes], [outcome.replaceAll("_", " ")]);
});

const columnRows = (page) => values(page.locator("#comparison > .section-body > .table-box table"));

test("two samples that are not in pairs are not called pairs, and have both numbers of trials", async () => {
  const arrived = { trials: "arrived", name: "energy_wh", unit: "Wh", first: 20, second: 22, difference: 2, low: -1, high: 5 };
  const columnsOf = (paired) => [{ ...arrived, n: 25, n_second: paired ? null : 30 }];
  for (const [name, paired] of [["unpaired.html", false], ["paired.html", true]]) {
    withPayload(at("two.html"), at(name), ({ comparisons }) => {
      Object.assign(comparisons[0], { paired, columns: columnsOf(paired) });
    });
  }
  const unpaired = await open("unpaired.html");
  const words = await unpaired.page.locator("#comparison > .section-body > .table-box tbody tr").allInnerTexts();
  assert.match(words[0], /those that arrived\t25 \/ 30\t/);
  const paired = await open("paired.html");
  assert.equal((await columnRows(paired.page))[0][1], "those that arrived in both");
});

pageTest("means without intervals are not drawn, and it says so", "two.html", async (page) => {
  assert.equal(await page.locator("#forest-columns-0").count(), 0);
  assert.match(await page.locator("#comparison").innerText(), /No difference of means is drawn.*too few for one/);
});

test("differences of rates are points, and a column that was zero at first is named", async () => {
  withPayload(at("two.html"), at("zero.html"), ({ comparisons: [of] }) => {
    Object.assign(of.successes[0], { first: 0.625, second: 0.975, difference: 0.35, low: 0.1, high: 0.6 });
    const scrapes = of.columns.find((row) => row.name === "scrapes" && row.trials === "all");
    // So few pairs give no mean an interval, and without one nothing is drawn.
    of.columns.forEach((row) => Object.assign(row, { low: row.difference - 1, high: row.difference + 1 }));
    Object.assign(scrapes, { first: 0, second: 3, difference: 3, low: 2, high: 4 });
  });
  const { page } = await open("zero.html");
  const [row] = await page.locator("#forest-success-0 + .table-box tbody tr").allInnerTexts();
  assert.match(row, /62\.5\s%\t97\.5\s%\t35\.0\t10\.0 to 60\.0\t/);
  assert.match(await page.locator("#comparison").innerText(), /Difference \[points\]/);
  assert.match(await page.locator("#forest-columns-0 figcaption").innerText(), /Not drawn.*scrapes \(0, then 3\)/);
});

pageTest("what differs comes first: settings, then both rates with interval and verdict", "two.html", async (page) => {
  assert.equal(await page.locator("section").first().getAttribute("id"), "changes");
  const [of] = payloadOf(at("two.html")).comparisons;
  const settings = await page.locator("#changes .settings-table tbody tr").evaluateAll((rows) =>
    rows.map((row) => [...row.children].map((cell) => cell.textContent)));
  assert.deepEqual(settings, of.settings.map(({ path: name, first, second }) => [name, first, second]));
  assert.deepEqual(settings.map(([name]) => name), ["terrain.rocks.k_per_m2"]);
  const shown = await page.locator("#changes .verdicts li:has([data-low])").evaluateAll((all) => all.map((item) => ({
    difference: Number(item.querySelector("[data-value]").dataset.value),
    low: Number(item.querySelector("[data-low]").dataset.low),
    high: Number(item.querySelector("[data-low]").dataset.high),
  })));
  assert.deepEqual(shown, of.successes.map(({ difference, low, high }) => ({ difference, low, high })));
});

test("the verdict in words follows the p-value", async () => {
  const meanings = { 0.001: "more than chance would do", 0.2: "which chance alone might do" };
  for (const [p, meaning] of Object.entries(meanings)) {
    withPayload(at("two.html"), at("verdict.html"), ({ comparisons: [{ successes }] }) => {
      for (const row of successes) Object.assign(row, { first: 0.9, second: 0.6, difference: -0.3, low: -0.5, high: -0.1, p: Number(p) });
    });
    const { page } = await open("verdict.html");
    const text = await page.locator("#changes .verdicts li").first().innerText();
    assert.match(text, /^Declared success fell by 30\.0 points \(difference −50\.0 to −10\.0\), from 90\.0\s% of nominal to 60\.0\s% of sparse/);
    assert.ok(text.includes(meaning), text);
  }
});

test("trials that ended in another way are counted, and some drawn side by side", async () => {
  const ends = (name) => csv(at(name, "trials.csv")).map(({ outcome }) => outcome);
  const [first, second] = [ends("nominal"), ends("sparse")];
  const changed = first.flatMap((outcome, trial) => (outcome === second[trial] ? [] : [trial]));
  assert.ok(changed.length > 0);
  const { page } = await open("two.html");
  const count = page.locator("#changes .changed-count");
  assert.equal(Number(await count.locator("[data-value]").getAttribute("data-value")), changed.length);
  assert.match(await count.innerText(), new RegExp(`of ${TRIALS} trials with the same seed`));
  const parts = await page.locator("#changes .change-list [data-value]").evaluateAll((all) => all.map(({ dataset }) => Number(dataset.value)));
  assert.equal(parts.reduce((sum, part) => sum + part, 0), changed.length);
  const pairs = await page.locator("#changes .pair").evaluateAll((all) =>
    all.map((pair) => [Number(pair.dataset.trial), ...[...pair.querySelectorAll("g[data-outcome]")].map(({ dataset }) => dataset.outcome)]));
  assert.ok(pairs.length > 0);
  for (const [trial, ...outcomes] of pairs) assert.deepEqual(outcomes, [first[trial], second[trial]], `trial ${trial}`);
});

test("published values of another case are folded away, those of the published one are not", async () => {
  assert.ok(payloadOf(at("two.html")).runs[1].published.settings.length > 0);
  withPayload(at("two.html"), at("case.html"), ({ runs: [run] }) => {
    run.published.settings = [];
  });
  const { page } = await open("case.html");
  assert.equal(await page.locator("#published .published-table").nth(0).isVisible(), true);
  assert.equal(await page.locator("#published .published-table").nth(1).isVisible(), false);
  await page.locator("#published .other-case > summary").click();
  assert.equal(await page.locator("#published .published-table").nth(1).isVisible(), true);
});
