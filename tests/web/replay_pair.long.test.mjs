// Two trials on one page: one clock, two pictures, each as its own record says.
import assert from "node:assert/strict";
import { statSync } from "node:fs";
import { test } from "node:test";
import { at, loadModule, rockyard } from "./harness.mjs";
import { payloadOf } from "./page_payload.mjs";
import { MOST_BYTES, open, pageTest, time } from "./replay_pages.mjs";

const run = (name, ...settings) => rockyard(["run", "scenarios/pathfinder/nominal.json", "--trials", "3", "--threads", "1",
  "--set", "rover.fidelity=quasi_static", ...settings, "--out", at(name)]);
run("one");
run("two", "--set", "sensors.gyro.scale=0.8");
const pair = at("pair.html");
rockyard(["replay", at("one"), "--trial", "2", "--with", at("two"), "--out", pair]);

test("what stands in both drives is shortened, and nothing else", async () => {
  const { common } = await loadModule("replay/player.ts");
  const stretch = (from, to) => ({ from, to });
  assert.deepEqual(common([stretch(0, 10), stretch(20, 30)], [stretch(5, 25)]), [stretch(5, 10), stretch(20, 25)]);
  assert.deepEqual(common([stretch(0, 10)], [stretch(10, 20)]), []);
  assert.deepEqual(common([], [stretch(0, 1)]), []);
});

test("both are drawn from disk, with one player whose end is that of the longer drive", async () => {
  assert.ok(statSync(pair).size < 2 * MOST_BYTES);
  const payload = payloadOf(pair);
  const ends = [payload, payload.beside].map(({ motion }) => motion.t[motion.t.length - 1]);
  assert.notEqual(ends[0], ends[1]);
  const { page, requests } = await open(pair, { width: 1400 });
  assert.equal(await page.locator(".picture canvas").count(), 2);
  assert.equal(await page.locator(".transport").count(), 1);
  assert.equal(await page.locator(".timeline").count(), 2);
  await page.keyboard.press("End");
  assert.equal(await time(page), Math.max(...ends));
  await page.waitForFunction(() => [...document.querySelectorAll(".ending")].every((card) => !card.hidden));
  assert.equal(requests.length, 1);
});

test("each tells its own drive at the common time, also after it has ended", async () => {
  const payload = payloadOf(pair);
  const both = [payload, payload.beside];
  const { page } = await open(pair, { width: 1400 });
  const shorter = Math.min(...both.map(({ motion }) => motion.t[motion.t.length - 1]));
  for (const t of [shorter / 2, shorter + 1]) {
    await page.evaluate((at) => (rockyardReplay.seek(at), rockyardReplay.pose()), t);
    const shown = await page.locator(".readout > dl").evaluateAll((lists) => lists.map((list) =>
      [...list.querySelectorAll("dt")].find((name) => name.textContent === "True pose").nextSibling.textContent.replaceAll("−", "-")));
    both.forEach(({ motion }, k) => {
      const i = motion.t.findLastIndex((each) => each <= t);
      const next = Math.min(i + 1, motion.t.length - 1);
      const span = motion.t[next] - motion.t[i];
      const share = span > 0 ? (t - motion.t[i]) / span : 0;
      const [x, y] = shown[k].match(/-?\d+\.\d+/g).map(Number);
      assert.ok(Math.abs(x - (motion.x[i] + share * (motion.x[next] - motion.x[i]))) < 0.0051, `${shown[k]} at ${t}`);
      assert.ok(Math.abs(y - (motion.y[i] + share * (motion.y[next] - motion.y[i]))) < 0.0051, `${shown[k]} at ${t}`);
    });
  }
});

pageTest("says where each comes from, and whether the course is the same", pair, async (page) => {
  const text = await page.textContent("main");
  for (const { command } of [payloadOf(pair), payloadOf(pair).beside]) assert.ok(text.includes(command), command);
  assert.match(text, /Both drive among the same rocks/);
  const other = at("other.html");
  rockyard(["replay", at("one"), "--trial", "2", "--with-trial", "1", "--out", other]);
  const opened = await open(other);
  assert.match(await opened.page.textContent("main"), /Their rocks or goals differ/);
}, { width: 1400 });

pageTest("one key moves both cameras, and the overview tells of both", pair, async (page) => {
  assert.equal(await page.evaluate(() => rockyardReplay.overview), true);
  assert.match(await page.textContent(".overview:not([hidden]) .caption-now"), /^(First|Second): /);
  await page.keyboard.press("t");
  assert.equal(await page.locator('.cameras button[aria-pressed="true"]', { hasText: "Top" }).count(), 2);
  await page.keyboard.press("b");
  assert.equal(await page.locator(".layers label", { hasText: "Believed path" }).locator("input:checked").count(), 0);
}, { width: 1400, reducedMotion: "no-preference" });
