// What a measurement found along one factor, a line for each setting of the others.

import * as Plot from "@observablehq/plot";

import { isNumber, number } from "../../shared/format";
import { MOST_SHOWN } from "../context";
import type { Measured, MeasuredCell, Quantity } from "../measured";
import { seriesStyle } from "../series";
import { columnWords } from "../words";

export interface CellSeries {
  slot: number;
  label: string;
  points: ({ x: number } & Measured)[];
}

/** The cells by the settings of all factors but one; `left`: how many settings had no colour left. */
export function seriesOf(cells: MeasuredCell[], factors: string[], factor: string, of: Quantity): { series: CellSeries[]; left: number } {
  const groups = new Map<string, CellSeries["points"]>();
  for (const cell of cells) {
    const label = factors
      .filter((name) => name !== factor)
      .map((name) => `${columnWords(name)} ${number(cell[name])}`)
      .join(", ");
    const point = { x: cell[factor] as number, ...of.of(cell) };
    if (!isNumber(point.x) || !isNumber(point.value)) continue;
    groups.set(label, [...(groups.get(label) ?? []), point]);
  }
  const all = [...groups].map(([label, points], slot) => ({ slot, label, points: points.sort((a, b) => a.x - b.x) }));
  return { series: all.slice(0, MOST_SHOWN), left: Math.max(0, all.length - MOST_SHOWN) };
}

function marksOf(series: CellSeries): Plot.Markish[] {
  const style = seriesStyle(series.slot);
  const hollow = style.symbol === "times";
  return [
    Plot.lineY(series.points, { x: "x", y: "value", stroke: style.colour, strokeWidth: 2, strokeDasharray: style.dash }),
    Plot.ruleX(series.points.filter((point) => isNumber(point.low)), { x: "x", y1: "low", y2: "high", stroke: style.colour, strokeWidth: 2 }),
    Plot.dot(series.points, {
      x: "x", y: "value", symbol: style.symbol, r: 4.5, strokeWidth: 1.5,
      stroke: hollow ? style.colour : "var(--ground)", fill: hollow ? "none" : style.colour,
      tip: { format: { x: (x: number) => number(x), y: (y: number) => number(y) } },
    }),
  ];
}

const SMALL_RATE = 0.3;

// Rare events would lie on the axis of a scale to 100 %.
function top(series: CellSeries[]): number {
  const highest = Math.max(...series.flatMap(({ points }) => points.map((point) => point.high ?? point.value ?? 0)));
  return highest > 0 && highest < SMALL_RATE ? 1.1 * highest : 1;
}

export function drawCells(series: CellSeries[], xLabel: string, of: Quantity, width: number): Element {
  return Plot.plot({
    width,
    height: Math.min(380, Math.max(260, width * 0.5)),
    marginLeft: 56,
    marginBottom: 42,
    x: { label: xLabel, labelAnchor: "center", labelArrow: "none", ticks: Math.max(3, width / 80), inset: 6 },
    y: {
      label: columnWords(of.name), labelArrow: "none", grid: true, ticks: 5, zero: of.rate,
      ...(of.rate ? { domain: [0, top(series)], tickFormat: (rate: number) => `${+(100 * rate).toFixed(3)} %` } : { nice: true }),
    },
    marks: series.flatMap(marksOf),
  });
}
