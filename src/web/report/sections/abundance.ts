// Success along the axis of a sweep, such as the abundance of rocks.

import * as Plot from "@observablehq/plot";

import { type Child, el } from "../../shared/dom";
import { isNumber, number, percent, percentInterval, pValue } from "../../shared/format";
import { numberCells, numeric, numericHeads, rowHeader, table } from "../../shared/table";
import { chartFigure } from "../charts/figure";
import { type Context, MOST_SHOWN } from "../context";
import type { Curve, Sweep } from "../payload";
import { legend, seriesStyle } from "../series";
import { unitText } from "../words";
import type { Section } from "./section";

interface Fit {
  curve: string; success: string;
  fitted: boolean;
  p_value: number | null;
  crossings?: { rate: number; x: number | null; ci95: [number | null, number | null]; outside_of_data: boolean }[];
}

function fitOf(sweep: Sweep, curve: Curve): Fit | undefined {
  const fits: Fit[] = sweep.summary?.fits ?? [];
  return fits.find((fit) => fit.curve === curve.label && fit.success.startsWith(curve.success));
}

function curveOf(sweep: Sweep, fit: Fit): Curve | undefined {
  return (sweep.curves ?? []).find((curve) => curve.label === fit.curve && fit.success.startsWith(curve.success));
}

/** What is to be said of a fit, in words. */
function fitWords(curve: Curve, fit: Fit | undefined): string {
  if ((curve.fit ?? []).length === 0) return `no fit: ${curve.fit_status || "none was made"}`;
  if (typeof curve.fit_rejected !== "boolean") return curve.fit_status || "fitted";
  const p = isNumber(fit?.p_value) ? ` (p ${pValue(fit.p_value)})` : "";
  return curve.fit_rejected
    ? `fit rejected${p}: the points do not follow the line; believe the points`
    : `fit not rejected${p}`;
}

function curvesOf(sweep: Sweep, success: Curve["success"]): SlottedCurve[] {
  return (sweep.curves ?? [])
    .filter((curve) => curve.success === success && curve.points.length > 0)
    .slice(0, MOST_SHOWN)
    .map((curve, slot) => ({ curve, slot }));
}

const labelOf = (curve: Curve) => curve.label || `${curve.success} success`;

function chart(sweep: Sweep, at: number, success: Curve["success"]): HTMLElement | null {
  const curves = curvesOf(sweep, success);
  const axis = curves[0]?.curve.axis;
  if (axis === undefined) return null;
  const notes = curves.map(({ curve }) => {
    const text = fitWords(curve, fitOf(sweep, curve));
    return el("li", { class: text.startsWith("fit rejected") ? "rejected" : null }, curves.length > 1 ? `${labelOf(curve)}: ${text}` : text);
  });
  const figure = chartFigure({
    id: `curve-${at}-${success}`,
    title: `${success === "declared" ? "Declared" : "True"} success`,
    caption:
      "Each mark is one cell with its 95 % interval. The line is a logistic fit through all cells, its shaded band the 95 % interval of the fitted " +
      "rate at each place (pointwise), which holds only where the line fits.",
    alternative: curves
      .map(({ curve }) => {
        const ends = [curve.points[0]!, curve.points[curve.points.length - 1]!];
        return `${labelOf(curve)}: ${ends.map((point) => `${percent(point.rate)} at ${axis} ${number(point.x)}`).join(", ")}`;
      })
      .join("; "),
    key: legend(curves.map(({ curve, slot }) => ({ slot, label: labelOf(curve) })), "dot"),
    draw: (width) => drawCurves(curves, width),
    numbers: () => curves.map(pointTable),
  });
  figure.append(el("ul", { class: "fit-notes" }, ...notes));
  return figure;
}

function crossings(sweep: Sweep): HTMLElement | null {
  const fits = ((sweep.summary?.fits ?? []) as Fit[]).filter((fit) => (fit.crossings ?? []).length > 0);
  if (fits.length === 0) return null;
  return el("details", { class: "numbers" }, el("summary", {}, "Where the fits cross given rates"), table({
    caption: `Crossings of the fits of ${sweep.label}`,
    head: ["curve", "success", ...numericHeads("rate", "at", "95 % from", "to"), "remark"],
    rows: fits.flatMap((fit) =>
      fit.crossings!.map((crossing) => [
        rowHeader(fit.curve || "all"),
        fit.success,
        numeric(percent(crossing.rate, 0), crossing.rate),
        ...numberCells(crossing.x, crossing.ci95?.[0], crossing.ci95?.[1]),
        [
          crossing.outside_of_data ? "outside of the cells" : "",
          curveOf(sweep, fit)?.fit_rejected ? "the fit is rejected" : "",
        ].filter(Boolean).join("; "),
      ]),
    ),
  }));
}

function sweepCharts(sweep: Sweep, at: number): Child[] {
  const charts = (["declared", "true"] as const).map((success) => chart(sweep, at, success));
  const labels = new Set((sweep.curves ?? []).map((curve) => curve.label));
  if (charts.every((each) => each === null)) return [];
  return [
    el("h3", {}, sweep.label),
    labels.size > MOST_SHOWN
      ? el("p", { class: "note" }, `The first ${MOST_SHOWN} of ${labels.size} curves are drawn; all cells are in the table of success.`)
      : null,
    el("div", { class: "chart-grid" }, ...charts),
    crossings(sweep),
    ...((sweep.summary?.notes ?? []) as string[]).map((note) => el("p", { class: "note" }, note)),
  ];
}

export const abundance: Section = {
  id: "curves",
  title: "Success along an axis",
  short: "Curves",
  render: (context: Context) => {
    const content = (context.payload.sweeps ?? []).flatMap(sweepCharts);
    return content.length > 0 ? content : null;
  },
};

// ---- Success along an axis of a sweep: points with intervals, fit with band.

export interface SlottedCurve { curve: Curve; slot: number }

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

/** Size and axis of a drawing along the axis of a sweep. */
export function alongAxis(curves: SlottedCurve[], width: number): Plot.PlotOptions {
  const first = curves[0]!.curve;
  const logarithmic = first.scale === "log";
  const unit = first.unit === "" || first.unit === "1" ? "" : ` [${unitText(first.unit)}]`;
  return {
    width, height: Math.min(360, Math.max(260, width * 0.62)), marginLeft: 52, marginRight: 22,
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
  };
}

export function drawCurves(curves: SlottedCurve[], width: number): Element {
  const first = curves[0]!.curve;
  return Plot.plot({
    ...alongAxis(curves, width),
    y: { domain: [0, 1], label: `${first.success} success`, labelArrow: "none", grid: true, ticks: 5, tickFormat: (rate: number) => `${Math.round(100 * rate)} %` },
    marks: [Plot.ruleY([0], { stroke: "var(--line-strong)" }), ...curves.flatMap(marksOf)],
  });
}

function pointTable({ curve }: SlottedCurve): HTMLElement {
  return table({
    caption: `${curve.label || curve.axis}: ${curve.success} success in each cell`,
    captionShown: true,
    head: ["cell", ...numericHeads(curve.axis, "trials", "rate", "95 % interval")],
    rows: curve.points.map((point) => [
      point.cell,
      ...numberCells(point.x, point.trials),
      numeric(percent(point.rate), point.rate),
      numeric(percentInterval(point.low, point.high), point.high),
    ]),
  });
}
