// Fingers on the replay page: a phone must be able to scroll past the picture, and to turn it.
import assert from "node:assert/strict";
import { test } from "node:test";
import { difference, open, pixels, replayOf } from "./replay_pages.mjs";

const WIDTH = 380;

const { file } = replayOf("pathfinder/nominal", "nominal");

// A page that was pushed goes on for a while.
async function restsAt(page, frames) {
  let last = NaN;
  for (let same = 0; same < 5; ) {
    await frames();
    const now = await page.evaluate(() => scrollY);
    same = now === last ? same + 1 : 0;
    last = now;
  }
  return last;
}

/** A phone with the page, and what fingers on the picture do: pixels that change, px that the page scrolls. */
async function phone() {
  const { page } = await open(file, { width: WIDTH, height: 760, hasTouch: true, isMobile: true });
  const session = await page.context().newCDPSession(page);
  const { y, height } = await page.locator(".picture canvas").boundingBox();
  const middle = y + height / 2;
  const send = (type, touchPoints) => session.send("Input.dispatchTouchEvent", { type, touchPoints });
  const frames = () => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  // Moves fingers [x from, x to, y to], all from the middle; then the page is as before.
  const drag = async (...fingers) => {
    const still = await pixels(page);
    const at = (share) => fingers.map(([from, to, up], id) => ({ id, x: from + share * (to - from), y: middle + share * up }));
    await send("touchStart", at(0));
    for (let i = 1; i <= 10; ++i) await send("touchMove", at(i / 10));
    await send("touchEnd", []);
    const scrolled = await restsAt(page, frames);
    await page.evaluate(() => scrollTo(0, 0));
    await frames();
    return { scrolled, changed: difference(still, await pixels(page)) };
  };
  return { page, drag, tap: (tapY) => page.touchscreen.tap(WIDTH / 2, tapY), middle };
}

const UP = [WIDTH / 2, WIDTH / 2, -150];
const ASIDE = [WIDTH / 2, WIDTH / 2 + 120, 0];

test("one finger scrolls past the picture, and turns it sideways", async () => {
  const { page, drag } = await phone();
  assert.equal(await page.locator(".touch-hint").isVisible(), false);
  assert.ok((await drag(UP)).scrolled > 100);
  assert.match(await page.locator(".touch-hint:visible").textContent(), /Tap the picture/);
  const { scrolled, changed } = await drag(ASIDE);
  assert.equal(scrolled, 0);
  assert.ok(changed > 0.05, `${changed}`);
});

test("after a tap one finger turns the picture, until a tap beside it", async () => {
  const { page, drag, tap, middle } = await phone();
  await tap(middle);
  const { scrolled, changed } = await drag(UP);
  assert.equal(scrolled, 0);
  assert.ok(changed > 0.05, `${changed}`);
  await tap(20);
  assert.ok((await drag(UP)).scrolled > 100);
});

test("two fingers belong to the picture", async () => {
  const { page, drag } = await phone();
  for (const fingers of [[[120, 120, -120], [260, 260, -120]], [[150, 60, 0], [230, 320, 0]]]) {
    const { scrolled, changed } = await drag(...fingers);
    assert.equal(scrolled, 0);
    assert.ok(changed > 0.05, `${changed}`);
  }
});

test("what a thumb has to hit is large enough, and nothing lies on the picture", async () => {
  const { page } = await phone();
  for (const part of [".layers label.check", ".timeline-labels .row", ".cameras button"]) {
    for (const target of await page.locator(part).all()) {
      const { width, height } = await target.boundingBox();
      assert.ok(width >= 24 && height >= 24, `${part}: ${width} x ${height}`);
    }
  }
  const bar = await page.locator(".cameras").boundingBox();
  const picture = await page.locator(".picture canvas").boundingBox();
  assert.ok(bar.y + bar.height <= picture.y + 1);
});
