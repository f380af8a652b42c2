// What the replay tells: an overview of ten seconds, how the drive ended, and what can be handed on.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { loadModule } from "./harness.mjs";
import { payloadOf } from "./page_payload.mjs";
import { changed, open, pageTest, replayOf, seekShare, time } from "./replay_pages.mjs";

const { beatsOf, OverviewClock, OVERVIEW_S } = await loadModule("replay/story.ts");

const { file } = replayOf("pathfinder/nominal", "nominal");
const stuck = changed(file, "stuck.html", (payload) => {
  const detail = "drove on without coming nearer to the goal until its operator ended the run";
  Object.assign(payload, { outcome: "no_path", detail, cause_setting: "referee.no_path_distance_m" });
});
const { file: gestalt } = replayOf("gestalt/narrow_course", "narrow");

const MOVING = { reducedMotion: "no-preference" };
const start = (page) => page.evaluate(() => rockyardReplay.sample(0).t);
const end = (page) => page.evaluate(() => rockyardReplay.sample(0).t + rockyardReplay.duration);
const runs = (page) => page.evaluate(() => rockyardReplay.overview);

test("the overview divides its ten seconds among the whole drive and the moments that matter", () => {
  const beats = [{ t: 0, caption: "start" }, { t: 30, caption: "a" }, { t: 31, caption: "too near" }, { t: 60, caption: "b" }];
  const clock = new OverviewClock(beats, (t) => t / 100);
  assert.deepEqual(clock.at(0), { share: 0, caption: "start" });
  assert.deepEqual(clock.at(OVERVIEW_S), { share: 1, caption: "b" });
  const samples = Array.from({ length: 1001 }, (_, i) => clock.at((i / 1000) * OVERVIEW_S));
  samples.slice(1).forEach(({ share }, i) => assert.ok(share >= samples[i].share));
  for (const [share, caption] of [[0, "start"], [0.3, "a"], [0.6, "b"]]) {
    const standing = samples.filter((sample) => sample.share === share && sample.caption === caption);
    assert.ok(Math.abs(standing.length - 90) <= 1, `${caption}: ${standing.length}`);
  }
  assert.ok(!samples.some(({ caption }) => caption === "too near"));
});

test("its moments are the first of each kind, in the order of time, and where belief and truth part", () => {
  const payload = payloadOf(file);
  const at = (kind, t) => ({ t, kind, detail: "", x: 0, y: 0, heading: 0 });
  const [begin] = payload.motion.t;
  const beats = beatsOf({ ...payload, course: { ...payload.course, goal: { ...payload.course.goal, radius: 100 } } },
    [at("scrape", begin + 5), at("hazard", begin + 2), at("hazard", begin + 9), at("stall", begin + 8)]);
  assert.deepEqual(beats.map(({ t }) => t - begin), [0, 2, 5, 8]);
  const radius = 0.01;
  const parting = beatsOf({ ...payload, course: { ...payload.course, goal: { ...payload.course.goal, radius } } }, []);
  const { motion } = payload;
  const first = motion.t.findIndex((_, i) => Math.hypot(motion.believed_x[i] - motion.x[i], motion.believed_y[i] - motion.y[i]) > radius);
  assert.equal(parting.length, 2);
  assert.equal(parting[1].t, motion.t[first]);
});

pageTest("opens with the overview, which ends at the end with how it ended", stuck, async (page) => {
  assert.equal(await runs(page), true);
  await page.clock.runFor(100);
  assert.match(await page.textContent(".overview .caption-now"), /The goal is 7\.6 m away|hazard|scrapes/);
  assert.equal(await page.isVisible(".ending"), false);
  await page.clock.runFor(900 * OVERVIEW_S);
  assert.equal(await runs(page), true);
  await page.clock.runFor(200 * OVERVIEW_S);
  assert.equal(await runs(page), false);
  assert.equal(await time(page), await end(page));
  assert.equal(await page.isVisible(".overview"), false);
  assert.match(await page.textContent(".ending h2"), /It drove too far without coming nearer to the goal\./);
  const { record } = payloadOf(stuck);
  const value = (name) => record.find((column) => column.name === name).value;
  const said = await page.textContent(".ending");
  assert.ok(said.includes(`It stood ${value("true_goal_distance_m").toFixed(2)} m from the goal`));
  assert.ok(said.includes(`after ${value("true_distance_m").toFixed(2)} m of driving`));
  assert.equal(await page.textContent(".ending code"), "referee.no_path_distance_m");
}, { ...MOVING, stepped: true });

