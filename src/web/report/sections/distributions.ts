// Columns of the trials as distributions: errors of dead reckoning, time and energy, what navigators count.

import * as Plot from "@observablehq/plot";

import { el } from "../../shared/dom";
import { counted, isNumber, number } from "../../shared/format";
import { numberCells, numericHeads, rowHeader, table } from "../../shared/table";
import { type Mark, niceStep, publishedMarks } from "../charts/axis";
import { chartFigure } from "../charts/figure";
import type { Context, ShownRun } from "../context";
import type { Column, PublishedRow } from "../payload";
import { partOfTrials, ratedRows } from "../prefix";
import { seriesStyle } from "../series";
import { columnLabel, columnWords, isOwnColumn, unitText } from "../words";
import type { Section } from "./section";

interface Distribution {
  column: string; title: string; what: string;
  /** Beginning of the ids of published values, after the scenario's name. */
  published?: string;
  /** Drawn in a unit of its own: thousandths are hard to read. */
  drawn?: { factor: number; unit: string };
  /** The parameter that ends a trial at a value of this column, and what it is called. */
  limit?: { path: string; label: string; where: string };
  summary: (summary: Record<string, any>) => Record<string, number | null> | undefined;
}

const ERRORS: Distribution[] = [
  {
    column: "distance_error_percent", title: "Distance error", published: "distance_error",
    what: "dead-reckoned less true path length, in per cent of the true one; below zero the rover believed to have driven less than it had",
    summary: (summary) => summary.dead_reckoning?.distance_error_percent,
  },
  {
    column: "heading_error_deg", title: "Heading error", published: "heading_error",
    what: "size of the difference between believed and true heading at the end",
    summary: (summary) => summary.dead_reckoning?.heading_error_deg,
  },
  {
    column: "position_error_m", title: "Position error", published: "position_error",
    what: "distance between believed and true position at the end",
    summary: (summary) => summary.dead_reckoning?.position_error_m,
  },
];

const COSTS: Distribution[] = [
  {
    column: "sim_time_s", title: "Time", what: "simulated time of the whole trial", limit: { path: "referee.time_limit_s", label: "time limit", where: "the time limit is" },
    summary: (summary) => summary.sim_time_s,
  },
  {
    column: "energy_wh", title: "Energy", what: "taken from the batteries in the whole trial", limit: { path: "energy.battery_wh", label: "batteries empty", where: "the batteries are empty" },
    summary: (summary) => summary.energy_wh,
  },
  {
    column: "net_rate_m_s", title: "Net rate", what: "distance gained towards the goal over the time of the trial",
    drawn: { factor: 1000, unit: "mm/s" },
    summary: (summary) => summary.columns?.net_rate_m_s,
  },
];

const MOST_OWN = 12;

/** What the navigators of the shown runs count for themselves. */
function ownValues(context: Context): Distribution[] {
  const columns = new Map<string, Column>();
  for (const { run } of context.drives()) {
    for (const column of run.trials?.columns ?? []) {
      if (isOwnColumn(column.name) && column.values.some(isNumber) && !columns.has(column.name)) columns.set(column.name, column);
    }
  }
  return [...columns.values()].slice(0, MOST_OWN).map(({ name, meaning }) => ({
    column: name,
    title: columnWords(name),
    what: (meaning ?? "").replace(/\.$/, "") || "as the navigator counts it",
    summary: (summary) => summary.columns?.[name],
  }));
}

function unitOf(shown: ShownRun, name: string): string {
  return shown.run.trials.columns.find((each) => each.name === name)?.unit ?? "";
}

function alternative(samples: Sample[], of: Distribution, unit: string): string {
  const parts = samples.map(({ shown }) => {
    const summary = of.summary(shown.run.summary ?? {});
    return `${shown.run.label}: median ${number(summary?.median)} ${unitText(unit)}, 90 % of trials from ${number(summary?.p05)} to ${number(summary?.p95)}`;
  });
  return `Histogram of the ${columnWords(of.column)}. ${parts.join("; ")}.`;
}

function isOf(row: PublishedRow, prefix: string | undefined): boolean {
  if (prefix === undefined) return false;
  return ["min", "mode", "mean", "max"].some((end) => row.id.endsWith(`.${prefix}.${end}`) || row.id === `${prefix}.${end}`);
}

