// The replay page where something is unusual: names with markup, another record, no WebGL, damage.
import assert from "node:assert/strict";
import { test } from "node:test";
import { open as openAny } from "./browser.mjs";
import { at } from "./harness.mjs";
import { payloadTextOf, withPayloadText } from "./page_payload.mjs";
import { changed, difference, open, pixels, replayOf, seekShare } from "./replay_pages.mjs";

const SAME = 1e-9;

const { file, stored } = replayOf("pathfinder/nominal", "nominal");

test("shows markup in names as text", async () => {
  const nasty = `</script><img src=x onerror="document.title='run'"><b>bold</b>`;
  const target = changed(file, "nasty.html", (payload) => {
    payload.title = payload.scenario = payload.cell = payload.detail = payload.command = nasty;
    payload.events.forEach((event) => (event.detail = nasty));
    payload.record.forEach((column) => (column.name = nasty));
  });
  const { page, requests } = await open(target);
  await seekShare(page, 1);
  assert.equal(await page.textContent("h1"), nasty);
  assert.equal(await page.locator("main img, main b").count(), 0);
  assert.equal(await page.title(), nasty);
  assert.equal(requests.length, 1);
});

test("says aloud where the drive differs from the stored record, or there is none", async () => {
  for (const [repeats, words] of [[false, /differs from the stored record/], [null, /no stored record/]]) {
    const target = changed(file, "differs.html", (payload) => (payload.repeats_stored = repeats));
    const { page } = await open(target);
    assert.match(await page.textContent(".repeats"), words);
    assert.equal(await page.locator(".repeats[role=alert]").count(), repeats === false ? 1 : 0);
  }
});

test("shows a plan where there is no WebGL", async () => {
  const { page } = await open(file, { withoutWebGl: true });
  assert.match(await page.textContent(".picture"), /no WebGL/);
  const first = await pixels(page);
  await seekShare(page, 1);
  assert.ok(new Set(first).size > 20, "the plan is blank");
  assert.ok(difference(first, await pixels(page)) > 0.002);
  assert.ok(Math.abs((await page.evaluate(() => rockyardReplay.pose().x)) - Number(stored.final_x_m)) < SAME);
});

test("shows a trial that ended where it began", async () => {
  const target = changed(file, "short.html", (payload) => {
    const { motion } = payload;
    const first = (list) => list.slice(0, 1);
    for (const [name, list] of Object.entries(motion)) if (Array.isArray(list) && name !== "activity_names") motion[name] = first(list);
    for (const [name, list] of Object.entries(motion.joints)) motion.joints[name] = first(list);
    Object.assign(motion, { breaks: [] });
    Object.assign(payload, { scans: [], steps: [], events: [], rocks: [], rock_moves: [] });
  });
  const { page } = await open(target);
  await page.keyboard.press("Space");
  await page.keyboard.press("n");
  assert.equal(await page.evaluate(() => rockyardReplay.playing), false);
});

test("says what is wrong with a page that was cut off", async () => {
  const { page } = await openAny(withPayloadText(file, at("cut.html"), payloadTextOf(file).slice(0, 400)), { damaged: true });
  await page.waitForSelector(".problem");
  assert.match(await page.textContent(".problem"), /cannot be shown/);
});
