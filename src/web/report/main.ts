// The report page: the data of the page, section by section.

import { el } from "../shared/dom";
import { readPayload } from "../shared/payload";
import "../shared/theme.css";
import "./answer.css";
import "./charts.css";
import { Context, withParameters } from "./context";
import type { ReportPayload } from "./payload";
import "./report.css";
import { abundance } from "./sections/abundance";
import { answer } from "./sections/answer";
import { changes } from "./sections/changes";
import { comparison } from "./sections/comparison";
import { distance } from "./sections/distance";
import { deadReckoning, ownCounts, timeAndEnergy } from "./sections/distributions";
import { examples } from "./sections/examples";
import { about, pageHeader } from "./sections/header";
import { headline } from "./sections/headline";
import { trackMap } from "./sections/map";
import { measurements } from "./sections/measurements";
import { outcomes } from "./sections/outcomes";
import { ownCurves } from "./sections/own_curves";
import { parameters } from "./sections/parameters";
import { provenance } from "./sections/provenance";
import { published } from "./sections/published";
import { runPicker } from "./sections/runs";
import { sectionElement } from "./sections/section";
import { trials } from "./sections/trials";
import "./trial_table.css";

// The answer first, then what there is to see, then the statistics.
const SECTIONS = [
  answer, changes, abundance, ownCurves, trackMap, outcomes, examples, about, headline, published, comparison, measurements, distance, deadReckoning,
  timeAndEnergy, ownCounts, trials, parameters, provenance,
];
// The choice of runs stands before the first section that follows it.
const FIRST_TO_FOLLOW = distance.id;

function contents(sections: HTMLElement[]): HTMLElement {
  const items = SECTIONS.filter(({ id }) => sections.some((section) => section.id === id)).map(({ id, title, short = title }) =>
    el("li", {}, el("a", { href: `#${id}` }, short)));
  return el("nav", { class: "contents", "aria-label": "Contents" }, el("ul", {}, ...items));
}

function build(page: HTMLElement, payload: ReportPayload): void {
  if (typeof payload !== "object" || payload === null || !Array.isArray(payload.runs)) {
    throw new Error("The data of this page is not that of a report.");
  }
  const context = new Context(payload);
  const sections = SECTIONS.map((section) => sectionElement(section, context)).filter((section) => section !== null);
  const picker = runPicker(context);
  const body = sections.flatMap((section) => (section.id === FIRST_TO_FOLLOW && picker ? [picker, section] : [section]));
  page.replaceChildren(
    el("a", { class: "skip-link", href: "#content" }, "Skip to the content"),
    pageHeader(context),
    contents(sections),
    el("div", { id: "content", tabindex: -1 }, ...body),
  );
}

function showProblem(page: HTMLElement, error: unknown): void {
  const reason = error instanceof Error ? error.message : String(error);
  page.replaceChildren(
    el("div", { class: "problem", role: "alert" },
      el("h1", {}, "This report cannot be shown"),
      el("p", {}, "Its data is damaged or was not written to its end. Write it again with rockyard report."),
      el("p", {}, el("code", {}, reason))),
  );
}

async function main(): Promise<void> {
  const page = document.getElementById("page")!;
  page.className = "report";
  try {
    build(page, withParameters(await readPayload<ReportPayload>()));
    // The place that the address names was not there while the page was read.
    if (location.hash.length > 1) document.getElementById(location.hash.slice(1))?.scrollIntoView();
  } catch (error) {
    showProblem(page, error);
  }
  document.documentElement.dataset.ready = String(Math.round(performance.now()));
}

void main();
