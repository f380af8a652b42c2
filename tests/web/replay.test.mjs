// The replay page as a whole, in a browser: it opens, plays, and agrees with the stored record.
import assert from "node:assert/strict";
import { statSync } from "node:fs";
import { test } from "node:test";
import { payloadOf } from "./page_payload.mjs";
import { changed, difference, MOST_BYTES, open, pageTest, pixels, replayOf, seekShare, time } from "./replay_pages.mjs";

// final_x_m and others are compared with what the page draws: it keeps every digit of the last pose.
const SAME = 1e-9;

const { file, stored } = replayOf("pathfinder/nominal", "nominal");

test("opens from disk with no request but itself and nothing on the console", async () => {
  for (const scheme of ["light", "dark"]) {
    const { page, requests, url } = await open(file, { scheme });
    await page.waitForFunction(() => rockyardReplay.frames > 0);
    assert.equal(await page.evaluate(() => rockyardReplay.playing), false);
    assert.equal(await time(page), payloadOf(file).motion.t[0]);
    const drawn = await page.evaluate(() => rockyardReplay.frames);
    await seekShare(page, 0.5);
    await page.waitForFunction((before) => rockyardReplay.frames > before, drawn);
    assert.ok(new Set(await pixels(page)).size > 100, "the picture is blank");
    assert.deepEqual(requests, [url]);
  }
});

test("is smaller than 3 MB", () => {
  assert.ok(statSync(file).size < MOST_BYTES, `${statSync(file).size} bytes`);
});

pageTest("plays to its end, where the rover stands as the stored record says", file, async (page) => {
  for (let i = 0; i < 12; ++i) await page.keyboard.press("+");
  await page.keyboard.press("Space");
  assert.equal(await page.evaluate(() => rockyardReplay.playing), true);
  await page.waitForFunction(() => !rockyardReplay.playing);
  const { pose, at, end } = await page.evaluate(() => ({
    pose: rockyardReplay.pose(), at: rockyardReplay.time, end: rockyardReplay.sample(0).t + rockyardReplay.duration,
  }));
  assert.equal(at, end);
  assert.ok(Math.abs(pose.x - Number(stored.final_x_m)) < SAME, `${pose.x} is not ${stored.final_x_m}`);
  assert.ok(Math.abs(pose.y - Number(stored.final_y_m)) < SAME, `${pose.y} is not ${stored.final_y_m}`);
  const turn = pose.heading - Number(stored.final_heading_rad);
  assert.ok(Math.abs(Math.sin(turn / 2)) < SAME, `${pose.heading} is not ${stored.final_heading_rad}`);
  const text = await page.textContent("main");
  assert.match(text, /repeats the stored record bit for bit/);
  assert.ok(text.includes(stored.outcome.replaceAll("_", " ")));
});

pageTest("draws something, and something else at the end", file, async (page) => {
  const first = await pixels(page);
  assert.ok(new Set(first).size > 100, "the picture is blank");
  await seekShare(page, 1);
  assert.ok(difference(first, await pixels(page)) > 0.2);
});

test("readouts tell what the data says", async () => {
  const { motion, events } = payloadOf(file);
  const i = Math.floor(motion.t.length / 2);
  const { page } = await open(file);
  await page.evaluate((t) => (rockyardReplay.seek(t), rockyardReplay.pose()), motion.t[i]);
  const rows = await page.locator(".readout > dl").evaluate((list) =>
    Object.fromEntries([...list.querySelectorAll("dt")].map((name) => [name.textContent, name.nextSibling.textContent.replaceAll("−", "-")])));
  const numbers = (text) => text.match(/-?\d+(\.\d+)?/g).map(Number);
  const near = (text, values) => numbers(text).forEach((value, k) => k < values.length && assert.ok(Math.abs(value - values[k]) < 0.0051, `${text}: ${values}`));
  near(rows["True pose"], [motion.x[i], motion.y[i]]);
  near(rows["Believed pose"], [motion.believed_x[i], motion.believed_y[i]]);
  near(rows["Position error"], [Math.hypot(motion.believed_x[i] - motion.x[i], motion.believed_y[i] - motion.y[i])]);
  assert.equal(rows.Activity, motion.activity_names[motion.activity[i]]);
  assert.ok(events.some((event) => event.t <= motion.t[i] && rows["Last event"].length > 0));
});

test("says what the record says, in words that a newcomer reads", async () => {
  const target = changed(file, "words.html", (payload) => {
    Object.assign(payload, { outcome: "no_path", detail: "found no way on and gave up" });
  });
  const { page } = await open(target);
  assert.match(await page.textContent(".outcome"), /\(It found no way on and gave up\.\)/);
  const turns = payloadOf(file).record.find(({ name }) => name === "point_turns").value;
  const row = page.locator(".timeline-labels .row", { hasText: "turn in place" });
  assert.equal(await row.locator(".count").textContent(), String(turns));
});
