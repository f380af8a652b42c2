// What the report of one run begins with: the answer, the map, causes and examples, as the run's files have them.
import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { test } from "node:test";
import { at, csv, rockyard } from "./harness.mjs";
import { payloadOf, withPayload } from "./page_payload.mjs";
import { look, numbersOf, open, pageTest, runNominal, values } from "./report_pages.mjs";

const TRIALS = 60;
const TRACKS = 25;
const PHONE = { width: 390, height: 844 };

const summary = () => JSON.parse(readFileSync(at("nominal", "summary.json"), "utf8"));
const trials = () => csv(at("nominal", "trials.csv"));
const run = (name = "one.html") => payloadOf(at(name)).runs[0];

runNominal("nominal", TRIALS, 1, "terrain.rocks.k_per_m2=0.008");
rockyard(["report", at("nominal"), "--out", at("one.html"), "--tracks", `${TRACKS}`, "--replays", "1"]);
rockyard(["report", at("nominal"), "--out", at("none.html"), "--tracks", "0", "--replays", "0"]);

const numbers = (locator) => locator.evaluateAll((all) => all.map(({ dataset }) => Number(dataset.value)));

/** Trials of each outcome, or of each detail, of the failed ones. */
function counts(of, rows = trials()) {
  const found = new Map();
  for (const row of rows) found.set(row[of], (found.get(row[of]) ?? 0) + 1);
  return found;
}

pageTest("the page begins with both rates and their intervals, as summary.json has them", look, async (page) => {
  const { declared_success: declared, true_success: truly } = summary();
  assert.equal(await page.locator("section").first().getAttribute("id"), "answer");
  assert.deepEqual(await numbers(page.locator(".answer [data-value]")), [declared.rate, declared.trials, truly.rate]);
  const ends = await page.locator(".answer [data-low]").evaluateAll((all) =>
    all.map(({ dataset }) => [Number(dataset.low), Number(dataset.high)]));
  assert.deepEqual(ends, [declared.ci95, truly.ci95]);
  const text = await page.locator(".answer").innerText();
  assert.match(text, /^Rocky 3\.2 declared arrival in \d+\s% of 60 drives \(95 % interval \d+ to \d+\), and truly was at the goal in \d+\s% \(\d+ to \d+\)\.$/);
  assert.equal(text.match(/95 %/g).length, 1);
  assert.match(await page.locator("#answer .note").innerText(), /Scenario nominal, navigator pathfinder, terrain sensor light stripe, localization by dead reckoning/);
});

test("a rover of another shape is not called by a name", async () => {
  runNominal("other", 3, 1, "rover.geometry.wheelbase_m=0.5");
  rockyard(["report", at("other"), "--out", at("other.html"), "--tracks", "0", "--replays", "0"]);
  const { page } = await open("other.html");
  assert.match(await page.locator(".answer").innerText(), /^The rover declared/);
});

const isLimit = ({ cause }) => /^patience_|^time_limit$/.test(cause);

pageTest("drives that a limit ended are counted apart, with the success that hangs on them", look, async (page) => {
  const ended = trials().filter(isLimit).length;
  const declared = trials().filter(({ outcome }) => ["goal_reached", "false_goal"].includes(outcome)).length;
  assert.ok(ended > 0);
  assert.deepEqual(await numbers(page.locator(".answer-limits [data-value]")),
    [ended, declared / trials().length, (declared + ended) / trials().length]);
  assert.match(await page.locator("#goal-incidence").innerText(), /Dotted: the same if every drive that a limit/);
  await page.locator("#goal-incidence summary").first().click();
  const row = await page.locator("#goal-incidence table tbody tr").last().locator("td").evaluateAll((all) => all.map(({ dataset }) => Number(dataset.value)));
  assert.ok(Math.abs(row.at(-1) - (declared + ended) / trials().length) < 1e-5, String(row));
});

pageTest("causes of failed drives are those of trials.csv, the largest first", look, async (page) => {
  const failed = trials().filter((trial) => trial.outcome !== "goal_reached" && !isLimit(trial));
  const expected = [...counts("detail", failed).values()].sort((a, b) => b - a);
  const [total, ...shown] = await numbers(page.locator(".answer-causes [data-value]"));
  assert.equal(total, failed.length);
  assert.ok(expected.length > 1);
  const named = expected.length === 5 ? 5 : 4;
  const rest = expected.slice(named).reduce((sum, count) => sum + count, 0);
  assert.deepEqual(shown, [...expected.slice(0, named), ...(rest > 0 ? [rest] : [])]);
  const bars = await page.locator("#outcomes [data-cause-count]").evaluateAll((all) => all.map(({ dataset }) => Number(dataset.causeCount)));
  assert.deepEqual(bars.sort((a, b) => b - a), [...counts("detail").values()].sort((a, b) => b - a));
});