// Of six digits, as the values are.
const NEARLY = 1 - 1e-5;

interface Reached {
  mark: Mark;
  /** How many trials of which run, in words. */
  text: string;
}

/** Limits that some trials came to: those make a spike, or a hump of their own beyond. */
function limitsReached(samples: Sample[], of: Distribution): Reached[] {
  return samples.flatMap(({ shown, values }) => {
    const limit = Number(shown.run.parameters?.find((each) => each.path === of.limit?.path)?.value);
    const count = values.filter((value) => value >= NEARLY * limit).length;
    if (!of.limit || !(limit > 0) || count === 0) return [];
    const label = `${of.limit.label} ${number(limit)}`;
    const run = samples.length > 1 ? `of ${shown.run.label} ` : "";
    return [{ mark: { x: limit, label }, text: `${number(count)} of ${counted(values.length, "trial")} ${run}lie at or beyond it` }];
  });
}

function figure(context: Context, of: Distribution): HTMLElement | null {
  const samples = context.drives().map((shown) => sampleOf(shown, of.column, of.drawn?.factor ?? 1)).filter((each): each is Sample => each !== null);
  const first = samples[0];
  if (!first) return null;
  const unit = unitOf(first.shown, of.column);
  const drawnUnit = of.drawn?.unit ?? unit;
  const reached = limitsReached(samples, of);
  const marks = [
    ...publishedMarks(samples.map((each) => each.shown.run), (row) => isOf(row, of.published), ""),
    ...new Map(reached.map(({ mark }) => [mark.label, mark])).values(),
  ];
  const limits = reached.length > 0 ? ` The dashed upright is where ${of.limit!.where}: ${reached.map(({ text }) => text).join(", ")}.` : "";
  return chartFigure({
    id: `histogram-${of.column.replace(".", "-")}`,
    title: of.title,
    caption: `Share of trials by ${columnWords(of.column)}: ${of.what}.${limits}`,
    alternative: alternative(samples, of, unit),
    draw: (width) => drawHistograms(samples, marks, columnLabel(of.column, drawnUnit), width),
    numbers: () => {
      const rows = samples.flatMap(({ shown }) => {
        const summary = of.summary(shown.run.summary ?? {});
        return summary ? [{ label: shown.run.label, summary }] : [];
      });
      return [summaryTable(rows, columnLabel(of.column, unit)), binTable(samples, columnLabel(of.column, drawnUnit))];
    },
  });
}

const HOW_TO_READ =
  "Bars are shares of a run's trials, faults left out. Below them the dot is the median, and the line holds 90 % of the trials.";
const PUBLISHED = " Dashed uprights are the published minimum, mode and maximum, where there are any.";

function section(id: string, title: string, short: string, distributions: (context: Context) => Distribution[]): Section {
  return {
    id,
    title,
    short,
    follows: true,
    render: (context) => {
      const figures = distributions(context).map((each) => figure(context, each));
      if (figures.every((each) => each === null)) return null;
      const part = partOfTrials(context.drives().map(({ run }) => run), " Bars are of");
      return [el("p", { class: "note" }, HOW_TO_READ + (id === "dead-reckoning" ? PUBLISHED : "") + part), el("div", { class: "chart-grid three" }, ...figures)];
    },
  };
}

export const deadReckoning = section("dead-reckoning", "Errors of dead reckoning", "Dead reckoning", () => ERRORS);
export const timeAndEnergy = section("time-energy", "Time and energy", "Time and energy", () => COSTS);
export const ownCounts = section("own-values", "What the navigator counts", "Counts", ownValues);

// ---- Histograms of one column, a row for each run, with the published values as marks.

export interface Sample { shown: ShownRun; values: number[] }

interface Bins {
  edges: number[];
  /** One row of counts per sample. */
  counts: number[][];
}

/** The finite values of a column times `factor`, of the trials that are in the rates; null where there are none. */
function sampleOf(shown: ShownRun, name: string, factor: number): Sample | null {
  const column = shown.run.trials?.columns?.find((each) => each.name === name);
  const fault = (shown.run.trials?.outcome_names ?? []).indexOf("simulator_fault");
  const values = (column?.values ?? []).slice(0, ratedRows(shown.run)).filter(
    (value, i): value is number => isNumber(value) && shown.run.trials.outcome[i] !== fault,
  );
  return values.length > 0 ? { shown, values: values.map((value) => factor * value) } : null;
}

