// The replay page in a browser, as the command writes it.
import assert from "node:assert/strict";
import { readFileSync, statSync, writeFileSync } from "node:fs";
import path from "node:path";
import { after, before, describe, test } from "node:test";
import { gunzipSync, gzipSync } from "node:zlib";
import { launch, openPage, rockyard, temporaryFolder } from "./harness.mjs";

const MOST_BYTES = 3_000_000;
// final_x_m and others are compared with what the page draws: it keeps every digit of the last pose.
const SAME = 1e-9;
const WHEEL_RADIUS_M = 0.065;

const folder = temporaryFolder();
let browser;

/** Runs two trials of a scenario and writes the page of the second. */
function replayOf(scenario, name) {
  const run = path.join(folder, name);
  rockyard(["run", `scenarios/${scenario}.json`, "--trials", "2", "--seed", "1", "--threads", "1", "--out", run]);
  const file = path.join(folder, `${name}.html`);
  rockyard(["replay", run, "--trial", "1", "--out", file, "--svg", path.join(folder, `${name}.svg`)]);
  const lines = readFileSync(path.join(run, "trials.csv"), "utf8").trim().split("\n").map((line) => line.split(","));
  const row = lines.find((fields, i) => i > 0 && fields[lines[0].indexOf("trial")] === "1");
  const stored = Object.fromEntries(lines[0].map((column, i) => [column, row[i]]));
  return { file, stored };
}

const PAYLOAD = /(<script type="application\/octet-stream" id="payload">)([^<]*)/;

const payloadOf = (file) => JSON.parse(gunzipSync(Buffer.from(readFileSync(file, "utf8").match(PAYLOAD)[2], "base64")));

/** The same page with other data. */
function changed(file, name, change) {
  const payload = payloadOf(file);
  change(payload);
  const text = gzipSync(JSON.stringify(payload)).toString("base64");
  const target = path.join(folder, name);
  writeFileSync(target, readFileSync(file, "utf8").replace(PAYLOAD, (_, mark) => mark + text));
  return target;
}

// Small, because drawing in software takes its time by the pixel.
async function open(file, options) {
  const opened = await openPage(browser, file, { width: 1000, height: 640, ...options });
  await opened.page.waitForFunction(() => window.rockyardReplay);
  return opened;
}

/** Every fourth colour of the picture, as one list. */
const pixels = (page) =>
  page.evaluate(() => {
    rockyardReplay.pose();
    const canvas = document.querySelector(".picture canvas");
    const copy = document.createElement("canvas");
    copy.width = canvas.width / 4;
    copy.height = canvas.height / 4;
    const context = copy.getContext("2d");
    context.drawImage(canvas, 0, 0, copy.width, copy.height);
    return [...new Uint32Array(context.getImageData(0, 0, copy.width, copy.height).data.buffer)];
  });

/** Share of the pixels that differ. */
const difference = (a, b) => a.filter((colour, i) => colour !== b[i]).length / a.length;

const time = (page) => page.evaluate(() => rockyardReplay.time);
const seekShare = (page, share) => page.evaluate((s) => rockyardReplay.seek(rockyardReplay.sample(0).t + s * rockyardReplay.duration), share);

const times = ([aw, ax, ay, az], [bw, bx, by, bz]) => [
  aw * bw - ax * bx - ay * by - az * bz,
  aw * bx + ax * bw + ay * bz - az * by,
  aw * by - ax * bz + ay * bw + az * bx,
  aw * bz + ax * by - ay * bx + az * bw,
];

const unit = (q) => q.map((value) => value / Math.hypot(...q));

const rotated = (q, v) => times(times(q, [0, ...v]), [q[0], -q[1], -q[2], -q[3]]).slice(1);

