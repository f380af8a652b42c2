// What the report says of its own numbers: which trials they are of, and what they take for granted.
import assert from "node:assert/strict";
import path from "node:path";
import { test } from "node:test";
import { at, rockyard } from "./harness.mjs";
import { withPayload } from "./page_payload.mjs";
import { numbersOf, open, openTrials, pageTest, runNominal, values } from "./report_pages.mjs";

const TRIALS = 20;
const RATED = 5;

runNominal("nominal", TRIALS, 2);
rockyard(["report", at("nominal"), "--out", at("report.html"), "--replays", "0"]);

/** The first run without trial number RATED: what comes after it is in no rate. */
function withGap({ runs: [run] }) {
  const { trials, summary } = run;
  for (const list of [trials.trial, trials.outcome, trials.detail, ...trials.columns.map((column) => column.values)]) list.splice(RATED, 1);
  run.prefix_trials = RATED;
  summary.outcomes = {};
  for (const outcome of trials.outcome.slice(0, RATED)) {
    const name = trials.outcome_names[outcome];
    summary.outcomes[name] = (summary.outcomes[name] ?? 0) + 1;
  }
  Object.assign(summary.accounting, { completed: TRIALS - 1, pending: 1 });
}

test("beyond a gap trials are in the table and in nothing else", async () => {
  withPayload(at("report.html"), at("gap.html"), withGap);
  const { page } = await open("gap.html");
  assert.match(await page.locator("#about").innerText(), /19 of 20 completed, 1 pending, rates from the first 5/);
  assert.match(await page.locator("#headline").innerText(), /of the first 5 trials, up to one that is still to be run/);
  const bins = await values((await numbersOf(page, "histogram-sim_time_s")).nth(1));
  assert.equal(bins.reduce((sum, row) => sum + Number(row[2]), 0), RATED);
  const buttons = await page.locator("#outcomes button.count").all();
  let shown = 0;
  for (const button of buttons) {
    await button.click();
    await page.waitForSelector("#trials .tabulator-row");
    const count = await button.getAttribute("data-value");
    assert.equal(await page.locator("#trials-found").innerText(), `${count} of ${TRIALS - 1} trials`);
    shown += Number(count);
  }
  assert.equal(shown, RATED);
  await page.getByRole("button", { name: "Show all" }).click();
  const marks = await page.locator("#trials .tabulator-row [tabulator-field=unrated]").allInnerTexts();
  assert.deepEqual(marks.map((mark) => mark.trim()), Array.from({ length: TRIALS - 1 }, (_, i) => (i < RATED ? "" : "not in the rates")));
});

pageTest("without a gap the page does not speak of one", "report.html", async (page) => {
  await openTrials(page);
  assert.doesNotMatch(await page.locator("#page").innerText(), /rates from the first|in the rates/);
  assert.equal(await page.locator("#headline .caution").count(), 0);
});

test("a run that was stopped by its rate has the interval that allows for it", async () => {
  withPayload(at("report.html"), at("until.html"), ({ runs: [{ summary }] }) => {
    summary.stopping = {
      rule: "until_half_width", half_width: 0.2, max_trials: 10000, block: 20, confidence: 0.95, end: "precise", trials: 60,
      declared_success: { count: 39, trials: 60 }, interval: [0.441, 0.825],
    };
    summary.declared_success.ci95 = [0.441, 0.825];
    summary.declared_success.ci_method = "clopper_pearson_stopped";
  });
  const { page } = await open("until.html");
  const declared = page.locator("#headline [data-low]").first();
  assert.deepEqual(await declared.evaluate(({ dataset }) => [dataset.low, dataset.high]), ["0.441", "0.825"]);
  const text = await page.locator("#headline").innerText();
  assert.equal(text.match(/\d to \d+\.\d\s%/g).length, 2, "one interval for each of the two rates");
  assert.match(text, /Clopper-Pearson, for trials that their half-width ends/);
  assert.match(text, /looked at every 20 trials.*precise enough after 60/);
});

