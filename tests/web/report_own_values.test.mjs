// What navigators count for themselves, and drives that their faults end, on the report page. The numbers are put into the
// data of a page, as no navigator of rockyard's own counts.
import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import path from "node:path";
import { test } from "node:test";
import { at, loadModule, rockyard, sourceFolder } from "./harness.mjs";
import { withPayload } from "./page_payload.mjs";
import { numbersOf, open, openTrials, pageTest, values } from "./report_pages.mjs";

const ABUNDANCES = [0.001, 0.004];
const OWN = "mine.replans";
const TRIALS = 4;
const MEANS = [2, 5];

writeFileSync(at("two.json"), JSON.stringify({
  name: "two", scenario: path.join(sourceFolder, "scenarios/pathfinder/nominal.json"), trials: TRIALS,
  set: { "rover.fidelity": "quasi_static", "referee.time_limit_s": 30 },
  axes: [
    { name: "navigator", levels: [{ name: "pathfinder", set: {} }, { name: "mine", set: { "course.goal_radius_m": 0.6 } }] },
    { path: "terrain.rocks.k_per_m2", values: ABUNDANCES },
  ],
}));
rockyard(["sweep", at("two.json"), "--out", at("two")]);
rockyard(["report", at("two"), "--out", at("plain.html"), "--replays", "0"]);

// Cells 2 and 3 count, the others do not; the last trial of cell 3 ended with its process.
withPayload(at("plain.html"), at("own.html"), (payload) => {
  payload.runs.forEach((run, cell) => {
    const counts = cell >= 2 ? Array.from({ length: TRIALS }, (_, i) => MEANS[cell - 2] - 1.5 + i) : new Array(TRIALS).fill(null);
    run.trials.columns.push({ name: OWN, unit: "1", meaning: "Plans made anew.", values: counts });
    run.summary.columns[OWN] = { count: cell >= 2 ? TRIALS : 0, median: cell >= 2 ? MEANS[cell - 2] : null };
    const mean = cell >= 2 ? MEANS[cell - 2] : null;
    payload.sweeps[0].summary.cells[cell].metrics[OWN] =
      { count: cell >= 2 ? TRIALS : 0, mean, ci95: cell === 3 ? [mean - 1, mean + 1] : [null, null] };
  });
  const { trials, summary, endings } = payload.runs[3];
  const last = TRIALS - 1;
  trials.outcome[last] = trials.outcome_names.push("navigator_fault") - 1;
  trials.detail[last] = trials.detail_texts.push("stopped because its navigator crashed the process that ran it: signal 11") - 1;
  for (const { values: column } of trials.columns) column[last] = null;
  --summary.outcomes.time_limit;
  summary.outcomes.navigator_fault = 1;
  --endings[0].count;
  endings.push({ outcome: "navigator_fault", detail: trials.detail_texts[trials.detail[last]], count: 1, limit: false });
  for (const at_risk of Object.keys(payload.runs[3].cdf.at_risk)) --payload.runs[3].cdf.at_risk[at_risk];
});

pageTest("the means of a counter stand along the axis of the sweep, and in the table of cells", "own.html", async (page) => {
  const figure = page.locator("#own-0-mine-replans");
  assert.match(await figure.innerText(), /Plans made anew\. Each mark is the mean/);
  await figure.locator("svg").waitFor();
  assert.equal(await figure.locator("svg g[data-mark=dot] path, svg g[data-mark=dot] circle").count(), MEANS.length);
  const rows = await values(await numbersOf(page, "own-0-mine-replans"));
  assert.deepEqual(rows.map((row) => row.slice(1, 4).map(Number)), MEANS.map((mean, i) => [ABUNDANCES[i], TRIALS, mean]));
  const cells = await values(page.locator("#own-curves .section-body > .table-box table"));
  assert.deepEqual(cells.map((row) => row[1]), ["–", "–", "2", "5"]);
});

pageTest("a counter has a distribution in the runs whose navigator counts", "own.html", async (page) => {
  const figure = page.locator("#histogram-mine-replans");
  await figure.locator("svg").waitFor();
  const text = await figure.innerText();
  assert.match(text, /replans \(mine\)/);
  assert.match(text, /Share of trials by replans \(mine\): Plans made anew\./);
  assert.equal(await figure.locator("svg").getAttribute("role"), "img");
});

test("a page without counters has neither part", async () => {
  const { page } = await open("plain.html");
  assert.equal(await page.locator("#own-curves, #own-values").count(), 0);
});

pageTest("trials are searched by a counter, whose name has a dot", "own.html", async (page) => {
  await openTrials(page);
  await page.locator("#trials input[type=search]").fill(`${OWN}>=5`);
  await page.waitForFunction(() => document.querySelectorAll("#trials .tabulator-row").length === 1);
});

pageTest("a navigator's fault is an outcome with its cause in words", "own.html", async (page) => {
  const text = await page.locator("#outcomes").innerText();
  assert.match(text, /navigator fault/);
  assert.match(text, /Its navigator failed: the plugin or process that decides where it drives\./);
  assert.match(await page.locator("#goal-incidence, #distance-cdf").first().innerText(),
    /Of 1 drive of .* no distance is known, since the navigator ended the process that ran it\./);
});

test("causes are known by the sentence, whatever a navigator said behind it", async () => {
  const { causeWords, outcomeSentence } = await loadModule("shared/outcomes.ts");
  const crash = "stopped because its navigator crashed the process that ran it";
  assert.equal(causeWords("navigator_fault", crash), "stopped, since the navigator crashed");
  assert.equal(causeWords("navigator_fault", `${crash}: signal 11: again`), causeWords("navigator_fault", crash));
  assert.equal(causeWords("navigator_fault", "of another version"), "stopped, since the navigator failed");
  assert.notEqual(outcomeSentence("navigator_fault"), "");
  const { columnLabel, columnWords, isOwnColumn } = await loadModule("report/words.ts");
  assert.equal(columnWords("my_own.plans_made"), "plans made (my own)");
  assert.equal(columnLabel("mine.waited_s", "s"), "waited (mine) [s]");
  assert.ok(isOwnColumn("mine.waited_s") && !isOwnColumn("waited_s"));
});
