// The report page of sweeps and of measurements.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { test } from "node:test";
import { at, rockyard, sourceFolder } from "./harness.mjs";
import { withPayload } from "./page_payload.mjs";
import { open, pageTest, values } from "./report_pages.mjs";

const ABUNDANCES = [0.001, 0.004, 0.012];

const summary = (name) => JSON.parse(readFileSync(at(name, "summary.json"), "utf8"));
writeFileSync(at("abundance.json"), JSON.stringify({
  name: "abundance", scenario: path.join(sourceFolder, "scenarios/pathfinder/nominal.json"), trials: 10, seed: 4,
  set: { "rover.fidelity": "quasi_static" },
  axes: [{ path: "terrain.rocks.k_per_m2", values: ABUNDANCES }],
  fit: { axis: "k_per_m2", scale: "log" },
}));
rockyard(["sweep", at("abundance.json"), "--out", at("abundance")]);
rockyard(["report", at("abundance"), "--out", at("sweep.html"), "--replays", "0"]);
rockyard(["run", "scenarios/hazard_detection/height_factor.json", "--trials", "32", "--out", at("height")]);
rockyard(["report", at("height"), "--out", at("height.html")]);

pageTest("a curve has the rates of the sweep's cells", "sweep.html", async (page) => {
  const { cells } = summary("abundance");
  for (const success of ["declared", "true"]) {
    const figure = page.locator(`#curve-0-${success}`);
    await figure.locator("summary").click();
    await figure.locator("details table").waitFor();
    const rows = await values(figure.locator("details table"));
    assert.equal(rows.length, cells.length);
    rows.forEach((row, i) => {
      const rate = cells[i][`${success}_success`];
      assert.deepEqual(row.slice(1, 4).map(Number), [ABUNDANCES[i], rate.trials, rate.rate]);
      assert.equal(Number(row[4]), rate.ci95[1]);
    });
    // One mark for each cell.
    assert.equal(await figure.locator("svg g[data-mark=dot] path, svg g[data-mark=dot] circle").count(), cells.length);
    assert.match(await figure.locator(".fit-notes").innerText(), /fit/);
  }
});

pageTest("every cell of a sweep is in the headline and among the outcomes", "sweep.html", async (page) => {
  const { cells } = summary("abundance");
  const rows = await values(page.locator("#headline table"));
  assert.deepEqual(rows.map((row) => Number(row[2])), cells.map((cell) => cell.declared_success.rate));
  assert.deepEqual(rows.map((row) => Number(row[4])), cells.map((cell) => cell.true_success.rate));
  const counts = await page.locator("#outcomes button.count").evaluateAll((all) => all.map(({ dataset }) => Number(dataset.value)));
  const expected = cells.flatMap((cell) => Object.values(cell.outcomes).filter((count) => count > 0));
  assert.deepEqual(counts.sort(), expected.sort());
});

pageTest("a measurement shows its cells, as a table and along a factor", "height.html", async (page) => {
  const { cells } = summary("height");
  const rows = await values(page.locator("#measurements .section-body > .table-box table"));
  assert.equal(rows.length, cells.length);
  const heads = await page.locator("#measurements .section-body > .table-box thead th").allInnerTexts();
  const rates = heads.indexOf("detected_single");
  assert.deepEqual(rows.map((row) => Number(row[rates])), cells.map((cell) => cell.detected_single.rate));
  const figure = page.locator("#cells-0");
  await figure.locator("summary").click();
  await figure.locator("details table").waitFor();
  const points = await values(figure.locator("details table"));
  assert.deepEqual(points.map((row) => row.slice(1, 3).map(Number)),
    cells.map((cell) => [cell.height_m, cell.detected_single.rate]).sort((a, b) => a[0] - b[0]));
  assert.equal(await page.locator("#headline, #distance").count(), 0);
});

test("whether a fit is rejected is what the program says", async () => {
  for (const rejected of [true, false]) {
    withPayload(at("sweep.html"), at("verdict.html"), ({ sweeps: [{ curves }] }) => {
      for (const curve of curves) Object.assign(curve, { fit: [{ x: 0.001, rate: 0.9, low: 0.8, high: 0.95 }, { x: 0.012, rate: 0.5, low: 0.4, high: 0.6 }], fit_rejected: rejected });
    });
    const { page } = await open("verdict.html");
    const text = await page.locator("#curve-0-declared .fit-notes").innerText();
    assert.match(text, rejected ? /^fit rejected/ : /^fit not rejected/);
  }
});

pageTest("a page of a sweep begins with its curve", "sweep.html", async (page) => {
  assert.equal(await page.locator("section").first().getAttribute("id"), "curves");
  assert.equal(await page.locator("section").first().locator("figure .chart svg").first().isVisible(), true);
});
