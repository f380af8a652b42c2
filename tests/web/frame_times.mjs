// How long one replay page takes for a picture, compared with another page of the same trial, where
// drawing is done in software. No test: times depend on the machine.
// Usage: node tests/web/frame_times.mjs PAGE OTHER_PAGE [PAIRS]
// with the environment of the tests (harness.mjs). Prints the other's time over the first one's, pair by
// pair, in turns, so that what else the machine does hits both.
import { launch, openPage } from "./harness.mjs";

const [files, pairs] = [process.argv.slice(2, 4), Number(process.argv[4] ?? 5)];
const PICTURES = 15;

const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];

/** Milliseconds of a picture: the median over moments of the whole drive. */
async function pictureTime(page) {
  await page.bringToFront();
  return median(await page.evaluate((count) => {
    const { start, duration } = { start: rockyardReplay.sample(0).t, duration: rockyardReplay.duration };
    const graphics = document.querySelector(".picture canvas").getContext("webgl2");
    const draw = (i) => {
      const before = performance.now();
      rockyardReplay.seek(start + (duration * (i + 0.5)) / count);
      rockyardReplay.pose();
      // Waits until it is drawn.
      graphics.readPixels(0, 0, 1, 1, graphics.RGBA, graphics.UNSIGNED_BYTE, new Uint8Array(4));
      return performance.now() - before;
    };
    // What the graphics compile is compiled at first.
    draw(0);
    return Array.from({ length: count }, (_, i) => draw(i));
  }, PICTURES));
}

const browser = await launch();
const pages = [];
for (const file of files) {
  const { page } = await openPage(browser, file, { width: 1280, height: 800, paints: true });
  await page.waitForFunction(() => window.rockyardReplay);
  pages.push(page);
}
for (const [key, view] of [["f", "follow"], ["t", "top"]]) {
  const ratios = [];
  for (let pair = 0; pair < pairs; ++pair) {
    const times = [];
    for (const which of pair % 2 ? [1, 0] : [0, 1]) {
      await pages[which].keyboard.press(key);
      times[which] = await pictureTime(pages[which]);
    }
    ratios.push(times[1] / times[0]);
  }
  console.log(`${view}: ${ratios.map((ratio) => ratio.toFixed(2)).join(" ")}, median ${median(ratios).toFixed(2)}`);
}
await browser.close();
