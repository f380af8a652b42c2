// The page of a benchmark: the standings, what tells entries apart, where and how they fail, what to replay.

import { chartFigure } from "../report/charts/figure";
import "../report/charts.css";
import "../report/report.css";
import { breakable, type Child, el } from "../shared/dom";
import { readPayload } from "../shared/payload";
import "../shared/theme.css";
import { themeSwitch } from "../shared/theme";
import "./bench.css";
import type { BenchPayload } from "./payload";
import { differences } from "./sections/differences";
import { ends } from "./sections/ends";
import { entries } from "./sections/entries";
import { heat } from "./sections/heat";
import { regret } from "./sections/regret";
import { replays } from "./sections/replays";
import { standings } from "./sections/standings";

interface Part { id: string; title: string; content: Child[] | null }

function header(data: BenchPayload): HTMLElement {
  const facts: [string, Child][] = [
    ["Suite", data.suite], ["Layouts of each cell", String(data.layouts)], ["Cells", String(data.entries[0]!.cells.length)],
    ["Seed", data.beacon ? `${data.seed}, of the beacon's ${data.beacon}` : `${data.seed}, of the suite: for development`],
    ["Baseline", data.baseline], ["Page by", breakable(data.build)],
  ];
  return el("header", {},
    el("div", { class: "title-row" }, el("h1", {}, data.title), themeSwitch()),
    el("dl", { class: "facts" }, ...facts.map(([name, value]) => el("div", {}, el("dt", {}, name), el("dd", {}, value)))));
}

function build(page: HTMLElement, data: BenchPayload): void {
  if (!Array.isArray(data?.entries)) throw new Error("The data of this page is not that of a benchmark.");
  const parts: Part[] = [
    { id: "standings", title: "Standings", content: standings(data) },
    { id: "differences", title: "Who is told from whom", content: data.entries.length > 1 ? [chartFigure(differences(data))] : null },
    { id: "where", title: "Where each arrives", content: heat(data) },
    { id: "ways", title: "How good ways are", content: regret(data) },
    { id: "ends", title: "How drives end", content: ends(data) },
    { id: "replays", title: "Drives side by side", content: replays(data) },
    { id: "entries", title: "Entries", content: entries(data) },
  ];
  const shown = parts.filter(({ content }) => content !== null);
  page.replaceChildren(
    el("a", { class: "skip-link", href: "#content" }, "Skip to the content"),
    header(data),
    el("nav", { class: "contents", "aria-label": "Contents" },
      el("ul", {}, ...shown.map(({ id, title }) => el("li", {}, el("a", { href: `#${id}` }, title))))),
    el("div", { id: "content", tabindex: -1 }, ...shown.map(({ id, title, content }) =>
      el("section", { id, "aria-labelledby": `${id}-title` },
        el("h2", { id: `${id}-title` }, title), el("div", { class: "section-body" }, ...content!)))));
}

async function main(): Promise<void> {
  const page = document.getElementById("page")!;
  page.className = "report bench";
  try {
    build(page, await readPayload<BenchPayload>());
  } catch (error) {
    page.replaceChildren(el("div", { class: "problem", role: "alert" },
      el("h1", {}, "This page cannot be shown"),
      el("p", {}, "Its data is damaged or was not written to its end. Write it again with rockyard bench report."),
      el("p", {}, el("code", {}, error instanceof Error ? error.message : String(error)))));
  }
  document.documentElement.dataset.ready = String(Math.round(performance.now()));
}

void main();
