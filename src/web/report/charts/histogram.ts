// Histograms of one column, a row for each run, with the published values as marks.

import * as Plot from "@observablehq/plot";

import { isNumber, number } from "../../shared/format";
import { numeric, rowHeader, table } from "../../shared/table";
import type { ShownRun } from "../context";
import { ratedRows } from "../prefix";
import { seriesStyle } from "../series";
import { niceStep, type Mark } from "./axis";

export interface Sample {
  shown: ShownRun;
  values: number[];
}

export interface Bins {
  edges: number[];
  /** One row of counts per sample. */
  counts: number[][];
}

/** The finite values of a column times `factor`, of the trials that are in the rates; null where there are none. */
export function sampleOf(shown: ShownRun, name: string, factor: number): Sample | null {
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
export function bin(samples: Sample[]): Bins {
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

interface Bar {
  from: number;
  to: number;
  share: number;
  row: number;
  colour: string;
}

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

export function drawHistograms(samples: Sample[], marks: Mark[], label: string, width: number): Element {
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
    width,
    height: top + 40 + Math.max(ROW_HEIGHT * samples.length, 150),
    marginTop: top,
    marginLeft: 44,
    marginRight: 16,
    marginBottom: 40,
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

export function binTable(samples: Sample[], label: string): HTMLElement {
  const bins = bin(samples);
  return table({
    caption: `Trials in each bin of ${label}`,
    captionShown: true,
    head: ["from", "to", ...samples.map((each) => each.shown.run.label)].map((content) => ({ content, numeric: true })),
    rows: bins.edges.slice(0, -1).map((edge, i) => [
      numeric(number(edge), edge),
      numeric(number(bins.edges[i + 1]), bins.edges[i + 1]),
      ...bins.counts.map((row) => numeric(number(row[i]), row[i])),
    ]),
  });
}

const STATISTICS = ["count", "min", "p05", "median", "mean", "mode", "p95", "max", "std"] as const;

const STATISTIC_WORDS: Record<string, string> = { mode: "half-sample mode (no coverage claimed)", p05: "5 %", p95: "95 %", std: "standard deviation", count: "trials" };

/** A column of summary.json, exactly as it stands there. */
export function summaryTable(rows: { label: string; summary: Record<string, number | null> }[], what: string): HTMLElement {
  return table({
    caption: `${what}: from summary.json`,
    captionShown: true,
    head: ["run", ...STATISTICS.map((name) => ({ content: STATISTIC_WORDS[name] ?? name, numeric: true }))],
    rows: rows.map(({ label, summary }) => [
      rowHeader(label),
      ...STATISTICS.map((name) => numeric(number(summary[name]), summary[name])),
    ]),
  });
}
