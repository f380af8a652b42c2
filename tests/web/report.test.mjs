// The report page of one run in a browser: what it shows is what the run folder holds.
import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import path from "node:path";
import { test } from "node:test";
import { at, csv, rockyard } from "./harness.mjs";
import { payloadOf } from "./page_payload.mjs";
import { assertNear, look, numbersOf, open, openTrials, pageTest, runNominal, SIX_DIGITS, values } from "./report_pages.mjs";

const TRIALS = 12;
const REPLAYS = 2;

const json = (...names) => JSON.parse(readFileSync(at(...names), "utf8"));
runNominal("nominal", TRIALS, 1);
rockyard(["report", at("nominal"), "--out", at("one.html"), "--replays", `${REPLAYS}`,
  "--against", "results/reference/matthies1995.json"]);

/** The worst failed trials, and one of each outcome. */
function replayed() {
  const failed = csv(at("nominal", "trials.csv")).filter(({ outcome }) => outcome !== "goal_reached");
  const worst = failed.sort((a, b) => Number(b.true_goal_distance_m) - Number(a.true_goal_distance_m)).slice(0, REPLAYS);
  return new Set([...worst.map(({ trial }) => Number(trial)), ...payloadOf(at("one.html")).runs[0].examples]);
}

test("opens from disk, asks for nothing else and complains of nothing", async () => {
  const { page, requests, url } = await open("one.html");
  await openTrials(page);
  await page.locator("#distance-cdf svg").waitFor();
  assert.deepEqual(requests, [url]);
  assert.equal(await page.locator(".problem").count(), 0);
});

pageTest("the headline is that of summary.json", look, async (page) => {
  const { declared_success: declared, true_success: truly, distance_m: distance } = json("nominal", "summary.json");
  const [row] = await values(page.locator("#headline .headline-table"));
  assert.equal(Number(row[1]), TRIALS);
  assert.equal(Number(row[2]), declared.rate);
  assert.equal(Number(row[4]), truly.rate);
  assert.equal(Number(row[6]), distance.median);
  const ends = await page.locator("#headline [data-low]").evaluateAll((all) =>
    all.map(({ dataset }) => [Number(dataset.low), Number(dataset.high)]));
  assert.deepEqual(ends, [declared.ci95, truly.ci95]);
  const method = { wilson: /Wilson/, clopper_pearson: /Clopper-Pearson/ }[declared.ci_method];
  assert.match(await page.locator("#headline").innerText(), method);
});

pageTest("the distance curve has the steps of distance_cdf.csv, in its drawing too", look, async (page) => {
  const steps = csv(at("nominal", "distance_cdf.csv"));
  const rows = await values((await numbersOf(page, "distance-cdf")).first());
  assert.equal(rows.length, steps.length);
  rows.forEach((row, i) => {
    ["distance_m", "ecdf", "ecdf_low", "ecdf_high"].forEach((column, j) => {
      assertNear(row[j], Number(steps[i][column]), SIX_DIGITS, `${column} of step ${i}`);
    });
  });
  // Heights of the drawn line, as shares of its axis.
  const lines = await page.locator("#distance-cdf svg g[data-mark=line] path").evaluateAll((paths) =>
    paths.map((each) => each.getAttribute("d")));
  assert.equal(lines.length, 1);
  const ys = [...new Set([...lines[0].matchAll(/,(-?[\d.]+)/g)].map((match) => Number(match[1])))];
  const [bottom, top] = [Math.max(...ys), Math.min(...ys)];
  const drawn = ys.map((y) => (bottom - y) / (bottom - top)).sort((a, b) => a - b);
  const expected = [0, ...steps.map((step) => Number(step.ecdf))];
  assert.equal(drawn.length, expected.length);
  drawn.forEach((share, i) => assert.ok(Math.abs(share - expected[i]) < 1e-3, `step ${i} is drawn at ${share}`));
});

pageTest("distributions count the trials of trials.csv and state summary.json", look, async (page) => {
  const trials = csv(at("nominal", "trials.csv"));
  const { dead_reckoning: errors, sim_time_s, energy_wh } = json("nominal", "summary.json");
  for (const [column, summary] of Object.entries({ ...errors, sim_time_s, energy_wh })) {
    const tables = await numbersOf(page, `histogram-${column}`);
    const [stated] = await values(tables.nth(0));
    const names = ["count", "min", "p05", "median", "mean", "mode", "p95", "max", "std"];
    names.forEach((name, i) => assert.equal(Number(stated[i + 1]), summary[name], `${name} of ${column}`));
    const all = trials.map((trial) => Number(trial[column]));
    let counted = 0;
    for (const [from, to, count] of (await values(tables.nth(1))).map((row) => row.map(Number))) {
      assert.equal(count, all.filter((value) => value >= from && value < to).length, `${column} from ${from}`);
      counted += count;
    }
    assert.equal(counted, TRIALS);
  }
});

