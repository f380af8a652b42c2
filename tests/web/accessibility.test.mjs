// One look of each kind of page, and that the rules notice what they should; all looks: accessibility.long.test.mjs.
import assert from "node:assert/strict";
import { test } from "node:test";
import { graveIn, openReplay, openRun, testUse } from "./accessibility_pages.mjs";

testUse([["run.html", "light"]], [["replay.html", "dark"]], 4);

test("the rules notice a picture without a name", async () => {
  const { page } = await openRun();
  await page.locator("#map-0 svg.plan").waitFor();
  await page.locator("#map-0 svg.plan").evaluate((drawing) => drawing.removeAttribute("aria-label"));
  assert.match((await graveIn(page, ["svg-img-alt"])).join("\n"), /svg-img-alt/);
});

test("the rules notice a button without a name on a replay", async () => {
  const { page } = await openReplay("replay.html");
  await page.locator("button", { hasText: "Plan of the paths" }).evaluate((button) => {
    button.textContent = "";
    button.title = "";
  });
  assert.match((await graveIn(page, ["button-name"])).join("\n"), /button-name/);
});
