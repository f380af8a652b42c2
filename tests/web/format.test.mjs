// Numbers as text, without a browser.
import assert from "node:assert/strict";
import { test } from "node:test";
import { loadModule } from "./harness.mjs";

const { fixed, percent, percentInterval, points, pointsInterval } = await loadModule("shared/format.ts");

const plain = (text) => text.replaceAll("\u00a0", " ");

test("an interval that excludes zero or all does not read as if it touched them", () => {
  assert.equal(plain(percentInterval(0.0003, 0.031)), "0.03 to 3.10 %");
  assert.equal(plain(percentInterval(-0.12, 0.001)), "−12.0 to 0.1 %");
  assert.equal(plain(percentInterval(-0.00001, 0.02)), "−0.001 to 2.000 %");
  assert.equal(plain(percentInterval(0.999, 0.99999)), "99.900 to 99.999 %");
  assert.equal(plain(percentInterval(0.699, 0.972)), "69.9 to 97.2 %");
  assert.equal(plain(percentInterval(0, 1)), "0.0 to 100.0 %");
  assert.equal(pointsInterval(-0.0004, 0.3), "−0.04 to 30.00");
});

test("a rate near to an end of its scale keeps its digits, at both ends alike", () => {
  const texts = [0.9996, 0.0004, 0.0049, 0.0051, 0.9, 0, 1].map((rate) => plain(percent(rate)));
  assert.deepEqual(texts, ["99.96 %", "0.04 %", "0.5 %", "0.5 %", "90.0 %", "0.0 %", "100.0 %"]);
  assert.equal(plain(percent(1e-9)), "< 0.0001 %");
  assert.equal(plain(percent(1 - 1e-9)), "> 99.9999 %");
  assert.equal(points(-1e-9), "> −0.0001");
  assert.equal(points(-0.35), "−35.0");
});

test("a zero has no sign", () => {
  assert.equal(fixed(-0.04, 1), "0.0");
  assert.equal(fixed(-0.06, 1), "−0.1");
  assert.equal(plain(percent(-0)), "0.0 %");
});
