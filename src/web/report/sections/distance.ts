// How far the rover drove, and by which distance it had arrived.

import { el } from "../../shared/dom";
import { number } from "../../shared/format";
import type { Mark } from "../charts/axis";
import { drawSteps, stepsOf, stepTable, type Steps } from "../charts/distribution";
import { chartFigure } from "../charts/figure";
import type { Context } from "../context";
import type { PublishedRow, Run } from "../payload";
import { legend } from "../series";
import { SHARED_LAYOUTS } from "../words";
import { publishedMarks } from "./published_marks";
import type { Section } from "./section";

function isDistance(row: PublishedRow): boolean {
  return /(^|\.)distance\.(min|mode|mean|median|max)$/.test(row.id);
}

/** The published distances of the runs that are shown; the same value once. */
export function distanceMarks(runs: Run[]): Mark[] {
  return publishedMarks(runs, isDistance);
}

const key = (all: Steps[]) => legend(all.map(({ shown }) => ({ slot: shown.slot, label: shown.run.label })));

function endsOf(all: Steps[], what: string): string {
  return all
    .map(({ shown, points }) => {
      const last = points[points.length - 1]!;
      return `${shown.run.label}: ${what} reaches ${number(100 * last.y, 3)} % at ${number(last.x, 3)} m`;
    })
    .join("; ");
}

/** What holds of the curves of some runs only. */
function remarks(all: Steps[]): string {
  const runs = all.map(({ shown }) => shown.run);
  const thinned = runs.filter((run) => run.cdf_steps > (run.cdf?.["distance_m"]?.length ?? 0));
  const drawn = thinned.map((run) => `${number(run.cdf!["distance_m"]!.length)} of ${number(run.cdf_steps)} steps`);
  return (
    (thinned.length > 0 ? ` Drawn are ${drawn.join("; ")}, the curve nowhere lower by more than 1/998 of the trials; distance_cdf.csv has all.` : "") +
    (runs.some((run) => run.shared_layouts) ? ` ${SHARED_LAYOUTS}` : "")
  );
}

/** What a limit of the run leaves open. */
const ceilings = (all: Steps[]): string =>
  all.some(({ ceiling }) => ceiling.length > 0)
    ? " Dotted: the same if every drive that a limit of the run ended (patience, time) had arrived there; they had neither arrived nor failed, so that " +
      "without limits the curve would end between the two."
    : "";

function distances(all: Steps[], marks: Mark[]): HTMLElement {
  const shown = marks.length > 0
    ? " Dashed uprights are values that the published text and tables state; the published figure of this curve (figure 17) " +
      "is not available, so its points are not shown."
    : " The published figure of this curve (figure 17) is not available, so no points of it are shown.";
  return chartFigure({
    id: "distance-cdf",
    title: "Distance driven",
    caption:
      "At a distance x the curve gives the share of all trials that drove no further than x, whatever their end. The shaded band " +
      "holds the whole true curve with 95 % confidence (simultaneous)." + remarks(all) + shown,
    alternative: `Distribution function of the true distance. ${endsOf(all, "the curve")}.`,
    key: key(all),
    draw: (width) => drawSteps({ all, marks, yLabel: "share of trials", atRisk: false }, width),
    numbers: () => all.map((steps) => stepTable(steps, "share of trials")),
  });
}

function arrivals(all: Steps[]): HTMLElement {
  return chartFigure({
    id: "goal-incidence",
    title: "Declared arrivals at the goal",
    caption:
      "At a distance x the curve gives the share of trials that believed by then to be at the goal, whether or not they were. All other ends compete: who ended so " +
      "does not arrive, so the curve ends below 100 %." + ceilings(all) + " The band is a 95 % interval at each distance by itself (pointwise); where it would have no width, as before the first arrival, none is drawn. Below the axis: how many trials still drove at that distance." + remarks(all),
    alternative: `Share of trials that had arrived, by true distance. ${endsOf(all, "the share")}.`,
    key: key(all),
    draw: (width) => drawSteps({ all, marks: [], yLabel: "share that declared arrival", atRisk: true }, width),
    numbers: () => all.map((steps) => stepTable(steps, "share that declared arrival")),
  });
}

const present = (steps: Steps | null): steps is Steps => steps !== null;

export const distance: Section = {
  id: "distance",
  title: "Distance",
  short: "Distance",
  follows: true,
  render: (context: Context) => {
    const shown = context.drives();
    const all = shown.map((each) => stepsOf(each, "ecdf")).filter(present);
    const goals = shown.map((each) => stepsOf(each, "goal")).filter(present);
    if (all.length === 0) return null;
    const marks = distanceMarks(all.map((steps) => steps.shown.run));
    return [el("div", { class: "chart-grid" }, distances(all, marks), goals.length > 0 ? arrivals(goals) : null)];
  },
};
