// Using the report page: keyboard, colours, phones, damaged and hostile data, very many trials.
import assert from "node:assert/strict";
import { statSync } from "node:fs";
import path from "node:path";
import { describe, test } from "node:test";
import { at, rockyard } from "./harness.mjs";
import { payloadOf, withPayload, withPayloadText } from "./page_payload.mjs";
import { open, openTrials, pageTest, runNominal } from "./report_pages.mjs";

const MARKUP = `<img src=x onerror="window.ran=1"><script>window.ran=2</script>`;
const MANY = 10_000;
const MOST_BYTES = 5_000_000;
const PHONE = 380;

runNominal("nominal", 30, 2);
rockyard(["report", at("nominal"), "--out", at("report.html"), "--replays", "0",
  "--against", "results/reference/matthies1995.json"]);

const background = (page) => page.evaluate(() => getComputedStyle(document.body).backgroundColor);

/** How far the page goes beyond its window, in pixels. */
const overflow = (page) => page.evaluate(() => document.documentElement.scrollWidth - innerWidth);

describe("people", () => {
  pageTest("the keyboard reaches everything that can be used", "report.html", async (page) => {
    await openTrials(page);
    await page.evaluate(() => {
      scrollTo(0, 0);
      document.activeElement?.blur();
      const usable = "a[href], button:not(:disabled), input:not(:disabled), select:not(:disabled), summary";
      window.left = new Set([...document.querySelectorAll(usable)].filter((each) => each.checkVisibility()));
      window.known = window.left.size;
      document.addEventListener("focusin", ({ target }) => window.left.delete(target));
    });
    const known = await page.evaluate(() => window.known);
    assert.ok(known > 50, `only ${known} controls`);
    // Scrolling boxes take the focus too, so there are more stops than controls.
    for (let i = 0; i < 2 * known; ++i) await page.keyboard.press("Tab");
    const left = await page.evaluate(() => [...window.left].map((each) => each.outerHTML.slice(0, 120)));
    assert.deepEqual(left, []);
  });

  pageTest("the first stop skips to the content", "report.html", async (page) => {
    await page.keyboard.press("Tab");
    assert.equal(await page.evaluate(() => document.activeElement.textContent), "Skip to the content");
    await page.keyboard.press("Enter");
    assert.equal(await page.evaluate(() => location.hash), "#content");
  });

  pageTest("colours follow the system until the switch is used", "report.html", async (page) => {
    const dark = await background(page);
    const chart = () => page.locator("#distance-cdf svg text").first().evaluate((each) => getComputedStyle(each).fill);
    const textInDark = await chart();
    await page.locator(".theme-switch").click();
    const light = await background(page);
    assert.notEqual(light, dark);
    assert.notEqual(await chart(), textInDark);
    await page.locator(".theme-switch").click();
    assert.equal(await background(page), dark);
    const other = await open("report.html", { scheme: "light" });
    assert.equal(await background(other.page), light);
  }, { scheme: "dark" });

  pageTest("on a phone nothing goes beyond the window, and charts are drawn anew at another width", "report.html", async (page) => {
    await openTrials(page);
    assert.equal(await overflow(page), 0);
    for (const summary of await page.locator("summary:visible").all()) await summary.click();
    assert.equal(await overflow(page), 0);
    const width = () => page.locator("#distance-cdf svg").first().getAttribute("width").then(Number);
    assert.ok((await width()) <= PHONE);
    await page.setViewportSize({ width: 1280, height: 900 });
    await page.waitForFunction((phone) => Number(document.querySelector("#distance-cdf svg").getAttribute("width")) > phone, PHONE);
  }, { width: PHONE });

  pageTest("every chart says in words what it shows and holds its numbers", "report.html", async (page) => {
    const figures = page.locator("figure");
    assert.ok((await figures.count()) >= 8);
    for (const figure of await figures.all()) {
      const label = await figure.locator("[role=img]").first().getAttribute("aria-label");
      assert.ok(label.length > 20, label);
      assert.ok((await figure.locator("figcaption").innerText()).length > 20);
      await figure.locator("details > summary").first().click();
      await figure.locator("details table").first().waitFor();
      assert.ok((await figure.locator("details tbody tr").count()) > 0);
    }
  });

  pageTest("the address names the section", "report.html", async (page) => {
    await page.getByRole("link", { name: "Parameters" }).click();
    assert.equal(await page.evaluate(() => location.hash), "#parameters");
  });
});