test("any key or click ends the overview where it is; Escape and its button go to the start", async () => {
  for (const [leave, where] of [
    [(page) => page.keyboard.press("b"), "there"],
    [(page) => page.click(".readout h2"), "there"],
    [(page) => page.evaluate(() => rockyardReplay.seek(rockyardReplay.time)), "there"],
    [(page) => page.keyboard.press("Escape"), "start"],
    [(page) => page.click(".overview button"), "start"],
  ]) {
    const { page } = await open(file, { ...MOVING, stepped: true });
    await page.clock.runFor(500 * OVERVIEW_S);
    assert.equal(await runs(page), true);
    await leave(page);
    assert.equal(await runs(page), false);
    const at = await time(page);
    if (where === "start") assert.equal(at, await start(page));
    else assert.ok(at > (await start(page)) && at < (await end(page)));
    assert.equal(await page.evaluate(() => rockyardReplay.playing), false);
  }
});

pageTest("does not play unasked for who wants less motion, nor where a link leads to a moment", file, async (page) => {
  assert.equal(await runs(page), false);
  await page.keyboard.press("v");
  assert.equal(await runs(page), true);
  await page.keyboard.press("Escape");
  const linked = await open(file, MOVING);
  await linked.page.goto(`${linked.url}#t=120`);
  await linked.page.reload();
  await linked.page.waitForFunction(() => window.rockyardReplay);
  assert.equal(await runs(linked.page), false);
  assert.equal(await time(linked.page), 120);
});

pageTest("how it ended goes with the end, can be closed, and leads back to what led there", stuck, async (page) => {
  assert.equal(await page.isVisible(".ending"), false);
  await page.keyboard.press("End");
  assert.equal(await page.isVisible(".ending"), true);
  const links = page.locator(".ending .led-there button");
  const last = payloadOf(stuck).events.filter(({ kind }) => ["hazard", "felt", "scrape", "stall", "reflection"].includes(kind)).slice(-3);
  assert.equal(await links.count(), last.length);
  await links.first().click();
  assert.equal(await time(page), last[0].t);
  assert.equal(await page.isVisible(".ending"), false);
  await page.keyboard.press("End");
  await page.click(".ending button:has-text('Close')");
  assert.equal(await page.isVisible(".ending"), false);
  await page.keyboard.press("ArrowLeft");
  await page.keyboard.press("End");
  assert.equal(await page.isVisible(".ending"), true);
});

test("a success is told as one, without a rule that decided", async () => {
  const arrived = changed(file, "arrived.html", (payload) => {
    Object.assign(payload, { outcome: "goal_reached", detail: "arrived at the goal", cause_setting: "course.goal_radius_m" });
  });
  const { page } = await open(arrived);
  await page.keyboard.press("End");
  assert.match(await page.textContent(".ending h2.good"), /It reached the goal, and believed so\./);
  assert.equal(await page.locator(".ending code").count(), 0);
});

// Names of columns and settings stand in tables and in code.
test("no sentence has the name of a parameter or an underscore in it", async () => {
  for (const each of [file, stuck, gestalt]) {
    const { page } = await open(each);
    const { events, title, scenario } = payloadOf(each);
    await page.keyboard.press("End");
    const words = () => page.evaluate(() => {
      const copy = document.querySelector("main").cloneNode(true);
      for (const element of copy.querySelectorAll("table, code, .origin, h1")) element.remove();
      const titles = [...copy.querySelectorAll("[title], [aria-label]")].flatMap((e) => [e.title, e.getAttribute("aria-label") ?? ""]);
      return [copy.textContent, ...titles].join("\n");
    });
    for (const t of [...new Set(events.map((event) => event.t))].slice(0, 60)) {
      await page.evaluate((at) => (rockyardReplay.seek(at), rockyardReplay.pose()), t);
      const found = (await words()).replaceAll(title, "").replaceAll(scenario, "").match(/\S*[A-Za-z]_[A-Za-z]\S*/g);
      assert.equal(found, null, `${each} at ${t} s: ${found}`);
    }
  }
});