/** Pivots and attitudes of all links at sample i, from the definition in payload.ts. */
function expectedLinks({ links }, motion, i) {
  const placed = [];
  for (const { name, parent, pivot, axis } of links) {
    if (placed.length === 0) {
      placed.push({ at: [motion.x[i], motion.y[i], motion.z[i]], turn: unit([motion.qw[i], motion.qx[i], motion.qy[i], motion.qz[i]]) });
      continue;
    }
    const { at, turn } = placed[parent];
    const angle = motion.joints[name][i];
    const offset = rotated(turn, pivot);
    const own = [Math.cos(angle / 2), ...axis.map((a) => a * Math.sin(angle / 2))];
    placed.push({ at: at.map((value, k) => value + offset[k]), turn: times(turn, own) });
  }
  return placed;
}

/** Middle of the dark blue of the solar panel in a picture `width` wide. */
function panelAt(colours, width) {
  let [x, y, count] = [0, 0, 0];
  colours.forEach((colour, i) => {
    const [r, g, b] = [colour & 255, (colour >> 8) & 255, (colour >> 16) & 255];
    if (b < r + 25 || g > 85 || r > 70) return;
    x += i % width;
    y += Math.floor(i / width);
    ++count;
  });
  assert.ok(count > 20, "no panel is seen");
  return { x: x / count, y: y / count };
}

before(async () => {
  browser = await launch();
});

after(async () => {
  await browser?.close();
});

