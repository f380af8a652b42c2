// What the replay page draws of what a navigator shows: lines and grids of data that are made up.
import assert from "node:assert/strict";
import { test } from "node:test";
import { loadModule } from "./harness.mjs";
import { payloadOf } from "./page_payload.mjs";
import { changed, difference, open, pageTest, pixels, replayOf, seekShare } from "./replay_pages.mjs";

const { MOST_OVERLAY_PIECES, MOST_TRIANGLES } = await loadModule("replay/scene/limits.ts");

const { file } = replayOf("pathfinder/nominal", "plain");
const { motion } = payloadOf(file);
const start = motion.t[0];
const end = motion.t.at(-1);
const when = (share) => start + share * (end - start);

const grid = (name, value) => ({ name, x0: 1, y0: -1, step: 0.25, nx: 8, ny: 8, values: Array.from({ length: 64 }, (_, i) => (i < 8 ? -1 : value(i))) });
const lines = (y) => [
  { name: "path", points: [[1, y], [2, y], [2, y + 0.3]] },
  { name: "<b>tree</b>", points: [[1, y], [1.5, y - 0.4]] },
  { name: "<b>tree</b>", points: [[1, y], [1.5, y - 0.6]] },
];
// The rover believes to be half a metre farther, and turned by a right angle.
const believed = { x: 1.5, y: 0, heading: Math.PI / 2 };
const pose = { x: 1, y: 0, heading: 0 };
const overlay = (share, y, more = {}) => ({
  t: when(share), pose, believed, lines: lines(y), grids: [grid("cost", (i) => 4 * i), grid("age", () => 255)], ...more,
});

const shown = changed(file, "shown.html", (payload) => {
  payload.overlays = { every: 1, shown: [overlay(0.2, 0), overlay(0.5, 0.5), overlay(0.8, 0, { lines: [], grids: [] })] };
});

const drawn = (page) => page.evaluate(() => rockyardReplay.drawing().overlay);
const near = (a, b) => assert.ok(Math.abs(a - b) < 1e-9, `${a}, not ${b}`);

pageTest("a trial of which nothing is shown has no key of it", file, async (page) => {
  assert.equal(payloadOf(file).overlays, null);
  assert.doesNotMatch(await page.locator(".layers").innerText(), /navigator/);
  assert.deepEqual(await drawn(page), { lines: [], grids: [] });
});

pageTest("lines and grid are those of the last decision, and go where nothing is shown any more", shown, async (page) => {
  const at = async (share) => {
    await seekShare(page, share);
    return drawn(page);
  };
  assert.deepEqual(await at(0.1), { lines: [], grids: [] });
  const early = await at(0.3);
  assert.deepEqual(early.lines.map(({ name }) => name), ["path", "<b>tree</b>", "<b>tree</b>"]);
  assert.deepEqual(early.grids, ["cost"]);
  const [path] = early.lines;
  assert.deepEqual([path.points[0].x, path.points[0].y], [1, 0]);
  near(path.points.at(-1).x, 2);
  near(path.points.at(-1).y, 0.3);
  near((await at(0.6)).lines[0].points[0].y, 0.5);
  assert.deepEqual(await at(0.9), { lines: [], grids: [] });
});

pageTest("all lies in the believed world, and at the true pose where that is asked for", shown, async (page) => {
  await seekShare(page, 0.3);
  await page.getByLabel("At the true pose").check();
  const { points } = (await drawn(page)).lines[0];
  // (1, 0) is half a metre behind the believed x, which is to the left of a rover that believes to head along y.
  near(points[0].x, 1);
  near(points[0].y, 0.5);
  near(points.at(-1).x, 1.3);
  near(points.at(-1).y, -0.5);
});