pageTest("the map has the end of every trial, and the true paths of those that were driven again", look, async (page) => {
  const { tracks, first_tracks: first } = run();
  assert.equal(first, TRACKS);
  const outcomes = counts("outcome");
  const drawn = counts("outcome", trials().filter(({ trial }) => tracks.some((track) => track.trial === Number(trial))));
  for (const [outcome, ends, paths] of await values((await numbersOf(page, "map-0")).first())) {
    const name = outcome.replaceAll(" ", "_");
    assert.equal(Number(ends), outcomes.get(name), outcome);
    assert.equal(Number(paths), drawn.get(name) ?? 0, outcome);
    const marks = await page.locator(`#map-0 g[data-outcome=${name}] .map-marks`).getAttribute("d");
    assert.equal(marks.match(/M/g).length, outcomes.get(name), outcome);
    outcomes.delete(name);
  }
  assert.equal(outcomes.size, 0);
  for (const { trial, pieces_cm } of tracks) {
    const row = trials()[trial];
    const last = pieces_cm.at(-1).slice(-2);
    assert.ok(Math.hypot(last[0] / 100 - row.final_x_m, last[1] / 100 - row.final_y_m) < 0.01, `trial ${trial} ends elsewhere`);
    const length = pieces_cm.reduce((sum, piece) => sum + lengthOf(piece), 0) / 100;
    // Corners are whole centimetres, which adds a little where a rover rocks on a stone.
    assert.ok(length <= Number(row.true_distance_m) * 1.03 + 0.02 && length > 0.8 * row.true_distance_m, `trial ${trial} is ${length} m long`);
  }
});

function lengthOf(piece) {
  let sum = 0;
  for (let i = 2; i < piece.length; i += 2) sum += Math.hypot(piece[i] - piece[i - 2], piece[i + 1] - piece[i - 1]);
  return sum;
}

pageTest("the key hides an outcome, by keyboard too, and it stays hidden at another width", "one.html", async (page) => {
  const box = page.locator("#map-0 .map-key input").first();
  const layer = page.locator("#map-0 svg.plan g[data-outcome]").first();
  assert.equal(await layer.isVisible(), true);
  await box.focus();
  await page.keyboard.press("Space");
  assert.equal(await layer.isVisible(), false);
  await page.setViewportSize({ width: 700, height: 900 });
  await page.waitForFunction(() => Number(document.querySelector("#map-0 svg.plan").getAttribute("width")) < 700);
  assert.equal(await layer.isVisible(), false);
  await box.check();
  assert.equal(await layer.isVisible(), true);
});

test("without tracks the map has the ends alone, and says so", async () => {
  assert.deepEqual(run("none.html").tracks, []);
  const { page } = await open("none.html");
  assert.match(await page.locator("#map-0 figcaption").innerText(), /of 60 trials.*No paths were driven/);
  assert.equal(await page.locator("#map-0 .map-lines[d='']").count(), counts("outcome").size);
});

pageTest("each outcome has an example, the trial of median distance, with plan and replay", look, async (page) => {
  const medians = [...counts("outcome").keys()].map((outcome) => {
    const rows = trials().filter((row) => row.outcome === outcome).sort((a, b) => a.true_distance_m - b.true_distance_m);
    return [outcome, Number(rows[Math.floor((rows.length - 1) / 2)].trial)];
  });
  const cards = await page.locator(".example").evaluateAll((all) => all.map((card) =>
    [card.dataset.outcome, Number(card.dataset.trial)]));
  assert.deepEqual(new Map(cards), new Map(medians));
  assert.equal(cards.length, medians.length);
  for (const [, trial] of cards) {
    const card = page.locator(`.example[data-trial="${trial}"]`);
    assert.equal(await card.locator("svg.plan .map-lines").count(), 1);
    assert.ok((await card.locator("svg.plan .plan-rock").count()) > 10);
    assert.ok(existsSync(at(await card.locator("a").getAttribute("href"))), `trial ${trial}`);
  }
});

pageTest("on a phone answer, map and the commonest cause are on the first two screens", "one.html", async (page) => {
  const bottom = async (selector) => {
    const { y, height } = await page.locator(selector).first().boundingBox();
    return y + height;
  };
  assert.ok((await bottom("#answer")) < PHONE.height);
  assert.ok((await bottom("#map-0 svg.plan")) < 1.5 * PHONE.height);
  assert.ok((await bottom("#outcomes tbody tr")) < 2 * PHONE.height);
}, PHONE);

test("a page of ten thousand trials stays below 5 MB with its tracks", () => {
  withPayload(at("one.html"), at("many.html"), ({ runs: [{ trials: table, tracks }] }) => {
    const repeat = (list) => Array.from({ length: 10_000 }, (_, i) => list[i % list.length]);
    for (const name of ["outcome", "detail"]) table[name] = repeat(table[name]);
    table.trial = Array.from({ length: 10_000 }, (_, i) => i);
    // Last digits differ from trial to trial, so that compression finds no more than in a real run.
    for (const column of table.columns) {
      column.values = repeat(column.values).map((value, i) => Number.isInteger(value) || value === null ? value : Number((value * (1 + 1e-3 * Math.sin(i))).toPrecision(6)));
    }
    while (tracks.length < 120) tracks.push(...tracks.slice(0, 120 - tracks.length));
  });
  assert.ok(readFileSync(at("many.html")).length < 5e6);
});