describe("a drive with light stripes", () => {
  let file;
  let stored;
  before(() => {
    ({ file, stored } = replayOf("pathfinder/nominal", "nominal"));
  });

  test("opens from disk with no request but itself and nothing on the console", async () => {
    for (const scheme of ["light", "dark"]) {
      const { page, requests, problems, url } = await open(file, { scheme });
      await page.waitForTimeout(300);
      assert.equal(await page.evaluate(() => rockyardReplay.playing), false);
      assert.equal(await time(page), payloadOf(file).motion.t[0]);
      await seekShare(page, 0.5);
      await page.waitForTimeout(200);
      assert.deepEqual(requests, [url]);
      assert.deepEqual(problems, []);
      await page.context().close();
    }
  });

  test("is smaller than 3 MB", () => {
    assert.ok(statSync(file).size < MOST_BYTES, `${statSync(file).size} bytes`);
  });

  test("plays to its end, where the rover stands as the stored record says", async () => {
    const { page, problems } = await open(file);
    for (let i = 0; i < 12; ++i) await page.keyboard.press("+");
    await page.keyboard.press("Space");
    assert.equal(await page.evaluate(() => rockyardReplay.playing), true);
    await page.waitForFunction(() => !rockyardReplay.playing, null, { timeout: 60_000 });
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
    assert.deepEqual(problems, []);
    await page.context().close();
  });

  test("draws something, and something else at the end", async () => {
    const { page } = await open(file);
    const first = await pixels(page);
    assert.ok(new Set(first).size > 100, "the picture is blank");
    await seekShare(page, 1);
    assert.ok(difference(first, await pixels(page)) > 0.2);
    await page.context().close();
  });

  test("wheels stand on the ground", async () => {
    const { page } = await open(file);
    const { ground } = payloadOf(file);
    const level = ground.z.reduce((sum, z) => sum + z, 0) / ground.z.length;
    for (const share of [0, 0.3, 0.7]) {
      await seekShare(page, share);
      const wheels = (await page.evaluate(() => rockyardReplay.links())).filter(({ name }) => name.endsWith("_wheel"));
      assert.equal(wheels.length, 6);
      const gaps = wheels.map(({ z }) => z - level - WHEEL_RADIUS_M).sort((a, b) => a - b);
      // Some wheels may stand on rocks, none may be in the ground by more than it gives way.
      assert.ok(gaps[0] > -0.015 && gaps[2] < 0.015, `gaps of ${gaps} m`);
      const spread = Math.max(...wheels.map((a) => Math.hypot(a.x - wheels[0].x, a.y - wheels[0].y)));
      assert.ok(spread > 0.5 && spread < 0.8, `wheels are ${spread} m apart`);
    }
    await page.context().close();
  });

  test("every link is where the angles of its sample put it", async () => {
    const { motion, rover } = payloadOf(file);
    const { page } = await open(file);
    for (const name of ["left_bogie", "right_rocker", "left_front_knuckle"]) {
      const angles = motion.joints[name].map(Math.abs);
      const i = angles.indexOf(Math.max(...angles));
      assert.ok(angles[i] > 0.02, `${name} never turns`);
      const drawn = await page.evaluate((t) => (rockyardReplay.seek(t), rockyardReplay.links()), motion.t[i]);
      expectedLinks(rover, motion, i).forEach(({ at, turn }, k) => {
        const { x, y, z, attitude } = drawn[k];
        assert.equal(drawn[k].name, rover.links[k].name);
        assert.ok(Math.hypot(x - at[0], y - at[1], z - at[2]) < 1e-6, `${drawn[k].name} while ${name} is turned`);
        const cosine = attitude.w * turn[0] + attitude.x * turn[1] + attitude.y * turn[2] + attitude.z * turn[3];
        assert.ok(Math.abs(cosine) > 1 - 1e-6, `${drawn[k].name} is turned otherwise`);
      });
    }
    await page.context().close();
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
    await page.context().close();
  });

  test("the plan has x to the right and y up", async () => {
    const { motion } = payloadOf(file);
    const { page } = await open(file);
    await page.keyboard.press("t");
    await page.keyboard.press("b");
    const highest = motion.y.indexOf(Math.max(...motion.y));
    const lowest = motion.y.indexOf(Math.min(...motion.y));
    const places = [];
    for (const i of [0, motion.t.length - 1, highest, lowest]) {
      await page.evaluate((t) => rockyardReplay.seek(t), motion.t[i]);
      places.push(panelAt(await pixels(page), await page.evaluate(() => Math.floor(document.querySelector(".picture canvas").width / 4))));
    }
    const [start, end, high, low] = places;
    assert.ok(end.x > start.x + 50, `${end.x} is not right of ${start.x}`);
    assert.ok(high.y < low.y - 5, `${high.y} is not above ${low.y}`);
    await page.context().close();
  });

  test("keys scrub, step along events and change the camera", async () => {
    const { page, problems } = await open(file);
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
    assert.deepEqual(problems, []);
    await page.context().close();
  });

  test("the slider and a click on the time line go to a time", async () => {
    const { page } = await open(file);
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
    await page.context().close();
  });

  test("events on the time line can be clicked, walked by keys and filtered", async () => {
    const { page } = await open(file);
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
    await page.context().close();
  });

  test("links lead to a view and a time", async () => {
    const { page } = await openPage(browser, file);
    await page.goto(`${page.url()}#view=plan&t=100`);
    await page.reload();
    await page.waitForFunction(() => window.rockyardReplay);
    assert.equal(await page.evaluate(() => rockyardReplay.mode), "top");
    assert.equal(await time(page), 100);
    await page.context().close();
  });

  test("fits a phone", async () => {
    const { page } = await open(file, { width: 380, height: 800 });
    assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 380);
    const boxes = await Promise.all([".picture", ".transport", ".timeline", ".readout"].map((part) => page.locator(part).boundingBox()));
    for (let i = 1; i < boxes.length; ++i) assert.ok(boxes[i].y >= boxes[i - 1].y + boxes[i - 1].height);
    await page.context().close();
  });

  test("shows every column of the record and finds one", async () => {
    const { page } = await open(file);
    const { record } = payloadOf(file);
    assert.equal(await page.locator(".record tbody tr:visible").count(), record.length);
    await page.locator(".record input").fill("max_tilt");
    assert.equal(await page.locator(".record tbody tr:visible").count(), 1);
    await page.context().close();
  });

  test("shows markup in names as text", async () => {
    const nasty = `</script><img src=x onerror="document.title='run'"><b>bold</b>`;
    const target = changed(file, "nasty.html", (payload) => {
      payload.title = payload.scenario = payload.cell = payload.detail = payload.command = nasty;
      payload.events.forEach((event) => (event.detail = nasty));
      payload.record.forEach((column) => (column.name = nasty));
    });
    const { page, requests, problems } = await open(target);
    await seekShare(page, 1);
    assert.equal(await page.textContent("h1"), nasty);
    assert.equal(await page.locator("main img, main b").count(), 0);
    assert.equal(await page.title(), nasty);
    assert.equal(requests.length, 1);
    assert.deepEqual(problems, []);
    await page.context().close();
  });

  test("says aloud where the drive differs from the stored record, or there is none", async () => {
    for (const [repeats, words] of [[false, /differs from the stored record/], [null, /no stored record/]]) {
      const target = changed(file, "differs.html", (payload) => (payload.repeats_stored = repeats));
      const { page } = await open(target);
      assert.match(await page.textContent(".repeats"), words);
      assert.equal(await page.locator(".repeats[role=alert]").count(), repeats === false ? 1 : 0);
      await page.context().close();
    }
  });

  test("shows a plan where there is no WebGL", async () => {
    const context = await browser.newContext();
    await context.addInitScript(() => {
      const getContext = HTMLCanvasElement.prototype.getContext;
      HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
        return kind.startsWith("webgl") ? null : getContext.call(this, kind, ...rest);
      };
    });
    const page = await context.newPage();
    const errors = [];
    page.on("pageerror", (error) => errors.push(error.message));
    page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
    await page.goto(`file://${file}`);
    await page.waitForFunction(() => window.rockyardReplay);
    assert.match(await page.textContent(".picture"), /no WebGL/);
    const first = await pixels(page);
    await seekShare(page, 1);
    assert.ok(new Set(first).size > 20, "the plan is blank");
    assert.ok(difference(first, await pixels(page)) > 0.002);
    assert.ok(Math.abs((await page.evaluate(() => rockyardReplay.pose().x)) - Number(stored.final_x_m)) < SAME);
    assert.deepEqual(errors, []);
    await context.close();
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
    const { page, problems } = await open(target);
    await page.keyboard.press("Space");
    await page.keyboard.press("n");
    assert.equal(await page.evaluate(() => rockyardReplay.playing), false);
    assert.deepEqual(problems, []);
    await page.context().close();
  });

  test("says what is wrong with a page that was cut off", async () => {
    const target = path.join(folder, "cut.html");
    writeFileSync(target, readFileSync(file, "utf8").replace(PAYLOAD, (_, mark, text) => mark + text.slice(0, 400)));
    const { page } = await openPage(browser, target);
    await page.waitForSelector(".problem");
    assert.match(await page.textContent(".problem"), /cannot be shown/);
    await page.context().close();
  });
});

