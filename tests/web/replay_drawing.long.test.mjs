// What the scene of the replay draws beside rover and paths: it is held against the data of the page.
import assert from "node:assert/strict";
import { test } from "node:test";
import { at, loadModule, rockyard, set } from "./harness.mjs";
import { expectedLinks, rotated } from "./link_places.mjs";
import { payloadOf } from "./page_payload.mjs";
import { changed, difference, open, pageTest, pixels, replayOf, seekShare } from "./replay_pages.mjs";

const { MOST_DRAW_CALLS, MOST_TRIANGLES, ROUGH_DEPTH } = await loadModule("replay/scene/limits.ts");

// float32 of lengths around 1 m.
const DIGITS = 1e-5;

/** The page of one trial with other settings. */
function pageOf(scenario, name, settings) {
  const file = at(`${name}.html`);
  rockyard(["replay", `scenarios/${scenario}.json`, "--trial", "1", "--seed", "1", "--out", file, "--svg", at(`${name}.svg`), ...set(...settings)]);
  return file;
}

const drawing = (page) => page.evaluate(() => rockyardReplay.drawing());

const dot = (a, b) => a.x * b.x + a.y * b.y + a.z * b.z;
const minus = (a, b) => ({ x: a.x - b.x, y: a.y - b.y, z: a.z - b.z });
const vector = ([x, y, z]) => ({ x, y, z });

/** A vector of a frame with this attitude, in W. */
function turned({ w, x, y, z }, v) {
  const t = { x: 2 * (y * v.z - z * v.y), y: 2 * (z * v.x - x * v.z), z: 2 * (x * v.y - y * v.x) };
  return { x: v.x + w * t.x + y * t.z - z * t.y, y: v.y + w * t.y + z * t.x - x * t.z, z: v.z + w * t.z + x * t.y - y * t.x };
}

/** x and y of the middles of all wheels at sample i. */
function wheelPlaces(rover, motion, i) {
  const links = expectedLinks(rover, motion, i);
  return rover.links.flatMap(({ shapes }, k) =>
    shapes.filter(({ kind }) => kind === "wheel").map(({ center }) => {
      const offset = rotated(links[k].turn, center);
      return [links[k].at[0] + offset[0], links[k].at[1] + offset[1]];
    }),
  );
}

const nominal = replayOf("pathfinder/nominal", "nominal").file;

const shortTrial = ["referee.time_limit_s=300"];
const crowds = {
  nominal: () => nominal,
  "Viking Lander 2": () => pageOf("pathfinder/vl2", "vl2", shortTrial),
  "Viking Lander 2 with the Athena SDM": () => pageOf("gestalt/viking_lander_2", "gestalt", shortTrial),
  "the highest abundance": () => pageOf("gestalt/abundance", "abundance", ["terrain.rocks.k_per_m2=0.02", ...shortTrial]),
  "the highest abundance on rough ground": () =>
    pageOf("gestalt/abundance", "rough", ["terrain.rocks.k_per_m2=0.02", "terrain.ground.roughness_rms_m=0.03", ...shortTrial]),
  "ten thousand rocks": () =>
    changed(nominal, "crowd.html", (payload) => {
      const [rock] = payload.rocks;
      payload.rocks = Array.from({ length: 10_000 }, (_, i) => ({ ...rock, x: 0.08 * (i % 150), y: 0.06 * Math.floor(i / 150) - 2 }));
    }),
};

for (const [name, make] of Object.entries(crowds)) {
  pageTest(`a picture keeps to its triangles and calls: ${name}`, make(), async (page) => {
    await seekShare(page, 0.5);
    await page.keyboard.press("l");
    for (const mode of ["f", "t", "r", "o", "x"]) {
      await page.keyboard.press(mode);
      const { triangles, calls } = await drawing(page);
      assert.ok(triangles > 10_000 && triangles <= MOST_TRIANGLES, `${triangles} triangles after key ${mode}`);
      assert.ok(calls > 30 && calls <= MOST_DRAW_CALLS, `${calls} calls after key ${mode}`);
    }
  });
}

pageTest("the page says its limits, and what is drawn only", nominal, async (page) => {
  await page.locator(".about-picture summary").click();
  const text = await page.locator(".about-picture").innerText();
  for (const words of [MOST_TRIANGLES.toLocaleString("en-US"), `${MOST_DRAW_CALLS} draw calls`, `${100 * ROUGH_DEPTH} %`, "9.81 m/s²", "Drawn only"]) {
    assert.ok(text.includes(words), words);
  }
});

