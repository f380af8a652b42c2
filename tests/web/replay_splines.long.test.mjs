// Splines of a rover that steers while it drives, and how late its plans are: on the page of a drive
// with GESTALT whose decisions get splines.
import assert from "node:assert/strict";
import { test } from "node:test";
import { loadModule } from "./harness.mjs";
import { payloadOf } from "./page_payload.mjs";
import { changed, difference, open, pageTest, pixels, replayOf } from "./replay_pages.mjs";

const KNOTS = [-1, 0, 1];
const CHOSEN = 5;

/** Nine splines of 3 m, of which the motors could not follow the first. */
const splines = () => {
  const pairs = KNOTS.flatMap((first) => KNOTS.map((second) => [first, second]));
  return {
    start: pairs.map(() => 0.2),
    first: pairs.map(([first]) => first),
    second: pairs.map(([, second]) => second),
    length: pairs.map(() => 3),
    hazard: pairs.map((_, i) => 20 * i),
    certainty: pairs.map(() => 255),
    waypoint: pairs.map((_, i) => 30 * i),
    merged: pairs.map((_, i) => 25 * i),
    feasible: pairs.map((_, i) => i !== 0),
    chosen: CHOSEN,
  };
};

const { file } = replayOf("gestalt/narrow_course", "splines");
const withSplines = changed(file, "with_splines.html", ({ steps }) => {
  for (const step of steps) Object.assign(step, { splines: splines(), spline_start: step.believed, votes: [] });
});

test("paths are those of a curvature that is linear between the knots", async () => {
  const { splinePath, drawingOrder } = await loadModule("replay/scene/arcs.ts");
  const one = { ...splines(), start: [0.2], first: [0.8], second: [-0.4], length: [2], merged: [0] };
  const path = splinePath(one, 0);
  // By sums over tenths of a millimetre.
  let [x, y, heading] = [0, 0, 0];
  const step = 1e-4;
  for (let s = step / 2; s < 2; s += step) {
    const curvature = s < 1 ? 0.2 + 0.6 * s : 0.8 - 1.2 * (s - 1);
    x += step * Math.cos(heading + (curvature * step) / 2);
    y += step * Math.sin(heading + (curvature * step) / 2);
    heading += curvature * step;
    if (Math.abs(s + step / 2 - 0.5) > step / 4) continue;
    const quarter = path(0.25);
    for (const [got, wanted] of [[quarter.x, x], [quarter.y, y], [quarter.heading, heading]]) assert.ok(Math.abs(got - wanted) < 1e-4);
  }
  const end = path(1);
  for (const [got, wanted] of [[end.x, x], [end.y, y], [end.heading, heading]]) assert.ok(Math.abs(got - wanted) < 1e-4, `${got} ${wanted}`);
  // Beyond the end it goes straight on.
  const on = path(1.5);
  assert.ok(Math.abs(on.x - end.x - Math.cos(end.heading)) < 1e-9);
  assert.equal(on.heading, end.heading);
  // The chosen one is drawn last, the others by their votes.
  assert.deepEqual(drawingOrder(splines()), [0, 1, 2, 3, 4, 6, 7, 8, CHOSEN]);
});

test("what was seen and planned late lies where it was seen and planned", async () => {
  const { frameOf } = await loadModule("replay/scene/arcs.ts");
  // Seen at (10, 0) while it believed to be at (9, 1), turned by a quarter; planned a metre on.
  const step = {
    look: { t: 0, believed: { x: 9, y: 1, heading: 0 } },
    pose: { x: 10, y: 0, heading: Math.PI / 2 },
    believed: { x: 10, y: 1, heading: 0 },
    spline_start: { x: 11, y: 1, heading: 0 },
  };
  const near = (got, wanted) => got.forEach((value, i) => assert.ok(Math.abs(value - wanted[i]) < 1e-9, `${got} is not ${wanted}`));
  const believed = frameOf(step, false);
  near(believed.place(9, 2), [9, 2]);
  near(believed.ahead(1, 0.5), [11, 1.5]);
  near(believed.along(1, 0.5), [12, 1.5]);
  const truly = frameOf(step, true);
  near(truly.place(9, 2), [9, 0]);
  near(truly.ahead(1, 0.5), [9.5, 2]);
  near(truly.along(1, 0.5), [9.5, 3]);
});

pageTest("says how late a plan is", file, async (page) => {
  const { steps } = payloadOf(file);
  for (const step of steps.slice(0, 3)) {
    assert.ok(step.look.t <= step.t);
    await page.evaluate((t) => {
      rockyardReplay.seek(t);
      rockyardReplay.pose();
    }, step.t);
    const caption = await page.locator(".votes .caption").first().textContent();
    assert.match(caption, new RegExp(`^Decision ${step.step} at .*, ${(step.t - step.look.t).toFixed(2)} s after the look ${step.behind ? "behind" : "ahead"}`));
  }
});

pageTest("draws the splines of a decision and shows their votes", withSplines, async (page) => {
  const { steps } = payloadOf(withSplines);
  await page.evaluate((t) => rockyardReplay.seek(t), steps[2].t);
  await page.keyboard.press("t");
  await page.locator(".layers select").selectOption("off");
  const drawn = await pixels(page);
  await page.locator(".layers label", { hasText: "Splines:" }).locator("input").uncheck();
  assert.ok(difference(drawn, await pixels(page)) > 0.001, "splines");
  assert.equal(await page.locator(".votes .vote").count(), 9);
  assert.equal(await page.locator(".votes .infeasible").count(), 1);
  const chosen = page.locator(".votes .vote.chosen title");
  assert.equal(await chosen.textContent(), "from left 0.20/m over straight to left 1.00/m: merged 125, hazard 100 (certainty 255), waypoint 150");
  assert.match(await page.locator(".votes svg").getAttribute("aria-label"), /chosen: from left 0\.20\/m over straight to left 1\.00\/m$/);
  assert.match(await page.locator(".votes .caption").last().textContent(), /^Rows: curvature in the middle/);
});

test("a decision without a choice says so, and arcs keep their bars", async () => {
  const none = changed(file, "none_chosen.html", ({ steps }) => {
    steps[0].splines = { ...splines(), chosen: -1 };
    steps[0].votes = [];
  });
  const { page } = await open(none);
  const { steps } = payloadOf(none);
  await page.evaluate((t) => rockyardReplay.seek(t), steps[0].t);
  await page.evaluate(() => rockyardReplay.pose());
  assert.equal(await page.locator(".votes .chosen").count(), 0);
  assert.match(await page.locator(".votes svg").getAttribute("aria-label"), /none of these was chosen$/);
  await page.evaluate((t) => rockyardReplay.seek(t), steps[1].t);
  await page.evaluate(() => rockyardReplay.pose());
  assert.equal(await page.locator(".votes .vote").count(), steps[1].votes.length);
  assert.match(await page.locator(".votes .caption").last().textContent(), /^Left arcs stand left/);
});