pageTest("outcomes are counted as in summary.json, and a count shows its trials", "one.html", async (page) => {
  const expected = Object.entries(json("nominal", "summary.json").outcomes).filter(([, count]) => count > 0);
  const shown = await page.locator("#outcomes button.count").evaluateAll((all) =>
    all.map(({ dataset }) => [dataset.outcome, Number(dataset.value)]));
  assert.deepEqual(new Map(shown), new Map(expected));
  const [name, count] = expected[0];
  await page.locator(`#outcomes button[data-outcome=${name}]`).click();
  await page.waitForSelector("#trials .tabulator-row");
  assert.equal(await page.locator("#trials-found").innerText(), `${count} of ${TRIALS} trials`);
  const cells = await page.locator("#trials .tabulator-row [tabulator-field=outcome]").allInnerTexts();
  assert.deepEqual(cells, new Array(count).fill(name.replaceAll("_", " ")));
});

pageTest("trials are sorted by a header and found by words, numbers and conditions", "one.html", async (page) => {
  await openTrials(page);
  const trials = csv(at("nominal", "trials.csv"));
  const order = () => page.locator("#trials .tabulator-row [tabulator-field=trial]").allInnerTexts();
  const byDistance = trials.map(({ trial, true_distance_m }) => [Number(true_distance_m), trial]).sort((a, b) => a[0] - b[0]);
  const header = page.getByRole("button", { name: /true distance/i }).first();
  await header.click();
  assert.deepEqual(await order(), byDistance.map(([, trial]) => trial));
  await header.press("Enter");
  assert.deepEqual(await order(), byDistance.map(([, trial]) => trial).reverse());
  const found = async (text) => {
    await page.locator("#trial-search").fill(text);
    return (await order()).map(Number).sort((a, b) => a - b);
  };
  const energies = trials.map(({ energy_wh }) => Number(energy_wh)).sort((a, b) => a - b);
  const limit = (energies[3] + energies[4]) / 2;
  const above = trials.filter(({ energy_wh }) => Number(energy_wh) > limit).map(({ trial }) => Number(trial));
  assert.deepEqual(await found(`energy_wh>${limit}`), above);
  const goals = trials.filter(({ outcome }) => outcome === "goal_reached").map(({ trial }) => Number(trial));
  assert.deepEqual(await found("goal_reached"), goals);
  assert.deepEqual(await found(`energy_wh>${limit} goal_reached`), above.filter((trial) => goals.includes(trial)));
  assert.deepEqual(await found("no such word"), []);
  await page.getByRole("button", { name: "Show all" }).click();
  assert.equal((await order()).length, TRIALS);
});

pageTest("columns are chosen, and a chosen one shows what trials.csv holds", "one.html", async (page) => {
  await openTrials(page);
  await page.locator("#trials details > summary").click();
  await page.locator("#trials input[value=rocks]").check();
  const cells = page.locator("#trials .tabulator-row [tabulator-field=v_rocks]");
  assert.deepEqual(await cells.allInnerTexts(), csv(at("nominal", "trials.csv")).map(({ rocks }) => rocks));
  await page.locator("#trials input[value=rocks]").uncheck();
  assert.equal(await cells.first().isVisible(), false);
});

pageTest("every trial has its replay: a page that is there, or the command", look, async (page) => {
  await openTrials(page);
  const links = page.locator("#trials .tabulator-row a");
  const targets = await links.evaluateAll((all) => all.map((link) => link.getAttribute("href")));
  assert.equal(targets.length, replayed().size);
  const named = await page.locator("#trials .replay-pages a").evaluateAll((all) => all.map((link) => link.getAttribute("href")));
  assert.deepEqual(named, targets);
  for (const target of targets) assert.ok(existsSync(at(target)), `${target} is missing`);
  const button = page.locator("#trials .command-button").first();
  const trial = await button.locator("xpath=ancestor::*[@role='row']").locator("[tabulator-field=trial]").innerText();
  await button.click();
  const command = await page.locator(".replay-command code").innerText();
  assert.match(command, new RegExp(`^rockyard replay .*nominal.* --trial ${trial}$`));
});

pageTest("published values stand with their verdicts", look, async (page) => {
  const { rows } = payloadOf(at("one.html")).runs[0].published;
  const shown = await values(page.locator("#published table"));
  assert.equal(shown.length, rows.length);
  rows.forEach((row, i) => {
    assert.ok(shown[i][0].startsWith(row.what), `${shown[i][0]} is not ${row.what}`);
    assert.equal(shown[i][4], row.verdict);
  });
  const verdicts = new Set(rows.map((row) => row.verdict));
  assert.equal(await page.locator("#published .meanings dd").count(), verdicts.size);
});

pageTest("parameters are counted by origin and filtered", "one.html", async (page) => {
  const { parameters } = payloadOf(at("one.html")).runs[0];
  const rows = page.locator("#parameters .parameter-table tbody tr");
  assert.equal(await rows.count(), parameters.length);
  for (const origin of ["published", "calibrated", "assumed", "setting"]) {
    const count = parameters.filter((each) => each.origin === origin).length;
    assert.equal(await page.locator(`#parameters [data-origin=${origin}]`).getAttribute("data-value"), `${count}`);
    await page.locator("#parameters select").selectOption(origin);
    assert.equal(await rows.count(), count);
  }
  await page.locator("#parameters select").selectOption("");
  await page.locator("#parameter-search").fill("k_per_m2");
  const paths = await rows.locator("th code").allInnerTexts();
  assert.ok(paths.length > 0 && paths.length < parameters.length);
  assert.ok(paths.includes(parameters.find((each) => each.path.includes("k_per_m2")).path));
});