function range(samples: Sample[]): [number, number] {
  let low = Infinity;
  let high = -Infinity;
  for (const { values } of samples) {
    for (const value of values) {
      low = Math.min(low, value);
      high = Math.max(high, value);
    }
  }
  return [low, high];
}

const MOST_BINS = 80;

// The width of bins by Freedman and Diaconis (1981) in the sample where it is narrowest: a few values
// far off do not make it coarse.
function binWidth(samples: Sample[], width: number): number {
  const widths = samples.map(({ values }) => {
    const sorted = [...values].sort((a, b) => a - b);
    return (2 * (quantile(sorted, 0.75) - quantile(sorted, 0.25))) / Math.cbrt(values.length);
  });
  const least = Math.min(...widths.filter((each) => each > 0), width / 8);
  return niceStep(Math.max(least, width / MOST_BINS));
}

// The bin that holds the value, from a guess that rounding may have put one off.
function binOf(value: number, edges: number[], guess: number): number {
  const last = edges.length - 2;
  let at = Math.min(last, Math.max(0, guess));
  if (at < last && value >= edges[at + 1]!) ++at;
  if (at > 0 && value < edges[at]!) --at;
  return at;
}

/** Common bins of equal width for all samples. */
function bin(samples: Sample[]): Bins {
  const [low, high] = range(samples);
  const width = high > low ? high - low : Math.abs(low) || 1;
  const step = binWidth(samples, width);
  const first = Math.floor(low / step);
  const count = Math.max(1, Math.floor(high / step) - first + 1);
  // Rounded, so that an edge reads 0.3 and not 0.30000000000000004.
  const edges = Array.from({ length: count + 1 }, (_, i) => Number(((first + i) * step).toPrecision(12)));
  const counts = samples.map(({ values }) => {
    const row = new Array<number>(count).fill(0);
    for (const value of values) row[binOf(value, edges, Math.floor(value / step) - first)]! += 1;
    return row;
  });
  return { edges, counts };
}

function quantile(sorted: number[], p: number): number {
  const at = p * (sorted.length - 1);
  const low = Math.floor(at);
  const next = sorted[Math.min(low + 1, sorted.length - 1)]!;
  return sorted[low]! + (at - low) * (next - sorted[low]!);
}

interface Bar { from: number; to: number; share: number; row: number; colour: string }

function barsOf(samples: Sample[], bins: Bins): Bar[] {
  return samples.flatMap((sample, row) =>
    bins.counts[row]!.flatMap((count, i) =>
      count === 0
        ? []
        : [{
            from: bins.edges[i]!,
            to: bins.edges[i + 1]!,
            share: count / sample.values.length,
            row,
            colour: seriesStyle(sample.shown.slot).colour,
          }],
    ),
  );
}

const ROW_HEIGHT = 96;
const LABEL_STEP = 14;
const LETTER = 7.2;
const MARK_ROWS = 3;

// Rows of labels above the drawing: a label that would meet its left neighbour goes one row up.
// One at an edge is written inwards.
function labelRows(marks: Mark[], domain: [number, number], width: number): { mark: Mark; row: number; anchor: "start" | "middle" | "end" }[] {
  const ends: number[] = [];
  return [...marks].sort((a, b) => a.x - b.x).map((mark) => {
    const length = LETTER * mark.label.length;
    const at = ((mark.x - domain[0]) / (domain[1] - domain[0])) * width;
    const anchor = at < length / 2 ? "start" : at > width - length / 2 ? "end" : "middle";
    const from = anchor === "start" ? at : anchor === "end" ? at - length : at - length / 2;
    let row = ends.findIndex((end) => end < from);
    if (row < 0) row = ends.length;
    ends[row] = from + length + LETTER;
    return { mark, row, anchor };
  });
}

