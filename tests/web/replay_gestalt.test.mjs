// The replay page of a drive with GESTALT.
import assert from "node:assert/strict";
import { statSync } from "node:fs";
import { test } from "node:test";
import { payloadOf } from "./page_payload.mjs";
import { difference, MOST_BYTES, pageTest, pixels, replayOf } from "./replay_pages.mjs";

const { file } = replayOf("gestalt/narrow_course", "gestalt");

test("is smaller than 3 MB", () => {
  assert.ok(statSync(file).size < MOST_BYTES, `${statSync(file).size} bytes`);
});

pageTest("shows the map on the ground and the votes of each decision", file, async (page) => {
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
});