async function download(page, act) {
  const [saved] = await Promise.all([page.waitForEvent("download"), act()]);
  return { name: saved.suggestedFilename(), bytes: readFileSync(await saved.path()) };
}

pageTest("the picture is saved as PNG, with what it shows and when", file, async (page) => {
  await seekShare(page, 0.5);
  const { name, bytes } = await download(page, () => page.click("text=Save picture"));
  assert.match(name, /^nominal-seed1-trial1-[\d-]+\.png$/);
  const decoded = await page.evaluate(async (data) => {
    const bitmap = await createImageBitmap(new Blob([Uint8Array.from(data)], { type: "image/png" }));
    const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
    const context = canvas.getContext("2d", { willReadFrequently: true });
    context.drawImage(bitmap, 0, 0);
    const colours = (y, height) => new Set(new Uint32Array(context.getImageData(0, y, bitmap.width, height).data.buffer)).size;
    const picture = document.querySelector(".picture canvas");
    return { width: bitmap.width, wanted: picture.width, drawn: colours(0, picture.height), band: colours(picture.height, bitmap.height - picture.height) };
  }, [...bytes]);
  assert.equal(decoded.width, decoded.wanted - (decoded.wanted % 2));
  assert.ok(decoded.drawn > 100, "the picture is blank");
  assert.ok(decoded.band > 2, "nothing is written below the picture");
  assert.match(await page.textContent(".share .said"), /Saved as nominal-seed1-trial1/);
}, { acceptDownloads: true, paints: true });

// Films that a browser records do not say how long they are: it is known at their end.
async function filmLength(context, bytes) {
  const player = await context.newPage();
  const length = await player.evaluate(async (data) => {
    const video = document.createElement("video");
    video.src = URL.createObjectURL(new Blob([Uint8Array.from(data)], { type: "video/webm" }));
    await new Promise((done, fail) => Object.assign(video, { onloadedmetadata: done, onerror: () => fail(video.error.message) }));
    if (Number.isFinite(video.duration)) return video.duration;
    video.currentTime = 1e6;
    await new Promise((done) => (video.onseeked = done));
    return video.duration;
  }, [...bytes]);
  await player.close();
  return length;
}

pageTest("the overview is saved as a film that lasts as long, or given up", file, async (page) => {
  await page.evaluate(() => {
    window.recorded = {};
    for (const name of ["start", "stop"]) {
      const act = MediaRecorder.prototype[name];
      MediaRecorder.prototype[name] = function (...values) {
        recorded[name] ??= rockyardReplay.time;
        return act.apply(this, values);
      };
    }
  });
  const began_ms = performance.now();
  const { name, bytes } = await download(page, () => page.click("text=Save film"));
  const took_s = (performance.now() - began_ms) / 1000;
  assert.match(name, /^nominal-seed1-trial1-[\d-]+\.webm$/);
  assert.deepEqual([...bytes.subarray(0, 4)], [0x1a, 0x45, 0xdf, 0xa3]); // of every WebM file
  assert.ok(bytes.length > 50_000, `${bytes.length} bytes`);
  assert.ok(took_s > OVERVIEW_S, `recorded in ${took_s} s`);
  const lasts_s = await filmLength(page.context(), bytes);
  assert.ok(lasts_s > 0 && lasts_s <= took_s, `${lasts_s} s of ${took_s} s`);
  assert.deepEqual(await page.evaluate(() => recorded), { start: await start(page), stop: await end(page) });
  await page.click("text=Save film");
  await page.waitForFunction(() => rockyardReplay.overview);
  await page.click("text=Stop recording");
  assert.match(await page.textContent(".share .said"), /given up/);
  assert.equal(await runs(page), false);
}, { acceptDownloads: true, paints: true });
