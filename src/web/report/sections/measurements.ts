// Runs that measure rather than drive: a table of cells, and curves along a factor.

import * as Plot from "@observablehq/plot";

import { type Child, el, labelled, select } from "../../shared/dom";
import { isNumber, number, percent, percentInterval } from "../../shared/format";
import { numberCells, numeric, numericHeads, table } from "../../shared/table";
import { chartFigure } from "../charts/figure";
import { type Context, MOST_SHOWN } from "../context";
import type { Run } from "../payload";
import { legend, seriesStyle } from "../series";
import { columnLabel, columnWords } from "../words";
import type { Section } from "./section";

function cellTable(run: Run, cells: MeasuredCell[], of: Quantity[]): HTMLElement {
  const first = cells[0]!;
  const plain = Object.keys(first).filter((name) => isNumber(first[name]) && !of.some((each) => each.name === name) && name !== "cell");
  return table({
    caption: `Cells of ${run.label}`,
    head: numericHeads("cell", ...plain, ...of.flatMap(({ name, rate }) => (rate ? [name, "95 % interval"] : [name]))),
    rows: cells.map((cell) => [
      ...numberCells(cell.cell, ...plain.map((name) => cell[name])),
      ...of.flatMap((each) => {
        const point = each.of(cell);
        if (!each.rate) return numberCells(point.value);
        return [numeric(percent(point.value), point.value), numeric(percentInterval(point.low, point.high))];
      }),
    ]),
  });
}

function numbersOf(series: CellSeries[], factor: string, of: Quantity): HTMLElement {
  const heads = ["series", factor, of.name, "from", "to"];
  return table({
    caption: `${of.name} along ${factor}`,
    head: heads.map((content) => ({ content, numeric: content !== "series" })),
    rows: series.flatMap((each) =>
      each.points.map((point) => [each.label || "all", ...numberCells(point.x, point.value, point.low, point.high)])),
  });
}

function curve(at: number, run: Run, factors: string[], factor: string, of: Quantity): HTMLElement {
  const cells: MeasuredCell[] = run.summary.cells;
  const unit = run.trials?.columns?.find((column) => column.name === factor)?.unit ?? "";
  const { series, left } = seriesOf(cells, factors, factor, of);
  const others = factors.filter((name) => name !== factor).map(columnWords).join(", ");
  return chartFigure({
    id: `cells-${at}`,
    title: `${columnWords(of.name)} along ${columnWords(factor)}`,
    caption:
      (of.rate ? "Each mark is one cell with its 95 % interval" : "Each mark is the mean of one cell") +
      (others ? `; one line for each setting of ${others}` : "") +
      (left > 0 ? `; ${left} more settings are only in the table` : "") + ".",
    alternative: series
      .map((each) => `${each.label || of.name}: ${each.points.map((point) => `${number(point.value, 3)} at ${number(point.x, 3)}`).join(", ")}`)
      .join("; "),
    key: legend(series.map(({ slot, label }) => ({ slot, label })), "dot"),
    draw: (width) => drawCells(series, columnLabel(factor, unit), of, width),
    numbers: () => [numbersOf(series, factor, of)],
  });
}

function chosenCurve(at: number, run: Run, cells: MeasuredCell[], factors: string[], of: Quantity[]): Child[] {
  if (factors.length === 0 || of.length === 0) return [];
  const most = [...factors].sort((a, b) => new Set(cells.map((cell) => cell[b])).size - new Set(cells.map((cell) => cell[a])).size);
  const y = select(of.map((each) => [each.name, columnWords(each.name)]), of[0]!.name);
  const x = select(factors.map((name) => [name, columnWords(name)]), most[0]);
  const box = el("div");
  const draw = () => {
    const chosen = of.find((each) => each.name === y.value) ?? of[0]!;
    box.replaceChildren(curve(at, run, factors, x.value, chosen));
  };
  y.addEventListener("change", draw);
  x.addEventListener("change", draw);
  draw();
  const controls = el("div", { class: "controls" }, labelled("Quantity", y), factors.length > 1 ? labelled("Along", x) : null);
  return [of.length > 1 || factors.length > 1 ? controls : null, box];
}

function content(run: Run, at: number): Child[] {
  const cells: MeasuredCell[] = run.summary.cells;
  const of = quantities(cells);
  return [
    el("h3", {}, run.label),
    ...chosenCurve(at, run, cells, variedFactors(run, cells), of),
    cellTable(run, cells, of),
  ];
}

export const measurements: Section = {
  id: "measurements",
  title: "Measurements",
  render: (context: Context) => {
    const runs = context.runs.filter((run) => run.kind === "measurement" && (run.summary?.cells ?? []).length > 0);
    return runs.length === 0 ? null : runs.flatMap(content);
  },
};

// ---- What a measurement found along one factor, a line for each setting of the others.

interface CellSeries {
  slot: number;
  label: string;
  points: ({ x: number } & Measured)[];
}

/** The cells by the settings of all factors but one; `left`: how many settings had no colour left. */
function seriesOf(cells: MeasuredCell[], factors: string[], factor: string, of: Quantity): { series: CellSeries[]; left: number } {
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

function drawCells(series: CellSeries[], xLabel: string, of: Quantity, width: number): Element {
  return Plot.plot({
    width, height: Math.min(380, Math.max(260, width * 0.5)), marginLeft: 56, marginBottom: 42,
    x: { label: xLabel, labelAnchor: "center", labelArrow: "none", ticks: Math.max(3, width / 80), inset: 6 },
    y: {
      label: columnWords(of.name), labelArrow: "none", grid: true, ticks: 5, zero: of.rate,
      ...(of.rate ? { domain: [0, top(series)], tickFormat: (rate: number) => `${+(100 * rate).toFixed(3)} %` } : { nice: true }),
    },
    marks: series.flatMap(marksOf),
  });
}

// ---- The cells of a measurement in summary.json: objects are rates, names with mean_ or rms_ are means,
// and the other members are factors and the numbers that rates are of.

type MeasuredCell = Record<string, any>;

export interface Measured { value: number | null; low: number | null; high: number | null }

interface Quantity {
  name: string;
  rate: boolean;
  of: (cell: MeasuredCell) => Measured;
}

const isMean = (name: string) => /^(mean|rms)_/.test(name);

/** Rates and means, in their order. */
function quantities(cells: MeasuredCell[]): Quantity[] {
  const first = cells[0] ?? {};
  return Object.keys(first).flatMap((name): Quantity[] => {
    if (typeof first[name] === "object" && first[name] !== null && "rate" in first[name]) {
      return [{ name, rate: true, of: (cell) => ({ value: cell[name]?.rate ?? null, low: cell[name]?.ci95?.[0] ?? null, high: cell[name]?.ci95?.[1] ?? null }) }];
    }
    if (isMean(name)) return [{ name, rate: false, of: (cell) => ({ value: cell[name] ?? null, low: null, high: null }) }];
    return [];
  });
}

/** The factors that have more than one value. */
function variedFactors(run: Run, cells: MeasuredCell[]): string[] {
  return (run.factors ?? []).filter((name) => new Set(cells.map((cell) => cell[name])).size > 1);
}
