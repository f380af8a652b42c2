// Distribution functions as steps with their bands, several runs over each other.

import * as Plot from "@observablehq/plot";

import { isNumber, number, percent } from "../../shared/format";
import { numeric, table } from "../../shared/table";
import type { ShownRun } from "../context";
import { seriesStyle } from "../series";

export interface Steps {
  shown: ShownRun;
  /** Upper end of the band before the first step. */
  startHigh: number;
  /** Sorted by x; a step goes up at x. */
  points: { x: number; y: number; low: number; high: number }[];
}

export interface Mark {
  x: number;
  label: string;
}

/** Columns of distance_cdf.csv as steps: `name`, `name`_low and _high. Rows with a missing number are left out. */
export function stepsOf(shown: ShownRun, name: "ecdf" | "goal"): Steps | null {
  const cdf = shown.run.cdf;
  const x = cdf?.["distance_m"];
  const columns = [cdf?.[name], cdf?.[`${name}_low`], cdf?.[`${name}_high`]];
  if (!x || columns.some((column) => !column)) return null;
  const points: Steps["points"] = [];
  x.forEach((value, i) => {
    const [at, lower, upper] = columns.map((column) => column![i]);
    if (isNumber(value) && isNumber(at) && isNumber(lower) && isNumber(upper)) {
      points.push({ x: value, y: at, low: lower, high: upper });
    }
  });
  const first = points[0];
  if (!first) return null;
  // The band of the distribution function has one width everywhere; the other is pointwise, and
  // where nobody has arrived yet there is none.
  return { shown, points, startHigh: name === "ecdf" ? Math.max(0, first.high - first.y) : 0 };
}

// A distribution function is 0 before its first step.
function extended({ points, startHigh }: Steps, from: number, to: number): Steps["points"] {
  const last = points[points.length - 1]!;
  return [{ x: from, y: 0, low: 0, high: startHigh }, ...points, { ...last, x: to }];
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
    Plot.areaY(points, { x: "x", y1: "low", y2: "high", curve: "step-after", fill: style.colour, fillOpacity: opacity }),
    Plot.lineY(points, {
      x: "x", y: "y", curve: "step-after", stroke: style.colour, strokeWidth: 2, strokeDasharray: style.dash,
      tip: { format: { x: (x: number) => `${number(x)} m`, y: (y: number) => percent(y), stroke: false } },
    }),
  ];
}

// Labels go up the right side of their line, one below the other, so that near ones stay apart.
function publishedMarks(marks: Mark[], domain: [number, number]): Plot.Markish[] {
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

export function drawSteps(all: Steps[], marks: Mark[], yLabel: string, width: number): Element {
  const domain = extent(all, marks);
  return Plot.plot({
    width,
    height: Math.min(380, Math.max(260, width * 0.55)),
    marginLeft: 52,
    marginBottom: 42,
    x: { domain, label: "true distance [m]", labelAnchor: "center", labelArrow: "none", ticks: Math.max(4, width / 90) },
    y: { domain: [0, 1], label: yLabel, grid: true, ticks: 5, percent: false, labelArrow: "none", tickFormat: (rate: number) => `${Math.round(100 * rate)} %` },
    marks: [
      Plot.ruleY([0], { stroke: "var(--line-strong)" }),
      ...all.flatMap((steps) => seriesMarks(steps, domain, all.length > 3 ? 0.07 : 0.16)),
      ...publishedMarks(marks, domain),
    ],
  });
}

export function stepTable(steps: Steps, what: string): HTMLElement {
  return table({
    caption: `${steps.shown.run.label}: ${what}`,
    captionShown: true,
    head: ["distance [m]", what, "band from", "band to"].map((content) => ({ content, numeric: true })),
    rows: steps.points.map((point) =>
      [point.x, point.y, point.low, point.high].map((value) => numeric(number(value), value)),
    ),
  });
}
