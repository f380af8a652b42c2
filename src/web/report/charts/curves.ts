// Success along an axis of a sweep: points with intervals, fit with band.

import * as Plot from "@observablehq/plot";

import { number, percent, percentInterval } from "../../shared/format";
import { numeric, table } from "../../shared/table";
import type { Curve } from "../payload";
import { seriesStyle } from "../series";
import { unitText } from "../words";

export interface SlottedCurve {
  curve: Curve;
  slot: number;
}

function marksOf({ curve, slot }: SlottedCurve): Plot.Markish[] {
  const style = seriesStyle(slot);
  const stroke = { stroke: style.colour, strokeWidth: 2 };
  return [
    Plot.areaY(curve.fit ?? [], { x: "x", y1: "low", y2: "high", fill: style.colour, fillOpacity: 0.14 }),
    Plot.lineY(curve.fit ?? [], { x: "x", y: "rate", ...stroke, strokeDasharray: style.dash }),
    Plot.ruleX(curve.points, { x: "x", y1: "low", y2: "high", ...stroke }),
    Plot.dot(curve.points, {
      x: "x", y: "rate", symbol: style.symbol, r: 4.5, strokeWidth: 1.5,
      stroke: style.symbol === "times" ? style.colour : "var(--ground)",
      fill: style.symbol === "times" ? "none" : style.colour,
      tip: { format: { x: (x: number) => number(x), y: (rate: number) => percent(rate) } },
    }),
  ];
}

// Where there are few levels, a tick at each of them, unless two would meet.
function ticksOf(curves: SlottedCurve[], logarithmic: boolean, width: number): number[] | number {
  const levels = [...new Set(curves.flatMap(({ curve }) => curve.points.map((point) => point.x)))].sort((a, b) => a - b);
  const scale = (x: number) => (logarithmic ? Math.log(x) : x);
  const length = scale(levels[levels.length - 1]!) - scale(levels[0]!) || 1;
  const kept: number[] = [];
  for (const level of levels) {
    const before = kept[kept.length - 1];
    const gap = before === undefined ? Infinity : ((scale(level) - scale(before)) / length) * (width - 80);
    if (gap >= 44) kept.push(level);
  }
  return kept;
}

export function drawCurves(curves: SlottedCurve[], width: number): Element {
  const first = curves[0]!.curve;
  const logarithmic = first.scale === "log";
  const unit = first.unit === "" || first.unit === "1" ? "" : ` [${unitText(first.unit)}]`;
  return Plot.plot({
    width,
    height: Math.min(360, Math.max(260, width * 0.62)),
    marginLeft: 52,
    marginRight: 22,
    marginBottom: 42,
    x: {
      type: logarithmic ? "log" : "linear",
      label: first.axis + unit + (logarithmic ? ", logarithmic" : ""),
      labelAnchor: "center",
      labelArrow: "none",
      ticks: ticksOf(curves, logarithmic, width),
      tickFormat: (x: number) => number(x, 3),
      inset: 6,
    },
    y: { domain: [0, 1], label: `${first.success} success`, labelArrow: "none", grid: true, ticks: 5, tickFormat: (rate: number) => `${Math.round(100 * rate)} %` },
    marks: [Plot.ruleY([0], { stroke: "var(--line-strong)" }), ...curves.flatMap(marksOf)],
  });
}

export function pointTable({ curve }: SlottedCurve): HTMLElement {
  return table({
    caption: `${curve.label || curve.axis}: ${curve.success} success in each cell`,
    captionShown: true,
    head: ["cell", ...[curve.axis, "trials", "rate", "95 % interval"].map((content) => ({ content, numeric: true }))],
    rows: curve.points.map((point) => [
      point.cell,
      numeric(number(point.x), point.x),
      numeric(number(point.trials), point.trials),
      numeric(percent(point.rate), point.rate),
      numeric(percentInterval(point.low, point.high), point.high),
    ]),
  });
}
