// Where drives went: true paths and ends, by outcome, from above.

import { type Child, el } from "../../shared/dom";
import { counted, number, words } from "../../shared/format";
import { numberCells, numeric, rowHeader, table } from "../../shared/table";
import { chartFigure } from "../charts/figure";
import { boxOf, drawPlan, type PlanLayer } from "../charts/plan";
import type { Context } from "../context";
import type { Run } from "../payload";
import { partOfTrials } from "../prefix";
import { outcomeSwatch } from "../series";
import { layersOf, outcomeOf } from "../tracks";
import type { Section } from "./section";

const MOST_HEIGHT = 460;
const MOST_MAPS = 6;

const hasMap = (run: Run) => run.course && (run.sweep === null || run.sweep === undefined) && layersOf(run).length > 0;

function caption(run: Run): string {
  const tracks = (run.tracks ?? []).length;
  const first = run.first_tracks ?? 0;
  const ends = `A mark is where a drive truly ended, of ${counted((run.trials?.trial ?? []).length, "trial")}.`;
  const course = "The cross is the start, the circle what counts as the goal" +
    (run.course!.mirror_lines_m.length > 0 ? ", a dashed line where operators set the rover back: a path goes on there at another place." : ".");
  const ground = run.course!.contours.length > 0
    ? ` Thin lines are heights of the ground, ${number(run.course!.contour_interval_m)} m apart, every fifth bolder.` : "";
  const part = `${ground.trim()} ${partOfTrials([run], "Drawn are")}`.trim();
  if (tracks === 0) return `${ends} ${course} No paths were driven for this page (--tracks). ${part}`;
  const others = tracks > first ? `, and of ${counted(tracks - first, "other")} with a replay` : "";
  return `${ends} Lines are true paths: of ${number(first)} of the first trials, whatever became of them${others}, to 2 cm. ${course} ${part}`;
}

function trackCounts(run: Run): Map<string, number> {
  const counts = new Map<string, number>();
  for (const { trial } of run.tracks ?? []) {
    const outcome = outcomeOf(run, trial);
    counts.set(outcome, (counts.get(outcome) ?? 0) + 1);
  }
  return counts;
}

function numbers(run: Run, layers: PlanLayer[]): HTMLElement {
  const tracks = trackCounts(run);
  return table({
    caption: `What the map of ${run.label} shows`,
    head: ["Outcome", numeric("Ends"), numeric("Paths")],
    rows: layers.map(({ outcome, ends }) => [
      rowHeader(words(outcome)),
      ...numberCells(ends.length, tracks.get(outcome) ?? 0),
    ]),
  });
}

/** The key, whose boxes hide an outcome. */
function key(layers: PlanLayer[], hidden: Set<string>, changed: () => void): HTMLElement {
  const boxes = layers.map(({ outcome, ends }) => {
    const box = el("input", { type: "checkbox", checked: true });
    box.addEventListener("change", () => {
      if (box.checked) hidden.delete(outcome);
      else hidden.add(outcome);
      changed();
    });
    return el("label", {}, box, outcomeSwatch(outcome), `${words(outcome)} (${number(ends.length)})`);
  });
  return el("fieldset", { class: "map-key" }, el("legend", { class: "visually-hidden" }, "Outcomes on the map"), ...boxes);
}

function map(run: Run, at: number, titled: boolean): HTMLElement {
  const layers = layersOf(run);
  const hidden = new Set<string>();
  const box = boxOf(run.course!, layers.flatMap(({ ends, lines }) => [ends, ...lines]).flat());
  const hide = (drawing: Element) => {
    for (const layer of drawing.querySelectorAll<SVGElement>("g[data-outcome]")) {
      layer.style.display = hidden.has(layer.dataset.outcome!) ? "none" : "";
    }
    return drawing;
  };
  const figure: HTMLElement = chartFigure({
    id: `map-${at}`,
    title: titled ? run.label : "From above",
    caption: caption(run),
    alternative: `Map of true paths and ends: ${layers.map(({ outcome, ends }) => `${number(ends.length)} ${words(outcome)}`).join(", ")}`,
    key: key(layers, hidden, () => figure.querySelectorAll(".chart").forEach(hide)),
    draw: (width) => hide(drawPlan({ course: run.course!, layers, box, axes: true }, width, MOST_HEIGHT)),
    numbers: () => [numbers(run, layers)],
  });
  return figure;
}

export const trackMap: Section = {
  id: "map",
  title: "Where they drove",
  short: "Map",
  render: (context: Context): Child[] | null => {
    const runs = context.runs.filter(hasMap);
    if (runs.length === 0) return null;
    const maps = runs.slice(0, MOST_MAPS).map((run, at) => map(run, at, runs.length > 1));
    return [el("div", { class: runs.length > 1 ? "chart-grid" : "one-map" }, ...maps)];
  },
};
