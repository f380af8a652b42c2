// The curves below the time line: distance to the goal and steering angles (figures 7 and 8 of
// Howard 2012), beside tilt and position error.
import assert from "node:assert/strict";
import { test } from "node:test";
import { payloadOf } from "./page_payload.mjs";
import { changed, open, pageTest, replayOf } from "./replay_pages.mjs";

const { file } = replayOf("gestalt/narrow_course", "curves");

// Athena steers all six.
const WHEELS = ["left_front", "left_middle", "left_rear", "right_front", "right_middle", "right_rear"];

const PAD = 8;
// Of a curve in its row, px.
const HEIGHT = 36;
// Paths have tenths of a pixel.
const ROUNDED = 0.051;

const degrees = (rad) => (rad * 180) / Math.PI;

/** What is drawn of a curve: the height of 0, and of each line its class, its name and its points. */
const drawn = async (page, name) => {
  // Time as it is, not as it is played.
  await page.locator("label", { hasText: "Standing takes" }).locator("input").uncheck();
  return page.evaluate((curve) => {
    const group = document.querySelector(`.timeline-drawing .curve.${curve}`);
    return {
      zero: Number(group.querySelector(".rule").getAttribute("y1")),
      width: document.querySelector(".timeline-drawing").viewBox.baseVal.width,
      lines: [...group.querySelectorAll("path")].map((path) => ({
        class: path.getAttribute("class"),
        name: path.querySelector("title").textContent,
        points: path.getAttribute("d").slice(1).split("L").map((point) => point.split(" ").map(Number)),
      })),
    };
  }, name);
};

/** The least and the greatest value of the samples that share a column of pixels. */
function columns(t, values, width) {
  const found = new Map();
  t.forEach((time, i) => {
    const x = Math.round(PAD + ((width - 2 * PAD) * (time - t[0])) / (t.at(-1) - t[0]));
    const { low, high } = found.get(x) ?? { low: Infinity, high: -Infinity };
    found.set(x, { low: Math.min(low, values[i]), high: Math.max(high, values[i]) });
  });
  return found;
}

/** Each point of the line is the least or the greatest of its column, and none is missing. */
function compare(line, t, values, { zero, width, scale, height }) {
  const y = (value) => zero - (value / scale) * height;
  const wanted = [...columns(t, values, width)].flatMap(([x, { low, high }]) => (high > low ? [[x, y(low)], [x, y(high)]] : [[x, y(low)]]));
  assert.equal(line.points.length, wanted.length);
  wanted.forEach(([x, height], i) => {
    assert.equal(line.points[i][0], x);
    assert.ok(Math.abs(line.points[i][1] - height) < ROUNDED, `${line.name}: ${line.points[i]} is not ${x} ${height}`);
  });
}

const label = (page, title) => page.locator(".timeline-labels .curve", { hasText: title }).locator(".count").textContent();

pageTest("shows how far the goal is, truly and as the rover believes", file, async (page) => {
  const { motion, course } = payloadOf(file);
  const truly = motion.t.map((_, i) => Math.hypot(course.goal.x - motion.x[i], course.goal.y - motion.y[i]));
  const believed = motion.t.map((_, i) => Math.hypot(course.told_goal.x - motion.believed_x[i], course.told_goal.y - motion.believed_y[i]));
  const scale = Math.max(...truly, ...believed);
  const { lines, ...place } = await drawn(page, "to-goal");
  assert.deepEqual(lines.map((line) => line.class), ["true", "believed"]);
  compare(lines[0], motion.t, truly, { ...place, scale, height: HEIGHT });
  compare(lines[1], motion.t, believed, { ...place, scale, height: HEIGHT });
  assert.equal(await label(page, "to the goal"), `≤ ${scale.toFixed(2)} m`);
});

test("the goal as told is where operators said that it is", async () => {
  const { page } = await open(changed(file, "told.html", ({ course }) => (course.told_goal.x += 30)));
  const { motion, course } = payloadOf(file);
  const { lines, zero } = await drawn(page, "to-goal");
  const far = Math.hypot(course.told_goal.x + 30 - motion.believed_x[0], course.told_goal.y - motion.believed_y[0]);
  assert.ok(Math.abs(lines[1].points[0][1] - (zero - HEIGHT)) < ROUNDED);
  const near = Math.hypot(course.goal.x - motion.x[0], course.goal.y - motion.y[0]);
  assert.ok(Math.abs(lines[0].points[0][1] - (zero - (HEIGHT * near) / far)) < ROUNDED);
});

pageTest("shows the steering angle of each wheel that is steered, to the left above 0", file, async (page) => {
  const { motion } = payloadOf(file);
  const wheels = Object.keys(motion.joints).filter((name) => name.endsWith("_knuckle"));
  assert.deepEqual(wheels.map((name) => name.replace("_knuckle", "")), WHEELS);
  const angles = wheels.map((name) => motion.joints[name].map(degrees));
  const scale = Math.max(...angles.flat().map(Math.abs));
  assert.ok(scale > 5, "wheels are steered");
  assert.ok(angles.some((of) => Math.min(...of) < -1), "to the right too");
  const { lines, ...place } = await drawn(page, "steering");
  assert.equal(lines.length, wheels.length);
  wheels.forEach((name, i) => {
    assert.equal(lines[i].class, name.replace("_knuckle", ""));
    assert.equal(lines[i].name, name.replace("_knuckle", "").replace("_", " "));
    compare(lines[i], motion.t, angles[i], { ...place, scale, height: HEIGHT / 2 });
  });
  assert.equal(await label(page, "steering"), `± ${scale.toFixed(1)}°`);
  const key = await page.locator(".steering-key span").allTextContents();
  assert.deepEqual(key, WHEELS.map((name) => name.replace("_", " ")));
  // Wheels can be told apart without colours: no two lines of one side look alike.
  const dashes = await page.evaluate(() =>
    [...document.querySelectorAll(".timeline-drawing .curve.steering path")].map((path) => {
      const { stroke, strokeDasharray } = getComputedStyle(path);
      return `${stroke} ${strokeDasharray}`;
    }),
  );
  assert.equal(new Set(dashes).size, wheels.length);
});

test("small angles do not fill the row, and a rover without steering has none", async () => {
  const small = changed(file, "small.html", ({ motion }) => {
    for (const name of Object.keys(motion.joints).filter((joint) => joint.endsWith("_knuckle"))) motion.joints[name].fill(Math.PI / 180);
  });
  const first = await open(small);
  const { lines, zero } = await drawn(first.page, "steering");
  for (const [, y] of lines[0].points) assert.ok(Math.abs(y - (zero - HEIGHT / 2 / 5)) < ROUNDED);
  const none = changed(file, "none.html", ({ motion, rover }) => {
    for (const link of rover.links) link.name = link.name.replace("_knuckle", "_strut");
    motion.joints = Object.fromEntries(Object.entries(motion.joints).map(([name, values]) => [name.replace("_knuckle", "_strut"), values]));
  });
  const second = await open(none);
  assert.equal(await second.page.locator(".timeline-drawing .curve").count(), 3);
  assert.equal(await second.page.locator(".steering-key").count(), 0);
});
