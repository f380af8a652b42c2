// The browser of a file of tests: started before them, closed after them. What a test opens closes with it, and
// nothing may have gone wrong in it.
import assert from "node:assert/strict";
import { after, afterEach, before } from "node:test";
import { launch, openPage } from "./harness.mjs";

let browser;
let opened = [];
const kept = new Set();

before(async () => {
  browser = await launch();
});

afterEach(async () => {
  const problems = opened.flatMap((each) => each.problems);
  opened = opened.filter(({ page }) => kept.has(page.context()));
  await Promise.all(browser.contexts().filter((context) => !kept.has(context)).map((context) => context.close()));
  assert.deepEqual(problems, []);
});

after(() => browser?.close());

export const testBrowser = () => browser;

/** Opens a file as openPage does: with `kept` for all tests, with `damaged` to see what is said of a page that is. */
export async function open(file, { kept: forAll = false, damaged = false, ...options } = {}) {
  const page = await openPage(browser, file, options);
  if (forAll) kept.add(page.page.context());
  if (!damaged) opened.push(page);
  return page;
}
