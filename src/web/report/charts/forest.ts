// Differences with their intervals, one below the other.

import * as Plot from "@observablehq/plot";

export interface Difference {
  label: string;
  difference: number;
  low: number;
  high: number;
}

const LETTER = 6.3;

// On a narrow page the labels stand above their bars, on a wide one beside them.
export function drawForest(rows: Difference[], xLabel: string, width: number): Element {
  const longest = LETTER * Math.max(...rows.map((row) => row.label.length));
  const beside = longest < 0.42 * width;
  const far = Math.max(...rows.flatMap((row) => [Math.abs(row.low), Math.abs(row.high)])) || 1;
  const line = { y: "label", stroke: "var(--series-1)", strokeWidth: 2 } as const;
  return Plot.plot({
    width,
    height: 60 + rows.length * (beside ? 28 : 44),
    marginLeft: beside ? longest + 18 : 12,
    marginRight: 24,
    marginBottom: 42,
    x: { domain: [-1.05 * far, 1.05 * far], label: xLabel, labelAnchor: "center", labelArrow: "none", grid: true, ticks: Math.max(3, Math.min(8, width / 90)) },
    y: { domain: rows.map((row) => row.label), label: null, axis: beside ? "left" : null, tickSize: 0 },
    marks: [
      Plot.ruleX([0], { stroke: "var(--line-strong)", strokeWidth: 1.5 }),
      Plot.ruleY(rows, { x1: "low", x2: "high", ...line }),
      Plot.tickX(rows, { x: "low", ...line, insetTop: 8, insetBottom: 8 }),
      Plot.tickX(rows, { x: "high", ...line, insetTop: 8, insetBottom: 8 }),
      Plot.dot(rows, { x: "difference", y: "label", symbol: "square", r: 5, fill: "var(--series-1)", stroke: "var(--ground)" }),
      beside ? null : Plot.text(rows, { y: "label", text: "label", frameAnchor: "left", dy: -15, fill: "currentColor" }),
    ],
  });
}
