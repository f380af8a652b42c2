// What the replay page draws in three dimensions, compared with the data.
import assert from "node:assert/strict";
import { test } from "node:test";
import { expectedLinks } from "./link_places.mjs";
import { payloadOf } from "./page_payload.mjs";
import { changed, difference, open, pageTest, pixels, replayOf, seekShare } from "./replay_pages.mjs";

const WHEEL_RADIUS_M = 0.065;

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

const { file } = replayOf("pathfinder/nominal", "nominal");

pageTest("wheels stand on the ground", file, async (page) => {
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
});

// Pictures from above at the start and at half time, of the page with other data.
async function twoPictures(change) {
  const { page } = await open(changed(file, "other.html", change));
  await page.keyboard.press("t");
  await seekShare(page, 0.5);
  const half = await pixels(page);
  await seekShare(page, 0);
  const start = await pixels(page);
  return { start, half };
}

test("pushed rocks lie where they were pushed to, and go back with time", async () => {
  const still = await twoPictures(() => {});
  const pushed = await twoPictures((payload) => {
    const { t } = payload.motion;
    // The widest one near the course, so that its place is more than a few pixels.
    const near = payload.rocks.filter(({ x, y }) => x > 1 && x < 6 && Math.abs(y) < 1.5);
    const widest = near.reduce((one, other) => (other.a > one.a ? other : one));
    const rock = payload.rocks.indexOf(widest);
    const { x, y, z } = widest;
    payload.rock_moves = [{ rock, t: t[0] + 0.3 * (t[t.length - 1] - t[0]), x: x + 0.5, y, z }];
  });
  assert.ok(difference(still.half, pushed.half) > 0.004);
  assert.equal(difference(still.start, pushed.start), 0);
});

test("the points of a scan look otherwise where there is a hazard, and are gone without a scan", async () => {
  const pictures = [];
  for (const hazard of [false, true]) {
    pictures.push(await twoPictures(({ scans }) => scans.forEach((scan) => scan.hazards.fill(hazard))));
  }
  pictures.push(await twoPictures((payload) => (payload.scans = [])));
  for (const [a, b] of [[0, 1], [0, 2], [1, 2]]) assert.ok(difference(pictures[a].half, pictures[b].half) > 0.0003, `${a} and ${b}`);
});

test("the plan has x to the right and y up", async () => {
  const { motion } = payloadOf(file);
  // Mirror lines are blue as well.
  const { page } = await open(changed(file, "plain.html", (payload) => (payload.course.mirror_lines = [])));
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
});

test("mirror lines are drawn where operators turn the rover back, and named", async () => {
  assert.deepEqual(payloadOf(file).course.mirror_lines, [-1.1, 1.1]);
  const lines = (ys) => changed(file, "mirror.html", (payload) => (payload.course.mirror_lines = ys));
  const pictures = [];
  for (const [ys, named] of [[[-1.1, 1.1], 1], [[], 0], [[-0.6, 0.6], 1]]) {
    const { page } = await open(lines(ys));
    await page.keyboard.press("t");
    pictures.push(await pixels(page));
    assert.equal(await page.getByText("Mirror line").count(), named);
  }
  for (const [a, b] of [[0, 1], [0, 2], [1, 2]]) assert.ok(difference(pictures[a], pictures[b]) > 0.001, `${a} and ${b}`);
});
