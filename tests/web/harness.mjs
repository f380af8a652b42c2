// What the tests of the pages share: a browser, pages opened from disk, and the rockyard command.
//
// ROCKYARD is the command, ROCKYARD_PAGES_FOLDER holds node_modules, CHROMIUM is the browser.
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import path from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

function fromEnvironment(name) {
  const value = process.env[name];
  if (!value) throw new Error(`the environment variable ${name} is missing: run these tests with ctest`);
  return value;
}

export const commandLine = fromEnvironment("ROCKYARD");
export const sourceFolder = path.resolve(path.dirname(fileURLToPath(import.meta.url)), "../..");
/** Holds the npm packages and the bundled pages. */
export const pagesFolder = fromEnvironment("ROCKYARD_PAGES_FOLDER");
/** Loads an npm package of the pages. */
export const requirePackage = createRequire(path.join(pagesFolder, "package.json"));

const { chromium } = requirePackage("playwright-core");

/** Ends what hangs; no test waits by the clock. */
const HANG_MS = 900_000;

/** A module of the pages, by its path in src/web, for tests without a browser. */
export async function loadModule(module) {
  const entry = path.join(sourceFolder, "src/web", module);
  const { outputFiles } = requirePackage("esbuild").buildSync({ entryPoints: [entry], bundle: true, write: false, format: "esm" });
  return import(`data:text/javascript;base64,${Buffer.from(outputFiles[0].text).toString("base64")}`);
}

/** Runs rockyard in the source folder; throws with what it printed unless it exits as expected. */
export function rockyard(args, { exit = 0 } = {}) {
  try {
    const text = execFileSync(commandLine, args, {
      cwd: sourceFolder, encoding: "utf8", stdio: ["ignore", "pipe", "pipe"], maxBuffer: 1 << 28,
    });
    if (exit !== 0) throw new Error(`rockyard ${args.join(" ")} exited with 0, not ${exit}`);
    return text;
  } catch (error) {
    if (error.status === exit && exit !== undefined) return `${error.stdout}${error.stderr}`;
    throw new Error(`rockyard ${args.join(" ")}: ${error.message}\n${error.stdout ?? ""}${error.stderr ?? ""}`);
  }
}

/** Settings as options of the command. */
export const set = (...settings) => settings.flatMap((setting) => ["--set", setting]);

const folder = mkdtempSync(path.join(tmpdir(), "rockyard-web-"));
process.on("exit", () => rmSync(folder, { recursive: true, force: true }));

/** A place in a folder that goes when the test file ends. */
export const at = (...names) => path.join(folder, ...names);

/** A CSV file without quoted fields before the last column, as rows by column name. */
export function csv(file) {
  const [head, ...lines] = readFileSync(file, "utf8").trim().split("\n");
  const columns = head.split(",");
  return lines.map((line) => Object.fromEntries(line.split(",").map((field, i) => [columns[i], field])));
}

/** The browser without a window, with 3-D drawing in software. */
export function launch() {
  return chromium.launch({
    timeout: HANG_MS,
    executablePath: fromEnvironment("CHROMIUM"),
    // No sandbox: tests run as root in containers, and open only pages that they wrote themselves.
    // All but 3-D is drawn by the processor itself, not by one that plays a graphics card: that takes twice the time.
    args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
      "--disable-gpu-compositing", "--disable-gpu-rasterization", "--disable-accelerated-2d-canvas"],
  });
}

/** In the page: triangles are handed on, but filled only while `window.paints`, as filling in software takes nearly all the time. */
function paintWhenAsked() {
  const { getContext } = HTMLCanvasElement.prototype;
  HTMLCanvasElement.prototype.getContext = function (kind, settings) {
    return getContext.call(this, kind, kind === "webgl2" ? { ...settings, antialias: false } : settings);
  };
  for (const name of ["drawArrays", "drawElements", "drawArraysInstanced", "drawElementsInstanced", "drawRangeElements"]) {
    const draw = WebGL2RenderingContext.prototype[name];
    WebGL2RenderingContext.prototype[name] = function (...values) {
      if (window.paints) draw.apply(this, values);
    };
  }
}

/** In the page: a browser that has no WebGL. */
function hideWebGl() {
  const { getContext } = HTMLCanvasElement.prototype;
  HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
    return kind.startsWith("webgl") ? null : getContext.call(this, kind, ...rest);
  };
}

/**
 * Opens a file. With `paints` the browser fills every picture, else those that pixels() reads; with `stepped` time
 * stands until the test runs page.clock. Returns the page, every request that it made and everything that went
 * wrong in it: errors and warnings on the console, exceptions, requests that failed.
 */
export async function openPage(browser, file, { width = 1280, height = 900, scheme = "light", paints = false, stepped = false, withoutWebGl = false, ...context } = {}) {
  // Less motion, so that a replay stands at its start until a test moves it.
  const opened = await browser.newContext({ viewport: { width, height }, colorScheme: scheme, reducedMotion: "reduce", ...context });
  opened.setDefaultTimeout(HANG_MS);
  if (!paints) await opened.addInitScript(paintWhenAsked);
  if (withoutWebGl) await opened.addInitScript(hideWebGl);
  if (stepped) {
    await opened.clock.install({ time: 0 });
    await opened.clock.pauseAt(1000);
  }
  const page = await opened.newPage();
  const requests = [];
  const problems = [];
  page.on("request", (request) => requests.push(request.url()));
  page.on("requestfailed", (request) => problems.push(`request failed: ${request.url()}`));
  page.on("pageerror", (error) => problems.push(`exception: ${error.message}`));
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type()) && !isNoise(message.text())) problems.push(message.text());
  });
  await page.goto(pathToFileURL(file).href);
  return { page, requests, problems, url: pathToFileURL(file).href };
}

// What the driver of software rendering says of its own speed when a test reads pixels.
const isNoise = (text) => /GL Driver Message.*(ReadPixels|GPU stall)/.test(text);
