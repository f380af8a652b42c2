// Pages held against the rules of axe-core (WCAG 2.2 A and AA): none may be broken badly on a report.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import path from "node:path";
import { after, before, test } from "node:test";
import { launch, openPage, requirePackage, rockyard, temporaryFolder } from "./harness.mjs";
import { openReport, openTrials } from "./report_pages.mjs";

const GRAVE = ["serious", "critical"];
const RULES = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa"];
const PHONE = { width: 390, height: 844 };
// As tall as the page: what the player at the lower edge covers, until one scrolls, counts as too small.
const UNROLLED_PHONE = { ...PHONE, height: 8000 };

const axe = readFileSync(requirePackage.resolve("axe-core/axe.min.js"), "utf8");
const folder = temporaryFolder();
const at = (...names) => path.join(folder, ...names);
let browser;

function run(name, ...settings) {
  rockyard(["run", "scenarios/pathfinder/nominal.json", "--trials", "20", "--seed", "1", "--out", at(name),
    ...["rover.fidelity=quasi_static", ...settings].flatMap((setting) => ["--set", setting])]);
}

before(async () => {
  run("nominal");
  run("dense", "terrain.rocks.k_per_m2=0.008");
  rockyard(["sweep", "scenarios/sweeps/abundance.json", "--trials", "6", "--out", at("sweep"), "--set", "rover.fidelity=quasi_static"]);
  const report = (page, ...runs) => rockyard(["report", ...runs.map((each) => at(each)), "--out", at(page), "--replays", "1", "--tracks", "10"]);
  report("run.html", "nominal");
  report("comparison.html", "nominal", "dense");
  report("sweep.html", "sweep");
  rockyard(["replay", at("nominal"), "--trial", "0", "--out", at("replay.html")]);
  rockyard(["replay", at("nominal"), "--trial", "0", "--with-trial", "1", "--out", at("pair.html")]);
  // With images, so that every panel is there.
  rockyard(["replay", "scenarios/gestalt/narrow_course.json", "--trial", "0", "--out", at("steps.html"),
    ...["sensors.stereo.fidelity=image", "sensors.stereo.images.pyramid_level=0"].flatMap((setting) => ["--set", setting])]);
  browser = await launch();
});

after(() => browser?.close());

/** Rules that the page breaks: "name (impact): what, at how many places, the first of them". */
async function broken(page) {
  // The page's policy forbids scripts of others: this one comes from the browser's side.
  await page.evaluate(`${axe}; void 0`);
  const { violations } = await page.evaluate((values) => window.axe.run(document, { runOnly: { type: "tag", values } }), RULES);
  return violations.map(({ id, impact, help, nodes }) =>
    ({ impact, text: `${id} (${impact}): ${help}, ${nodes.length} times, as ${nodes[0].target.join(" ")}: ${nodes[0].html.slice(0, 120)}` }));
}

const grave = (found) => found.filter(({ impact }) => GRAVE.includes(impact)).map(({ text }) => text);

for (const name of ["run.html", "comparison.html", "sweep.html"]) {
  for (const [look, options] of Object.entries({ light: {}, dark: { scheme: "dark" }, phone: PHONE })) {
    test(`${name} breaks no rule badly: ${look}`, async () => {
      const { page } = await openReport(browser, at(name), options);
      await openTrials(page);
      for (const summary of await page.locator("summary:visible").all()) await summary.click();
      assert.deepEqual(grave(await broken(page)), []);
      await page.close();
    });
  }
}

test("the rules notice a picture without a name", async () => {
  const { page } = await openReport(browser, at("run.html"));
  await page.locator("#map-0 svg.plan").waitFor();
  await page.locator("#map-0 svg.plan").evaluate((drawing) => drawing.removeAttribute("aria-label"));
  assert.match(grave(await broken(page)).join("\n"), /svg-img-alt/);
  await page.close();
});

// At the start, and at the end with its card.
for (const name of ["replay.html", "pair.html", "steps.html"]) {
  for (const [look, options] of Object.entries({ light: {}, dark: { scheme: "dark" }, phone: UNROLLED_PHONE })) {
    test(`${name} breaks no rule badly: ${look}`, async () => {
      const { page } = await openPage(browser, at(name), { width: 1000, height: 640, ...options });
      await page.waitForFunction(() => window.rockyardReplay);
      await page.locator("details").evaluateAll((all) => all.forEach((each) => (each.open = true)));
      assert.deepEqual(grave(await broken(page)), []);
      await page.keyboard.press("End");
      await page.locator(".ending:visible").first().waitFor();
      assert.deepEqual(grave(await broken(page)), []);
      await page.close();
    });
  }
}

test("the rules notice a button without a name on a replay", async () => {
  const { page } = await openPage(browser, at("replay.html"), { width: 1000, height: 640 });
  await page.waitForFunction(() => window.rockyardReplay);
  await page.locator("button", { hasText: "Plan of the paths" }).evaluate((button) => {
    button.textContent = "";
    button.title = "";
  });
  assert.match(grave(await broken(page)).join("\n"), /button-name/);
  await page.close();
});
