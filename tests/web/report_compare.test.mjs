// The report page of two runs: their differences, and which run is which.
import assert from "node:assert/strict";
import path from "node:path";
import { after, before, test } from "node:test";
import { launch, rockyard, temporaryFolder } from "./harness.mjs";
import { payloadOf, withPayload } from "./page_payload.mjs";
import { assertNear, csv, openReport, SIX_DIGITS, values } from "./report_pages.mjs";

const TRIALS = 12;

const folder = temporaryFolder();
const at = (...names) => path.join(folder, ...names);
let browser;

function run(name, ...settings) {
  rockyard(["run", "scenarios/pathfinder/nominal.json", "--trials", `${TRIALS}`, "--seed", "1", "--out", at(name),
    "--set", "rover.fidelity=quasi_static", ...settings.flatMap((setting) => ["--set", setting])]);
}

before(async () => {
  run("nominal");
  run("sparse", "terrain.rocks.k_per_m2=0.002");
  rockyard(["report", at("nominal"), at("sparse"), "--out", at("two.html"), "--replays", "0"]);
  browser = await launch();
});

after(() => browser?.close());

const open = (name, options) => openReport(browser, at(name), options);

test("differences are those that rockyard compare writes", async () => {
  rockyard(["compare", at("nominal"), at("sparse"), "--csv", at("differences.csv")]);
  const { page, problems } = await open("two.html");
  assert.deepEqual(problems, []);
  const expected = csv(at("differences.csv")).filter((row) => row.trials === "all");
  const { comparisons } = payloadOf(at("two.html"));
  const shown = (await values(page.locator("#comparison > .section-body > .table-box table"))).filter((row) => row[1] === "all");
  assert.ok(expected.length > 10);
  assert.equal(shown.length, expected.length);
  expected.forEach((row, i) => {
    assert.equal(comparisons[0].columns[i].name, row.column);
    assertNear(shown[i][5], Number(row.difference), SIX_DIGITS, row.column);
  });
  await page.close();
});

test("a run leaves the charts and comes back in its own colour", async () => {
  const { page } = await open("two.html");
  const lines = page.locator("#distance-cdf svg g[aria-label=line] path");
  const strokes = () => page.locator("#distance-cdf svg g[aria-label=line]").evaluateAll((all) => all.map((each) => each.getAttribute("stroke")));
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
  await page.close();
});

test("a count of one run's outcome shows that run's trials alone", async () => {
  const { page } = await open("two.html");
  const button = page.locator("#outcomes button.count").last();
  const { outcome, run: label, value } = await button.evaluate(({ dataset }) => ({ ...dataset }));
  await button.click();
  await page.waitForSelector("#trials .tabulator-row");
  assert.equal(await page.locator("#trials-found").innerText(), `${value} of ${2 * TRIALS} trials`);
  const runs = new Set(await page.locator("#trials .tabulator-row [tabulator-field=run]").allInnerTexts());
  const outcomes = new Set(await page.locator("#trials .tabulator-row [tabulator-field=outcome]").allInnerTexts());
  assert.deepEqual([...runs], [label]);
  assert.deepEqual([...outcomes], [outcome.replaceAll("_", " ")]);
  await page.close();
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
  await unpaired.page.close();
  const paired = await open("paired.html");
  assert.equal((await columnRows(paired.page))[0][1], "those that arrived in both");
  await paired.page.close();
});

test("means without intervals are not drawn, and it says so", async () => {
  const { page } = await open("two.html");
  assert.equal(await page.locator("#forest-columns-0").count(), 0);
  assert.match(await page.locator("#comparison").innerText(), /No difference of means is drawn.*too few for one/);
  await page.close();
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
  await page.close();
});
