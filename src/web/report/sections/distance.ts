// How far the rover drove, and by which distance it had arrived.

import * as Plot from "@observablehq/plot";

import { el } from "../../shared/dom";
import { counted, isNumber, number, percent } from "../../shared/format";
import { numberCells, numericHeads, table } from "../../shared/table";
import { type Mark, niceStep, publishedMarks } from "../charts/axis";
import { chartFigure } from "../charts/figure";
import type { Context, ShownRun } from "../context";
import type { PublishedRow, Run } from "../payload";
import { legend, seriesStyle } from "../series";
import { SHARED_LAYOUTS } from "../words";
import type { Section } from "./section";

function isDistance(row: PublishedRow): boolean { return /(^|\.)distance\.(min|mode|mean|median|max)$/.test(row.id); }

/** The published distances of the runs that are shown; the same value once. */
function distanceMarks(runs: Run[]): Mark[] { return publishedMarks(runs, isDistance); }

const key = (all: Steps[]) => legend(all.map(({ shown }) => ({ slot: shown.slot, label: shown.run.label })));

function endsOf(all: Steps[], what: string): string {
  return all
    .map(({ shown, points }) => {
      const last = points[points.length - 1]!;
      return `${shown.run.label}: ${what} reaches ${number(100 * last.y, 3)} % at ${number(last.x, 3)} m`;
    })
    .join("; ");
}

/** Drives whose navigator ended the process that ran them: nobody knows how far they came. */
function withoutDistance(run: Run): string {
  const drives = run.summary?.declared_success?.trials;
  const known = run.cdf?.["at_risk"]?.[0];
  if (!isNumber(drives) || !isNumber(known) || drives <= known) return "";
  return ` Of ${counted(drives - known, "drive")} of ${run.label} no distance is known, since the navigator ended the process that ran ${drives - known === 1 ? "it" : "them"}.`;
}

