// Success along the axis of a sweep, such as the abundance of rocks.

import { el, type Child } from "../../shared/dom";
import { isNumber, percent, pValue, number } from "../../shared/format";
import { numeric, rowHeader, table } from "../../shared/table";
import { drawCurves, pointTable, type SlottedCurve } from "../charts/curves";
import { chartFigure } from "../charts/figure";
import { MOST_SHOWN, type Context } from "../context";
import type { Curve, Sweep } from "../payload";
import { legend } from "../series";
import type { Section } from "./section";

interface Fit {
  curve: string;
  success: string;
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
export function fitWords(curve: Curve, fit: Fit | undefined): string {
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
    head: ["curve", "success", ...["rate", "at", "95 % from", "to"].map((content) => ({ content, numeric: true })), "remark"],
    rows: fits.flatMap((fit) =>
      fit.crossings!.map((crossing) => [
        rowHeader(fit.curve || "all"),
        fit.success,
        numeric(percent(crossing.rate, 0), crossing.rate),
        numeric(number(crossing.x), crossing.x),
        numeric(number(crossing.ci95?.[0]), crossing.ci95?.[0]),
        numeric(number(crossing.ci95?.[1]), crossing.ci95?.[1]),
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