pageTest("a switch and a list hide it, and pictures differ", shown, async (page) => {
  await page.keyboard.press("t");
  await seekShare(page, 0.3);
  const all = await pixels(page);
  const list = page.locator(".layers").getByLabel("Its grid");
  await list.selectOption({ label: "age" });
  assert.deepEqual((await drawn(page)).grids, ["age"]);
  assert.ok(difference(all, await pixels(page)) > 0.002, "another grid");
  await list.selectOption({ label: "off" });
  assert.deepEqual((await drawn(page)).grids, []);
  const withLines = await pixels(page);
  assert.ok(difference(all, withLines) > 0.002, "no grid");
  await page.getByLabel("What the navigator shows").uncheck();
  assert.deepEqual(await drawn(page), { lines: [], grids: [] });
  assert.ok(difference(withLines, await pixels(page)) > 0.0005, "no lines");
  await page.getByLabel("What the navigator shows").check();
  await list.selectOption({ label: "cost" });
  assert.equal(difference(all, await pixels(page)), 0);
});

test("the key has each name once, as text, in its colour, in light and in dark", async () => {
  const colours = [];
  for (const scheme of ["light", "dark"]) {
    const { page } = await open(shown, { scheme });
    assert.equal(await page.locator(".overlay-lines").innerText().then((text) => text.replace(/\s+/g, " ").trim()), "path <b>tree</b>");
    colours.push(...(await page.locator(".overlay-lines path").evaluateAll((paths) => paths.map((path) => getComputedStyle(path).stroke))));
  }
  assert.equal(new Set(colours).size, 4, `${colours}`);
});

test("the plan without WebGL shows it as well", async () => {
  const { page } = await open(shown, { withoutWebGl: true });
  assert.match(await page.textContent(".picture"), /no WebGL/);
  await seekShare(page, 0.3);
  const all = await pixels(page);
  await page.locator(".layers").getByLabel("Its grid").selectOption({ label: "off" });
  const withLines = await pixels(page);
  assert.ok(difference(all, withLines) > 0.002, "grid");
  await page.getByLabel("What the navigator shows").uncheck();
  assert.ok(difference(withLines, await pixels(page)) > 0.0005, "lines");
  await page.getByLabel("What the navigator shows").check();
  await page.locator(".layers").getByLabel("Its grid").selectOption({ label: "cost" });
  await page.getByLabel("At the true pose").check();
  assert.ok(difference(all, await pixels(page)) > 0.002, "moved");
});

test("very many lines and cells keep to the triangles of a picture", async () => {
  const side = 600;
  const crowd = changed(shown, "crowd.html", (payload) => {
    const tree = Array.from({ length: 3 * MOST_OVERLAY_PIECES }, (_, i) => ({ name: `branch ${i % 20}`, points: [[1, 0], [1 + 0.001 * i, 0.5]] }));
    const fine = { name: "fine", x0: 0, y0: -3, step: 0.01, nx: side, ny: side, values: Array.from({ length: side * side }, (_, i) => i % 256) };
    payload.overlays = { every: 4, shown: [{ t: start, pose, believed, lines: tree, grids: [fine] }] };
  });
  const { page } = await open(crowd);
  await seekShare(page, 0.5);
  const { triangles, calls, grids, branches } = await page.evaluate(() => {
    const { overlay: { grids, lines }, ...counts } = rockyardReplay.drawing();
    return { ...counts, grids, branches: lines.length };
  });
  assert.deepEqual(grids, ["fine"]);
  assert.equal(branches, 3 * MOST_OVERLAY_PIECES);
  assert.ok(triangles <= MOST_TRIANGLES, `${triangles} triangles`);
  assert.ok(calls <= 250, `${calls} calls`);
  const key = await page.locator(".layers").innerText();
  assert.match(key, /and 8 more/);
  assert.match(key, /one overlay out of 4/);
});

test("what is too large for a page is said to be", async () => {
  const none = changed(file, "none.html", (payload) => (payload.overlays = { every: 2, shown: [] }));
  const { page } = await open(none);
  assert.match(await page.locator(".layers").innerText(), /too large for a page/);
});