/** What holds of the curves of some runs only. */
function remarks(all: Steps[]): string {
  const runs = all.map(({ shown }) => shown.run);
  const thinned = runs.filter((run) => run.cdf_steps > (run.cdf?.["distance_m"]?.length ?? 0));
  const drawn = thinned.map((run) => `${number(run.cdf!["distance_m"]!.length)} of ${number(run.cdf_steps)} steps`);
  return (
    (thinned.length > 0 ? ` Drawn are ${drawn.join("; ")}, the curve nowhere lower by more than 1/998 of the trials; distance_cdf.csv has all.` : "") +
    (runs.some((run) => run.shared_layouts) ? ` ${SHARED_LAYOUTS}` : "") +
    runs.map(withoutDistance).join("")
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

// ---- Distribution functions as steps with their bands, several runs over each other.

export interface Steps {
  shown: ShownRun;
  /** Upper end of the band before the first step; null where there is no band there. */
  startHigh: number | null;
  /** The curve goes on beyond its last step, because nothing is left to come. */
  complete: boolean;
  /** Sorted by x; a step goes up at x. Without a band where it would have no width: that is no knowledge, as before the first arrival. */
  points: Step[];
  /** Trials that still drove when they came to x: as many numbers as points. */
  atRisk: number[];
  /** The curve if every drive that a limit ended so far had had the event then; empty where that is none. */
  ceiling: { x: number; y: number }[];
}

export interface Step { x: number; y: number; low: number | null; high: number | null }

/** Columns of distance_cdf.csv as steps: `name`, `name`_low and _high. Rows with a missing number are left out. */
function stepsOf(shown: ShownRun, name: "ecdf" | "goal"): Steps | null {
  const cdf = shown.run.cdf;
  const x = cdf?.["distance_m"];
  const columns = [cdf?.[name], cdf?.[`${name}_low`], cdf?.[`${name}_high`]];
  if (!x || columns.some((column) => !column)) return null;
  const points: Step[] = [];
  const atRisk: number[] = [];
  const ceiling: { x: number; y: number }[] = [];
  const shares = name === "goal" ? cdf?.["limit"] : undefined;
  const limits = shares?.some((share) => isNumber(share) && share > 0) ? shares : undefined;
  x.forEach((value, i) => {
    const [at, lower, upper] = columns.map((column) => column![i]);
    if (!isNumber(value) || !isNumber(at) || !isNumber(lower) || !isNumber(upper)) return;
    const banded = upper > lower;
    points.push({ x: value, y: at, low: banded ? lower : null, high: banded ? upper : null });
    atRisk.push(cdf?.["at_risk"]?.[i] ?? NaN);
    if (limits) ceiling.push({ x: value, y: at + (limits[i] ?? 0) });
  });
  const first = points[0];
  if (!first) return null;
  // The band of the distribution function has one width everywhere.
  const startHigh = name === "ecdf" ? Math.max(0, first.high! - first.y) : null;
  return { shown, points, startHigh, complete: name === "ecdf", atRisk, ceiling };
}

/** How many trials still drove at x; null where that is not known. */
function atRiskAt({ points, atRisk }: Steps, x: number): number | null {
  const next = points.findIndex((point) => point.x >= x);
  const count = next < 0 ? 0 : atRisk[next];
  return isNumber(count) ? count : null;
}

// A distribution function is 0 before its first step.
function extended({ points, startHigh, complete }: Steps, from: number, to: number): Step[] {
  const last = points[points.length - 1]!;
  const start = { x: from, y: 0, low: startHigh === null ? null : 0, high: startHigh };
  return [start, ...points, ...(complete ? [{ ...last, x: to }] : [])];
}

function extent(all: Steps[], marks: Mark[]): [number, number] {
  const xs = all.flatMap(({ points }) => [points[0]!.x, points[points.length - 1]!.x]);
  xs.push(...marks.map((mark) => mark.x));
  const low = Math.min(...xs);
  const high = Math.max(...xs);
  const margin = 0.03 * (high - low || 1);
  return [low - margin, high + margin];
}

function seriesMarks(steps: Steps, domain: [number, number], opacity: number): Plot.Markish[] {
  const style = seriesStyle(steps.shown.slot);
  const points = extended(steps, ...domain);
  return [
    Plot.areaY(points.filter((point) => point.high !== null), { x: "x", y1: "low", y2: "high", curve: "step-after", fill: style.colour, fillOpacity: opacity }),
    Plot.lineY(points, {
      x: "x", y: "y", curve: "step-after", stroke: style.colour, strokeWidth: 2, strokeDasharray: style.dash,
      tip: { format: { x: (x: number) => `${number(x)} m`, y: (y: number) => percent(y), stroke: false } },
    }),
    Plot.lineY(steps.ceiling, { x: "x", y: "y", curve: "step-after", stroke: style.colour, strokeWidth: 1.5, strokeDasharray: "2 3" }),
  ];
}

// Labels go up the right side of their line, one below the other, so that near ones stay apart.
function markLines(marks: Mark[], domain: [number, number]): Plot.Markish[] {
  const sorted = [...marks].sort((a, b) => a.x - b.x);
  const middle = (domain[0] + domain[1]) / 2;
  const texts = sorted.map((mark, i) => ({ ...mark, y: 0.06 + 0.08 * i }));
  const text = { x: "x", y: "y", text: "label", fill: "currentColor", stroke: "var(--ground)", strokeWidth: 4 } as const;
  return [
    Plot.ruleX(sorted, { x: "x", stroke: "currentColor", strokeDasharray: "3 3" }),
    Plot.text(texts.filter((each) => each.x <= middle), { ...text, dx: 6, textAnchor: "start" }),
    Plot.text(texts.filter((each) => each.x > middle), { ...text, dx: -6, textAnchor: "end" }),
  ];
}

const RISK_ROW = 16;

// A row of numbers for each run below the axis, at its ticks.
function riskMarks(all: Steps[], ticks: number[]): Plot.Markish[] {
  return all.flatMap((steps, row) => {
    const style = seriesStyle(steps.shown.slot);
    const dy = 52 + RISK_ROW * (row + 1);
    const texts = ticks.flatMap((x) => {
      const count = atRiskAt(steps, x);
      return count === null ? [] : [{ x, text: number(count) }];
    });
    return [
      Plot.text(texts, { x: "x", text: "text", frameAnchor: "bottom", dy, fill: "currentColor" }),
      all.length > 1
        ? Plot.dot([0], { frameAnchor: "bottom-left", dx: -34, dy, symbol: style.symbol, r: 4, fill: style.symbol === "times" ? "none" : style.colour, stroke: style.colour })
        : null,
    ];
  });
}

function ticksOf([low, high]: [number, number], count: number): number[] {
  const step = niceStep((high - low) / count);
  const first = Math.ceil(low / step);
  return Array.from({ length: Math.floor(high / step) - first + 1 }, (_, i) => Number(((first + i) * step).toPrecision(12)));
}

interface StepDrawing {
  all: Steps[];
  marks: Mark[];
  yLabel: string;
  /** Numbers of trials that still drive, below the axis. */
  atRisk: boolean;
}

function drawSteps({ all, marks, yLabel, atRisk }: StepDrawing, width: number): Element {
  const domain = extent(all, marks);
  const ticks = ticksOf(domain, Math.max(4, width / 90));
  const below = atRisk ? 26 + RISK_ROW * all.length : 0;
  return Plot.plot({
    width, height: Math.min(380, Math.max(260, width * 0.55)) + below, marginLeft: 52,
    marginBottom: 42 + below,
    x: { domain, label: "true distance [m]", labelAnchor: "center", labelArrow: "none", labelOffset: 36, ticks },
    y: { domain: [0, 1], label: yLabel, grid: true, ticks: 5, percent: false, labelArrow: "none", tickFormat: (rate: number) => `${Math.round(100 * rate)} %` },
    marks: [
      Plot.ruleY([0], { stroke: "var(--line-strong)" }),
      ...all.flatMap((steps) => seriesMarks(steps, domain, all.length > 3 ? 0.07 : 0.16)),
      ...markLines(marks, domain),
      ...(atRisk ? [Plot.text(["still driving"], { frameAnchor: "bottom-left", textAnchor: "start", dx: -46, dy: 52, fill: "currentColor", fontWeight: 600 }), ...riskMarks(all, ticks)] : []),
    ],
  });
}

function stepTable(steps: Steps, what: string): HTMLElement {
  return table({
    caption: `${steps.shown.run.label}: ${what}`,
    captionShown: true,
    head: numericHeads("distance [m]", what, "band from", "band to", "still driving",
      ...(steps.ceiling.length > 0 ? ["with those that a limit ended"] : [])),
    rows: steps.points.map((point, i) =>
      numberCells(point.x, point.y, point.low, point.high, steps.atRisk[i], ...(steps.ceiling.length > 0 ? [steps.ceiling[i]!.y] : []))),
  });
}