test("the sun stands where the scenario says, and its shadows fall away from it", async () => {
  const pictures = [];
  for (const [azimuth, x, y] of [[-60, 0.5, -Math.sqrt(0.75)], [120, -0.5, Math.sqrt(0.75)]]) {
    const settings = ["sensors.sun.elevation_deg=20", `sensors.sun.azimuth_deg=${azimuth}`, ...shortTrial];
    const { page } = await open(pageOf("pathfinder/nominal", `sun${azimuth}`, settings));
    const { sun } = await drawing(page);
    const flat = Math.cos(Math.PI / 9);
    const expected = { x: flat * x, y: flat * y, z: Math.sin(Math.PI / 9) };
    for (const axis of ["x", "y", "z"]) assert.ok(Math.abs(sun[axis] - expected[axis]) < 2e-5, `${axis}: ${sun[axis]}`);
    await page.keyboard.press("t");
    pictures.push(await pixels(page));
  }
  assert.ok(difference(...pictures) > 0.02);
});

test("what surrounds the terrain is what the world is", async () => {
  const worlds = { hall: nominal, mars: pageOf("mars/mfex_nominal", "mars", shortTrial), field: pageOf("gestalt/narrow_course", "field", shortTrial) };
  for (const [world, file] of Object.entries(worlds)) {
    const { page } = await open(file);
    assert.equal((await drawing(page)).world, world);
  }
});

test("walls are seen from within, and seen through from outside", async () => {
  const { page } = await open(pageOf("pathfinder/nominal", "walled", ["terrain.arena.kind=walled", ...shortTrial]));
  await page.locator(".about-picture summary").click();
  assert.ok((await page.locator(".about-picture").innerText()).includes("Walls are drawn 35 cm high"));
  const { course } = payloadOf(at("walled.html"));
  assert.equal(course.walls.length, 4);
  const { page: open_ } = await open(changed(at("walled.html"), "no_walls.html", (payload) => (payload.course.walls = [])));
  const { page: walled } = await open(at("walled.html"));
  assert.ok(difference(await pixels(open_), await pixels(walled)) > 0.002);
});

pageTest("key x shows the true shapes of rocks, and rough ones lie within them", nominal, async (page) => {
  await seekShare(page, 0.5);
  const rough = await drawing(page);
  const picture = await pixels(page);
  assert.equal(rough.trueShapes, false);
  assert.ok(rough.rockDepths.deepest > 0.05 && rough.rockDepths.deepest <= ROUGH_DEPTH + DIGITS, `${rough.rockDepths.deepest}`);
  assert.ok(rough.rockDepths.outermost <= DIGITS, `${rough.rockDepths.outermost}`);
  await page.keyboard.press("x");
  const smooth = await drawing(page);
  assert.equal(smooth.trueShapes, true);
  assert.deepEqual(smooth.rockDepths, { deepest: 0, outermost: 0 });
  assert.ok(await page.getByLabel("True shapes of rocks").isChecked());
  assert.ok(difference(picture, await pixels(page)) > 0.002);
  await page.keyboard.press("x");
  assert.equal(difference(picture, await pixels(page)), 0);
});

pageTest("tracks lie where the wheels were, and grow with time", nominal, async (page) => {
  const { motion, rover } = payloadOf(nominal);
  await page.evaluate((t) => rockyardReplay.seek(t), motion.t[0]);
  assert.equal((await drawing(page)).tracks.length, 0);
  await seekShare(page, 0.4);
  const before = (await drawing(page)).tracks.length;
  await seekShare(page, 0.6);
  const { tracks } = await drawing(page);
  assert.ok(tracks.length > before && before > 50, `${before}, then ${tracks.length}`);
  const end = motion.t[0] + 0.6 * (motion.t.at(-1) - motion.t[0]);
  const places = motion.t.filter((t) => t <= end).flatMap((_, i) => wheelPlaces(rover, motion, i));
  const width = Math.max(...tracks.map((print) => print.width));
  for (const print of tracks) {
    const nearest = Math.min(...places.map(([x, y]) => Math.hypot(x - print.x, y - print.y)));
    assert.ok(nearest < 1e-4, `${nearest} m from any wheel`);
    assert.ok(Math.abs(print.width - width) < 0.02, `${print.width} m wide`);
  }
  await seekShare(page, 0.6);
  const shown = await pixels(page);
  await page.getByLabel("Wheel tracks").uncheck();
  assert.equal((await drawing(page)).tracks.length, 0);
  assert.ok(difference(shown, await pixels(page)) > 0.002);
});