function drawHistograms(samples: Sample[], marks: Mark[], label: string, width: number): Element {
  const bins = bin(samples);
  const domain: [number, number] = [
    Math.min(bins.edges[0]!, ...marks.map((mark) => mark.x)),
    Math.max(bins.edges[bins.edges.length - 1]!, ...marks.map((mark) => mark.x)),
  ];
  const margin = 0.03 * (domain[1] - domain[0]);
  domain[0] -= margin;
  domain[1] += margin;
  const labels = labelRows(marks, domain, width - 60);
  // The same for all charts with marks, so that charts side by side stand on one line.
  const top = 12 + (marks.length === 0 ? 0 : LABEL_STEP * Math.max(MARK_ROWS, ...labels.map((label) => label.row + 1)));
  const quantiles = samples.map(({ values }, row) => {
    const sorted = [...values].sort((a, b) => a - b);
    return { row, low: quantile(sorted, 0.05), median: quantile(sorted, 0.5), high: quantile(sorted, 0.95) };
  });
  return Plot.plot({
    width, height: top + 40 + Math.max(ROW_HEIGHT * samples.length, 150), marginTop: top, marginLeft: 44,
    marginRight: 16, marginBottom: 40,
    x: { domain, label, labelAnchor: "center", labelArrow: "none", ticks: Math.max(3, width / 90) },
    y: { label: null, ticks: samples.length > 2 ? 2 : 3, tickFormat: (share: number) => `${+(100 * share).toFixed(1)} %`, grid: true, insetBottom: 12, insetTop: samples.length > 1 ? 18 : 0 },
    fy: { axis: null, padding: 0.12 },
    marks: [
      Plot.rectY(barsOf(samples, bins), { x1: "from", x2: "to", y: "share", fy: "row", fill: "colour", insetLeft: 0.5, insetRight: 0.5 }),
      Plot.ruleY([0], { stroke: "var(--line-strong)" }),
      Plot.link(quantiles, { x1: "low", x2: "high", y1: 0, y2: 0, fy: "row", stroke: "currentColor", strokeWidth: 2, dy: 6 } as Plot.LinkOptions),
      Plot.dot(quantiles, { x: "median", y: 0, fy: "row", r: 4, fill: "currentColor", stroke: "var(--ground)", dy: 6 }),
      Plot.ruleX(marks, { x: "x", stroke: "currentColor", strokeDasharray: "3 3" }),
      samples.length > 1
        ? Plot.text(samples.map((sample, row) => ({ row, label: sample.shown.run.label })), {
            fy: "row", text: "label", frameAnchor: "top-right", lineAnchor: "top", fill: "currentColor", stroke: "var(--ground)",
            strokeWidth: 5, textOverflow: "ellipsis", lineWidth: Math.max(12, (width - 60) / 13),
          })
        : null,
      ...labels.map(({ mark, row, anchor }) =>
        Plot.text([mark], {
          x: "x", text: "label", frameAnchor: "top", lineAnchor: "bottom", textAnchor: anchor, dy: -4 - LABEL_STEP * row, fill: "currentColor",
          ...(samples.length > 1 ? { fy: () => 0 } : {}),
        }),
      ),
    ],
  });
}

function binTable(samples: Sample[], label: string): HTMLElement {
  const bins = bin(samples);
  return table({
    caption: `Trials in each bin of ${label}`,
    captionShown: true,
    head: numericHeads("from", "to", ...samples.map((each) => each.shown.run.label)),
    rows: bins.edges.slice(0, -1).map((edge, i) => numberCells(edge, bins.edges[i + 1], ...bins.counts.map((row) => row[i]))),
  });
}

const STATISTICS = ["count", "min", "p05", "median", "mean", "mode", "p95", "max", "std"] as const;

const STATISTIC_WORDS: Record<string, string> = { mode: "half-sample mode (no coverage claimed)", p05: "5 %", p95: "95 %", std: "standard deviation", count: "trials" };

/** A column of summary.json, exactly as it stands there. */
function summaryTable(rows: { label: string; summary: Record<string, number | null> }[], what: string): HTMLElement {
  return table({
    caption: `${what}: from summary.json`,
    captionShown: true,
    head: ["run", ...numericHeads(...STATISTICS.map((name) => STATISTIC_WORDS[name] ?? name))],
    rows: rows.map(({ label, summary }) => [rowHeader(label), ...numberCells(...STATISTICS.map((name) => summary[name]))]),
  });
}