describe("data", () => {
  test("markup in names is text, and runs nothing", async () => {
    withPayload(at("report.html"), at("markup.html"), (payload) => {
      payload.title = MARKUP;
      payload.command = MARKUP;
      const [run] = payload.runs;
      Object.assign(run, { label: MARKUP, folder: MARKUP, replay_command: `${MARKUP} {trial}` });
      run.summary.scenario = MARKUP;
      run.trials.outcome_names = run.trials.outcome_names.map((name, i) => `${MARKUP}${i}`);
      run.trials.detail_texts = run.trials.detail_texts.map(() => MARKUP);
      run.trials.columns[0].name = MARKUP;
      run.parameters[0].doc = MARKUP;
      run.parameters[0].origin = MARKUP;
      run.published.rows[0].what = MARKUP;
      run.published.rows[0].verdict = MARKUP;
      run.replays = { 0: "javascript:window.ran=3", 1: "report_replays/1.html" };
      run.examples = [0, 1];
      run.endings.forEach((ending) => Object.assign(ending, { outcome: MARKUP, detail: MARKUP }));
      run.course.rover = MARKUP;
      const second = structuredClone(run);
      second.label = `${MARKUP} 2`;
      payload.runs.push(second);
    });
    const { page, requests } = await open("markup.html");
    await openTrials(page);
    for (const summary of await page.locator("summary:visible").all()) await summary.click();
    await page.locator(".command-button").first().click();
    assert.equal(await page.locator("h1").innerText(), MARKUP);
    assert.ok((await page.locator("#trials .tabulator-row").first().innerText()).includes(MARKUP));
    assert.equal(await page.locator("#page img, #page script").count(), 0);
    assert.equal(await page.locator("a[href^=javascript]").count(), 0);
    const links = await page.locator("#trials .tabulator-row a").evaluateAll((all) => all.map((link) => link.getAttribute("href")));
    assert.deepEqual(links, ["report_replays/1.html"]);
    assert.equal(await page.evaluate(() => window.ran), undefined);
    assert.equal(requests.length, 1);
  });

  test("damaged data gives a plain message", async () => {
    const whole = payloadOf(at("report.html"));
    const damages = {
      none: withPayloadText(at("report.html"), at("none.html"), ""),
      cut: withPayloadText(at("report.html"), at("cut.html"), Buffer.from("H4sIAAAA", "base64").toString("base64")),
      strange: withPayloadText(at("report.html"), at("strange.html"), "not base64 <at all>"),
      other: withPayload(at("report.html"), at("other.html"), () => [whole.title]),
    };
    for (const [name, file] of Object.entries(damages)) {
      const { page } = await open(path.basename(file));
      assert.match(await page.getByRole("alert").innerText(), /cannot be shown/, name);
    }
  });

  test("a part without data is left out, and the rest lives", async () => {
    withPayload(at("report.html"), at("bare.html"), ({ version, title, runs: [{ label, summary }] }) =>
      ({ version, title, runs: [{ label, summary }], surprise: 1 }));
    const { page } = await open("bare.html");
    const sections = await page.locator("section").evaluateAll((all) => all.map((section) => section.id));
    assert.deepEqual(sections, ["answer", "outcomes", "about", "headline", "provenance"]);
    assert.equal(await page.locator(".problem").count(), 0);
  });

  test("a part that cannot be drawn says so, and the rest lives", async () => {
    withPayload(at("report.html"), at("broken.html"), (payload) => {
      payload.runs[0].published.rows = [{}];
    });
    const { page } = await open("broken.html");
    assert.match(await page.locator("#published .problem").innerText(), /could not be drawn/);
    assert.equal(await page.locator("#distance-cdf svg").first().isVisible(), true);
  });

  test("twenty runs are chosen from, six at a time", async () => {
    withPayload(at("report.html"), at("twenty.html"), (payload) => {
      payload.runs = Array.from({ length: 20 }, (_, i) => ({ ...payload.runs[0], label: `run ${i}` }));
    });
    const { page } = await open("twenty.html");
    const boxes = page.locator("#runs input");
    assert.equal(await boxes.count(), 20);
    assert.equal(await page.locator("#runs input:checked").count(), 6);
    assert.equal(await page.locator("#runs input:disabled").count(), 14);
    await page.locator("#runs input:checked").first().uncheck();
    assert.equal(await page.locator("#runs input:disabled").count(), 0);
  });

  test("ten thousand trials are a small page that opens", async (t) => {
    withPayload(at("report.html"), at("many.html"), (payload) => {
      const { trials } = payload.runs[0];
      const repeated = (values) => Array.from({ length: MANY }, (_, i) => values[i % values.length]);
      trials.trial = Array.from({ length: MANY }, (_, i) => i);
      trials.outcome = repeated(trials.outcome);
      trials.detail = repeated(trials.detail);
      // Digits as a real run has them: repeated ones would be compressed to nothing.
      let state = 1;
      const noise = () => (state = (state * 48271) % 2147483647) / 2147483647;
      for (const column of trials.columns) {
        column.values = repeated(column.values).map((value) =>
          value === null || Number.isInteger(value) ? value : Number((value * (1 + 0.1 * noise())).toPrecision(6)));
      }
    });
    const bytes = statSync(at("many.html")).size;
    assert.ok(bytes < MOST_BYTES, `${bytes} bytes`);
    const { page } = await open("many.html");
    const drawn_ms = await page.evaluate(() => Number(document.documentElement.dataset.ready));
    const started = Date.now();
    await openTrials(page);
    t.diagnostic(`${(bytes / 1e6).toFixed(2)} MB; drawn after ${drawn_ms} ms, its table within ${Date.now() - started} ms more`);
    assert.equal(await page.locator("#trials-found").innerText(), "10,000 of 10,000 trials");
    await page.locator("#trial-search").fill("9999");
    assert.equal(await page.locator("#trials .tabulator-row").count(), 1);
  });
});