pageTest("light planes go through their emitters while a scan runs, and end on the ground, a rock or in the air", nominal, async (page) => {
  const { scans, sensor, motion } = payloadOf(nominal);
  const scanning = motion.activity_names.indexOf("scan");
  const sample = motion.activity.findIndex((activity, i) => activity === scanning && motion.t[i] > scans[20].t);
  const [from, to] = [motion.t[sample - 1], motion.t[sample]];
  await page.evaluate((t) => rockyardReplay.seek(t), (from + to) / 2);
  const { planes } = await drawing(page);
  const rover = (await page.evaluate(() => rockyardReplay.links()))[0];
  assert.equal(planes.length, sensor.lasers.length);
  planes.forEach(({ emitter, ends }, i) => {
    const laser = sensor.lasers[i];
    const mounted = turned(rover.attitude, vector(laser.emitter));
    for (const axis of ["x", "y", "z"]) assert.ok(Math.abs(emitter[axis] - rover[axis] - mounted[axis]) < 1e-6, axis);
    const normal = turned(rover.attitude, vector(laser.normal));
    const along = turned(rover.attitude, vector(laser.axis));
    for (const end of ends) {
      const ray = minus(end, emitter);
      const length = Math.hypot(ray.x, ray.y, ray.z);
      assert.ok(Math.abs(dot(ray, normal)) < 1e-4, "out of the plane");
      assert.ok(dot(ray, along) / length > Math.cos(laser.half_fan) - 1e-4, "out of the fan");
      assert.ok(length < sensor.reach + 1e-6 && end.z > -1e-3, `${length} m to a height of ${end.z} m`);
    }
    assert.ok(ends.some(({ z }) => Math.abs(z) < 1e-3), "reaches no ground");
  });
  const lit = await pixels(page);
  await page.getByLabel("Light planes while it scans").uncheck();
  assert.equal((await drawing(page)).planes.length, 0);
  assert.ok(difference(lit, await pixels(page)) > 0.001);
  await page.getByLabel("Light planes while it scans").check();
  const driving = motion.activity.findIndex((activity, i) => motion.activity_names[activity] === "drive" && motion.t[i] > motion.t[i - 1] + 0.1);
  await page.evaluate((t) => rockyardReplay.seek(t), (motion.t[driving - 1] + motion.t[driving]) / 2);
  assert.equal((await drawing(page)).planes.length, 0);
});

test("key l shows what each camera sees", async () => {
  for (const [file, cameras] of [[nominal, 2], [pageOf("gestalt/narrow_course", "stereo", shortTrial), 4]]) {
    assert.equal(payloadOf(file).sensor.cameras.length, cameras);
    const { page } = await open(file);
    assert.equal((await drawing(page)).views, 0);
    const without = await pixels(page);
    await page.keyboard.press("l");
    assert.equal((await drawing(page)).views, cameras);
    assert.ok(difference(without, await pixels(page)) > 0.002);
  }
});

pageTest("shadows reach the rover and the ground about it in every view", nominal, async (page) => {
  for (const key of ["f", "t", "r", "o"]) {
    for (const share of [0, 0.5, 1]) {
      await page.keyboard.press(key);
      await seekShare(page, share);
      const { shadow } = await drawing(page);
      const links = await page.evaluate(() => rockyardReplay.links());
      for (const { x, y, z } of links) {
        for (const [dx, dy] of [[-0.5, -0.5], [0.5, -0.5], [-0.5, 0.5], [0.5, 0.5]]) {
          const m = shadow.toLight;
          const at = [0, 1, 2].map((row) => m[row] * (x + dx) + m[4 + row] * (y + dy) + m[8 + row] * z + m[12 + row]);
          assert.ok(at.every((value) => Math.abs(value) <= 1), `${key} at ${share}: ${at}`);
        }
      }
      assert.ok(shadow.texel < 0.016, `${shadow.texel} m a pixel`);
    }
  }
});

pageTest("the plain picture has no textures, and everything else", nominal, async (page) => {
  await seekShare(page, 0.5);
  const full = await pixels(page);
  const { triangles } = await drawing(page);
  await page.getByLabel("Plain: no textures").check();
  assert.ok(difference(full, await pixels(page)) > 0.2);
  assert.equal((await drawing(page)).triangles, triangles);
  await page.getByLabel("Plain: no textures").uncheck();
  assert.equal(difference(full, await pixels(page)), 0);
});

test("mirror lines are explained where operators turn the rover back, and where it drives on", async () => {
  for (const [file, words] of [[nominal, "Operators turn the rover back there."], [pageOf("pathfinder/nominal", "unfolded", ["terrain.arena.kind=virtual_unfolded", ...shortTrial]), "The rover drives on."]]) {
    const { page } = await open(file);
    const text = await page.getByText("Mirror line: the course is mirrored here").innerText();
    assert.ok(text.includes(words), text);
  }
});