test("trials that share layouts are said to, under the rates and both curves of distance", async () => {
  withPayload(at("report.html"), at("shared.html"), ({ runs: [run] }) => {
    run.shared_layouts = true;
  });
  for (const [name, count] of [["shared.html", 1], ["report.html", 0]]) {
    const { page } = await open(name);
    for (const place of ["#headline", "#distance-cdf figcaption", "#goal-incidence figcaption"]) {
      assert.equal((await page.locator(place).innerText()).split("share layouts").length - 1, count, `${place} of ${name}`);
    }
  }
});

test("a curve that was thinned says so", async () => {
  withPayload(at("report.html"), at("thinned.html"), ({ runs: [run] }) => {
    run.cdf_steps = 10 * run.cdf.distance_m.length;
  });
  for (const [name, said] of [["thinned.html", true], ["report.html", false]]) {
    const { page } = await open(name);
    assert.equal(/distance_cdf\.csv has all/.test(await page.locator("#distance-cdf figcaption").innerText()), said, name);
  }
});

test("the band of arrivals is where it has a width, and the trials that still drive are below", async () => {
  withPayload(at("report.html"), at("arrivals.html"), ({ runs: [run] }) => {
    run.cdf = {
      distance_m: [4, 6, 8, 10], ecdf: [0.25, 0.5, 0.75, 1], ecdf_low: [0, 0, 0.2, 0.4], ecdf_high: [0.8, 1, 1, 1],
      goal: [0, 0.25, 0.25, 0.5], goal_low: [0, 0.05, 0.05, 0.1], goal_high: [0, 0.6, 0.6, 0.8], at_risk: [4, 3, 2, 1],
    };
  });
  const { page } = await open("arrivals.html");
  const rows = await values(await numbersOf(page, "goal-incidence"));
  assert.deepEqual(rows.map((row) => row.slice(1)), [
    ["0", "–", "–", "4"], ["0.25", "0.05", "0.6", "3"], ["0.25", "0.05", "0.6", "2"], ["0.5", "0.1", "0.8", "1"],
  ]);
  const left = (mark) => page.locator(`#goal-incidence svg g[data-mark=${mark}] path`).first().evaluate((path) => path.getBBox().x);
  assert.ok((await left("area")) > (await left("line")) + 50, "a band before the first arrival");
  const texts = await page.locator("#goal-incidence svg g[data-mark=text] text").allTextContents();
  assert.ok(["still driving", "4", "3", "2", "1"].every((text) => texts.includes(text)), texts.join());
});

test("a limit that trials came to is marked, with how many", async () => {
  withPayload(at("report.html"), at("limits.html"), ({ runs: [run] }) => {
    run.trials.columns.find((column) => column.name === "energy_wh").values = Array.from({ length: TRIALS }, (_, i) => (i < 3 ? 50 : 20 + i));
    run.parameters.find((each) => each.path === "energy.battery_wh").value = "50";
    run.trials.columns.find((column) => column.name === "sim_time_s").values = Array.from({ length: TRIALS }, (_, i) => 100 + i);
  });
  const { page } = await open("limits.html");
  assert.match(await page.locator("#histogram-energy_wh figcaption").innerText(), /batteries are empty: 3 of 20 trials lie at or beyond it/);
  assert.ok((await page.locator("#histogram-energy_wh svg text").allTextContents()).includes("batteries empty 50"));
  assert.doesNotMatch(await page.locator("#histogram-sim_time_s figcaption").innerText(), /time limit/);
});

pageTest("on paper the page is light, whatever the switch says", "report.html", async (page) => {
  const ground = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const light = await ground();
  await page.locator(".theme-switch").click();
  assert.notEqual(await ground(), light);
  await page.emulateMedia({ media: "print" });
  assert.equal(await ground(), light);
}, { scheme: "light" });

test("a report that compares with nothing published says why", async () => {
  const why = "looked in <b>results/reference</b>: no file";
  withPayload(at("report.html"), at("unpublished.html"), (payload) => {
    for (const run of payload.runs) run.published = null;
    payload.why_none_published = why;
  });
  const { page } = await open("unpublished.html");
  assert.match(await page.locator("#published").innerText(), /looked in <b>results\/reference<\/b>: no file/);
});