describe("a drive with GESTALT", () => {
  let file;
  before(() => {
    ({ file } = replayOf("gestalt/narrow_course", "gestalt"));
  });

  test("is smaller than 3 MB", () => {
    assert.ok(statSync(file).size < MOST_BYTES, `${statSync(file).size} bytes`);
  });

  test("shows the map on the ground and the votes of each decision", async () => {
    const { page, problems } = await open(file);
    const { steps } = payloadOf(file);
    assert.ok(steps.length > 3);
    const step = steps[2];
    await page.evaluate((t) => rockyardReplay.seek(t), step.t);
    await page.keyboard.press("t");
    const withMap = await pixels(page);
    const pictures = [];
    for (const kind of ["goodness", "certainty", "elevation", "off"]) {
      await page.locator(".layers select").selectOption(kind);
      pictures.push(await pixels(page));
    }
    assert.equal(difference(withMap, pictures[0]), 0);
    for (const other of [1, 2, 3]) assert.ok(difference(pictures[0], pictures[other]) > 0.005, `map ${other}`);
    await page.locator(".layers label", { hasText: "Arcs:" }).locator("input").uncheck();
    assert.ok(difference(pictures[3], await pixels(page)) > 0.001, "arcs");
    assert.equal(await page.locator(".votes .vote").count(), step.votes.length);
    assert.equal(await page.locator(".votes .vote.chosen").count(), step.votes.filter((vote) => vote.chosen).length);
    assert.deepEqual(problems, []);
    await page.context().close();
  });
});
