// The replay page of a drive whose stereo cameras took images.
import assert from "node:assert/strict";
import { statSync } from "node:fs";
import { test } from "node:test";
import { at, rockyard, set } from "./harness.mjs";
import { payloadOf } from "./page_payload.mjs";
import { changed, MOST_BYTES, open, pageTest } from "./replay_pages.mjs";

const SETTINGS = ["sensors.stereo.fidelity=image", "sensors.stereo.images.pyramid_level=0", "rover.fidelity=quasi_static", "referee.time_limit_s=300"];

const file = at("stereo.html");
rockyard(["replay", "scenarios/gestalt/narrow_course.json", "--trial", "0", "--out", file, ...set(...SETTINGS)]);
const { looks } = payloadOf(file).eyes;

/** What the panel shows at a time. */
const shownAt = (page, t) =>
  page.evaluate(async (time) => {
    rockyardReplay.seek(time);
    rockyardReplay.pose();
    const panel = document.querySelector(".eyes");
    const images = [...panel.querySelectorAll("img")];
    await Promise.all(images.filter((image) => image.src).map((image) => image.decode()));
    return {
      caption: panel.querySelector(".caption").textContent,
      hidden: panel.querySelector(".pictures").hidden,
      pictures: images.map(({ src, alt, naturalWidth, naturalHeight }) => ({ src, alt, size: [naturalWidth, naturalHeight] })),
    };
  }, t);

test("is smaller than 3 MB", () => {
  assert.ok(looks.length > 2);
  assert.ok(statSync(file).size < MOST_BYTES, `${statSync(file).size} bytes`);
});

test("shows the last look at every moment", async () => {
  const { page, requests } = await open(file);
  for (const [i, look] of looks.entries()) {
    // At its own moment, and just before the next one.
    for (const t of [look.t, (looks[i + 1]?.t ?? look.t + 1) - 0.01]) {
      const { caption, hidden, pictures } = await shownAt(page, t);
      assert.equal(hidden, false);
      assert.match(caption, new RegExp(`^Look ${look.number} of the ${look.behind ? "rear" : "front"} cameras at .*: ${look.points} points\\.$`));
      assert.deepEqual(pictures.map(({ src }) => src), [look.left, look.disparity].map((png) => `data:image/png;base64,${png}`));
      assert.deepEqual(pictures.map(({ size }) => size), [[128, 128], [128, 128]]);
      for (const { alt } of pictures) assert.ok(alt.length > 20, alt);
    }
  }
  assert.deepEqual(requests.filter((url) => !url.startsWith("file:") && !url.startsWith("data:") && !url.startsWith("blob:")), []);
});

test("names the rear cameras, and says what was left out", async () => {
  const target = changed(file, "behind.html", (payload) => {
    payload.eyes.every = 3;
    payload.eyes.looks = payload.eyes.looks.slice(1);
    payload.eyes.looks[0].behind = true;
  });
  const { page } = await open(target);
  const first = await shownAt(page, looks[0].t);
  assert.equal(first.caption, "No look yet.");
  assert.equal(first.hidden, true);
  const { caption, pictures } = await shownAt(page, looks[1].t);
  assert.match(caption, /^Look 1 of the rear cameras/);
  assert.match(pictures[0].alt, /rear/);
  assert.match(await page.textContent(".eyes"), /one look out of 3/);
});

pageTest("has no such panel without images", changed(file, "none.html", (payload) => (payload.eyes = null)), async (page) => {
  assert.equal(await page.locator(".eyes").count(), 0);
  assert.equal(await page.locator(".readout").count(), 1);
});
