// Differences with their intervals, one below the other.

import * as Plot from "@observablehq/plot";

import { number } from "../../shared/format";
import { numeric, rowHeader, table } from "../../shared/table";

export interface Difference {
  label: string;
  difference: number;
  low: number;
  high: number;
}

const LETTER = 7;
// One wide interval must not press all others into a line: what goes further is cut and gets an arrow.
const MOST_OF_MEDIAN = 6;

function reach(rows: Difference[], most: number): number {
  const ends = rows.map((row) => Math.max(Math.abs(row.low), Math.abs(row.high))).sort((a, b) => a - b);
  const median = ends[Math.floor(ends.length / 2)] ?? 1;
  return 1.08 * (Math.min(ends[ends.length - 1] ?? 1, MOST_OF_MEDIAN * median, most) || 1);
}

interface Arrow {
  label: string;
  x: number;
  text: string;
}

function arrows(rows: Difference[], far: number): Arrow[] {
  return rows.flatMap(({ label, low, high }) => [
    ...(low < -far ? [{ label, x: -far, text: "◂" }] : []),
    ...(high > far ? [{ label, x: far, text: "▸" }] : []),
  ]);
}

// The difference itself where its mark would lie beyond the axis.
function beyond(rows: Difference[], far: number): Arrow[] {
  return rows
    .filter((row) => Math.abs(row.difference) > far)
    .map(({ label, difference }) => ({ label, x: Math.sign(difference) * far, text: number(difference, 3) }));
}

export function forestTable(rows: Difference[], unit: string): HTMLElement {
  return table({
    caption: `Differences as drawn, ${unit}`,
    head: ["", ...["difference", "from", "to"].map((content) => ({ content, numeric: true }))],
    rows: rows.map((row) => [
      rowHeader(row.label),
      ...[row.difference, row.low, row.high].map((value) => numeric(number(value), value)),
    ]),
  });
}

/** The axis ends at `most` at the latest. On a narrow page labels stand above their bars, on a wide one beside them. */
export function drawForest(rows: Difference[], xLabel: string, width: number, most = Infinity): Element {
  const longest = LETTER * Math.max(...rows.map((row) => row.label.length));
  const beside = longest < 0.42 * width;
  const far = reach(rows, most);
  const farther = beyond(rows, far);
  const value = { x: "x", y: "label", text: "text", dy: -10, fill: "currentColor" } as const;
  const within = (value: number) => Math.min(far, Math.max(-far, value));
  const line = { y: "label", stroke: "var(--series-1)", strokeWidth: 2 } as const;
  return Plot.plot({
    width,
    height: 54 + rows.length * (beside ? 28 : 44),
    marginLeft: beside ? longest + 18 : 12,
    marginRight: 24,
    marginTop: 8,
    marginBottom: 42,
    x: { domain: [-far, far], label: xLabel, labelAnchor: "center", labelArrow: "none", grid: true, ticks: Math.max(3, Math.min(8, width / 90)) },
    y: { domain: rows.map((row) => row.label), label: null, axis: beside ? "left" : null, tickSize: 0 },
    marks: [
      Plot.ruleX([0], { stroke: "var(--line-strong)", strokeWidth: 1.5 }),
      Plot.ruleY(rows, { x1: (row: Difference) => within(row.low), x2: (row: Difference) => within(row.high), ...line }),
      Plot.tickX(rows.filter((row) => row.low >= -far), { x: "low", ...line, insetTop: 8, insetBottom: 8 }),
      Plot.tickX(rows.filter((row) => row.high <= far), { x: "high", ...line, insetTop: 8, insetBottom: 8 }),
      Plot.text(arrows(rows, far), { x: "x", y: "label", text: "text", fill: "var(--series-1)", fontSize: 16 }),
      Plot.text(farther.filter((each) => each.x > 0), { ...value, textAnchor: "end" }),
      Plot.text(farther.filter((each) => each.x < 0), { ...value, textAnchor: "start" }),
      Plot.dot(rows.filter((row) => Math.abs(row.difference) <= far), { x: "difference", y: "label", symbol: "square", r: 5, fill: "var(--series-1)", stroke: "var(--ground)" }),
      beside ? null : Plot.text(rows, { y: "label", text: "label", frameAnchor: "left", dy: -15, fill: "currentColor" }),
    ],
  });
}
