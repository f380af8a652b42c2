// Keys, clicks, links and small screens of the replay page.
import assert from "node:assert/strict";
import { test } from "node:test";
import { open as openAny } from "./browser.mjs";
import { payloadOf } from "./page_payload.mjs";
import { difference, pageTest, pixels, replayOf, seekShare, time } from "./replay_pages.mjs";

const { file } = replayOf("pathfinder/nominal", "nominal");

pageTest("keys scrub, step along events and change the camera", file, async (page) => {
  const { duration, start } = await page.evaluate(() => ({ duration: rockyardReplay.duration, start: rockyardReplay.time }));
  await page.keyboard.press("s");
  await page.keyboard.press("ArrowRight");
  assert.ok(Math.abs((await time(page)) - start - 0.01 * duration) < 1e-6);
  await page.keyboard.press("ArrowLeft");
  assert.ok(Math.abs((await time(page)) - start) < 1e-6);
  await page.keyboard.press("End");
  assert.equal(await time(page), start + duration);
  await page.keyboard.press("p");
  const times = payloadOf(file).events.map((event) => event.t);
  assert.ok((await time(page)) < start + duration);
  await page.keyboard.press("Home");
  await page.keyboard.press("n");
  assert.ok([...times, ...payloadOf(file).scans.map((scan) => scan.t)].includes(await time(page)));
  await seekShare(page, 0.5);
  const pictures = [];
  for (const [key, mode] of [["f", "follow"], ["t", "top"], ["o", "orbit"], ["r", "rover"]]) {
    await page.keyboard.press(key);
    assert.equal(await page.evaluate(() => rockyardReplay.mode), mode);
    assert.equal(await page.locator(".cameras button[aria-pressed=true]").count(), 1);
    pictures.push(await pixels(page));
  }
  for (const other of [1, 3]) assert.ok(difference(pictures[0], pictures[other]) > 0.2);
  await page.keyboard.press("f");
  for (const key of ["]", "[", ",", "."]) {
    const still = await pixels(page);
    await page.keyboard.press(key);
    assert.ok(difference(still, await pixels(page)) > 0.05, key);
  }
  await page.keyboard.press("?");
  assert.equal(await page.isVisible("dialog"), true);
  await page.keyboard.press("Escape");
  assert.equal(await page.isVisible("dialog"), false);
});

pageTest("the slider and a click on the time line go to a time", file, async (page) => {
  // As played, a drive with scans of 20 s is at another time halfway.
  await page.locator(".scrub").fill("5000");
  const played = await time(page);
  await page.locator("label", { hasText: "Standing takes" }).locator("input").uncheck();
  await page.locator(".scrub").fill("4999");
  await page.locator(".scrub").fill("5000");
  assert.notEqual(await time(page), played);
  const { duration, start } = await page.evaluate(() => ({ duration: rockyardReplay.duration, start: rockyardReplay.sample(0).t }));
  assert.ok(Math.abs((await time(page)) - start - 0.5 * duration) < 1e-6);
  await page.locator(".timeline-drawing").scrollIntoViewIfNeeded();
  const box = await page.locator(".timeline-drawing").boundingBox();
  await page.mouse.click(box.x + 8 + 0.25 * (box.width - 16), box.y + box.height - 40);
  assert.ok(Math.abs((await time(page)) - start - 0.25 * duration) < 0.01 * duration);
});

pageTest("events on the time line can be clicked, walked by keys and filtered", file, async (page) => {
  const end = page.locator(".event[aria-label*='the trial ended']");
  await end.click();
  assert.equal(await time(page), payloadOf(file).events.find((event) => event.kind === "end").t);
  const scans = payloadOf(file).scans.map((scan) => scan.t);
  await page.locator(".event[tabindex='0']").focus();
  await page.keyboard.press("ArrowRight");
  assert.equal(await time(page), scans[1]);
  await page.keyboard.press("ArrowLeft");
  assert.equal(await time(page), scans[0]);
  const marks = await page.locator(".event").count();
  await page.locator(".timeline-labels .row", { hasText: "scan" }).locator("input").uncheck();
  assert.equal(await page.locator(".event").count(), marks - scans.length);
});

test("links lead to a view and a time", async () => {
  const { page } = await openAny(file);
  await page.goto(`${page.url()}#view=plan&t=100`);
  await page.reload();
  await page.waitForFunction(() => window.rockyardReplay);
  assert.equal(await page.evaluate(() => rockyardReplay.mode), "top");
  assert.equal(await time(page), 100);
});

pageTest("fits a phone", file, async (page) => {
  assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 380);
  const boxes = await Promise.all([".picture", ".transport", ".timeline", ".readout"].map((part) => page.locator(part).boundingBox()));
  for (let i = 1; i < boxes.length; ++i) assert.ok(boxes[i].y >= boxes[i - 1].y + boxes[i - 1].height);
}, { width: 380, height: 800 });

pageTest("shows every column of the record and finds one", file, async (page) => {
  const { record } = payloadOf(file);
  assert.equal(await page.locator(".record tbody tr:visible").count(), record.length);
  await page.locator(".record input").fill("max_tilt");
  assert.equal(await page.locator(".record tbody tr:visible").count(), 1);
});

pageTest("prints in light colours whatever the screen shows", file, async (page) => {
  await page.getByRole("button", { name: "Light colours" }).click();
  await page.getByRole("button", { name: "Dark colours" }).click();
  const brightness = (colours) => colours.reduce((sum, colour) => sum + ((colour >> 8) & 255), 0) / colours.length;
  const dark = brightness(await pixels(page));
  await page.emulateMedia({ media: "print" });
  // The browser tells the page of the other medium with its next frames.
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  assert.ok(brightness(await pixels(page)) > dark + 50);
  assert.equal(await page.locator(".transport .play").isVisible(), false);
}, { scheme: "dark" });
