// What navigators count for themselves, in the cells of a sweep: along its numeric axis, and as a table.

import * as Plot from "@observablehq/plot";

import { breakable, type Child, el } from "../../shared/dom";
import { interval, isNumber, number } from "../../shared/format";
import { numberCells, numeric, numericHeads, rowHeader, table } from "../../shared/table";
import { chartFigure } from "../charts/figure";
import { type Context, MOST_SHOWN } from "../context";
import type { Sweep } from "../payload";
import { legend, seriesStyle } from "../series";
import { columnLabel, columnWords, isOwnColumn } from "../words";
import { alongAxis, type SlottedCurve } from "./abundance";
import type { Section } from "./section";

/** A metric of a cell, as summary.json of the sweep has it. */
interface Metric { count: number; mean: number | null; ci95: [number | null, number | null] }

interface Cell { name: string; metrics: Record<string, Metric> }

interface OwnValue { name: string; unit: string; meaning: string }

interface Point { x: number; mean: number; low: number | null; high: number | null; trials: number; cell: string }

interface OwnCurve extends SlottedCurve { points: Point[] }

const cellsOf = (sweep: Sweep): Cell[] => sweep.summary?.cells ?? [];

/** What some cell of the sweep has a value of; unit and meaning as the runs declare them. */
function ownValues(context: Context, sweep: Sweep, at: number): OwnValue[] {
  const names = new Set(cellsOf(sweep).flatMap(({ metrics }) =>
    Object.entries(metrics ?? {}).flatMap(([name, { count }]) => (isOwnColumn(name) && count > 0 ? [name] : []))));
  const columns = context.runs.filter((run) => run.sweep === at).flatMap((run) => run.trials?.columns ?? []);
  return [...names].map((name) => {
    const { unit = "1", meaning = "" } = columns.find((each) => each.name === name) ?? {};
    return { name, unit, meaning };
  });
}

/** The means along the axis, one curve for each setting of the other axes; cells that another navigator drove have none. */
function curvesOf(sweep: Sweep, name: string): OwnCurve[] {
  return (sweep.curves ?? [])
    .filter((curve) => curve.success === "declared")
    .flatMap((curve) => {
      const points = curve.points.flatMap(({ x, cell }): Point[] => {
        const metric = cellsOf(sweep).find((each) => each.name === cell)?.metrics?.[name];
        if (!metric || !isNumber(metric.mean)) return [];
        return [{ x, mean: metric.mean, low: metric.ci95[0], high: metric.ci95[1], trials: metric.count, cell }];
      });
      return points.length > 0 ? [{ curve, points }] : [];
    })
    .slice(0, MOST_SHOWN)
    .map((each, slot) => ({ ...each, slot }));
}

const labelOf = ({ curve }: OwnCurve, name: string) => curve.label || columnWords(name);

function draw(curves: OwnCurve[], label: string, width: number): Element {
  return Plot.plot({
    ...alongAxis(curves, width),
    y: { label, labelArrow: "none", grid: true, ticks: 5, zero: true, tickFormat: (mean: number) => number(mean, 3) },
    marks: [
      Plot.ruleY([0], { stroke: "var(--line-strong)" }),
      ...curves.flatMap(({ slot, points }) => {
        const { colour, dash, symbol } = seriesStyle(slot);
        const stroke = { stroke: colour, strokeWidth: 2 };
        return [
          Plot.lineY(points, { x: "x", y: "mean", ...stroke, strokeDasharray: dash }),
          Plot.ruleX(points.filter(({ low, high }) => isNumber(low) && isNumber(high)), { x: "x", y1: "low", y2: "high", ...stroke }),
          Plot.dot(points, {
            x: "x", y: "mean", symbol, r: 4.5, strokeWidth: 1.5,
            stroke: symbol === "times" ? colour : "var(--ground)", fill: symbol === "times" ? "none" : colour,
          }),
        ];
      }),
    ],
  });
}

function pointTable(of: OwnCurve, { name, unit }: OwnValue): HTMLElement {
  return table({
    caption: `${labelOf(of, name)}: mean of ${columnLabel(name, unit)} in each cell`,
    captionShown: true,
    head: ["cell", ...numericHeads(of.curve.axis, "trials", "mean", "95 % interval")],
    rows: of.points.map((point) => [
      point.cell, ...numberCells(point.x, point.trials, point.mean), numeric(interval(point.low, point.high), point.high)]),
  });
}

function chart(sweep: Sweep, at: number, of: OwnValue): HTMLElement | null {
  const curves = curvesOf(sweep, of.name);
  const axis = curves[0]?.curve.axis;
  if (axis === undefined) return null;
  const meaning = of.meaning === "" ? "" : `${columnWords(of.name)}: ${of.meaning.replace(/\.$/, "")}. `;
  return chartFigure({
    id: `own-${at}-${of.name.replace(".", "-")}`,
    title: columnWords(of.name),
    caption: `${meaning}Each mark is the mean of one cell over all its trials, with its 95 % interval where it has one. The line joins marks and is no fit.`,
    alternative: curves
      .map((each) => `${labelOf(each, of.name)}: ${each.points.map(({ x, mean }) => `${number(mean, 3)} at ${axis} ${number(x)}`).join(", ")}`)
      .join("; "),
    key: legend(curves.map((each) => ({ slot: each.slot, label: labelOf(each, of.name) })), "dot"),
    draw: (width) => draw(curves, columnLabel(of.name, of.unit), width),
    numbers: () => curves.map((each) => pointTable(each, of)),
  });
}

function cellTable(sweep: Sweep, values: OwnValue[]): HTMLElement {
  return table({
    caption: `What navigators count in each cell of ${sweep.label}: means of all trials`,
    tall: cellsOf(sweep).length > 16,
    head: ["Cell", ...values.flatMap(({ name, unit }) => numericHeads(columnLabel(name, unit), "95 % interval"))],
    rows: cellsOf(sweep).map(({ name: cell, metrics }) => [rowHeader(breakable(cell)), ...values.flatMap(({ name }) => {
      const { mean = null, ci95: [low, high] = [null, null] } = metrics?.[name] ?? {};
      return [...numberCells(mean), numeric(interval(low, high), high)];
    })]),
  });
}

function sweepContent(context: Context, sweep: Sweep, at: number): Child[] {
  const values = ownValues(context, sweep, at);
  if (values.length === 0) return [];
  const charts = values.slice(0, MOST_SHOWN).map((each) => chart(sweep, at, each));
  return [el("h3", {}, sweep.label), el("div", { class: "chart-grid" }, ...charts), cellTable(sweep, values)];
}

export const ownCurves: Section = {
  id: "own-curves",
  title: "What navigators count, by cell",
  short: "Counts by cell",
  render: (context: Context) => {
    const content = (context.payload.sweeps ?? []).flatMap((sweep, at) => sweepContent(context, sweep, at));
    return content.length > 0 ? content : null;
  },
};
