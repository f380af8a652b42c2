// Runs that measure rather than drive: a table of cells, and curves along a factor.

import { el, labelled, select, type Child } from "../../shared/dom";
import { isNumber, number, percent, percentInterval } from "../../shared/format";
import { numeric, table } from "../../shared/table";
import { drawCells, seriesOf, type CellSeries } from "../charts/cells";
import { chartFigure } from "../charts/figure";
import type { Context } from "../context";
import { variedFactors, quantities, type MeasuredCell, type Quantity } from "../measured";
import type { Run } from "../payload";
import { legend } from "../series";
import { columnLabel, columnWords } from "../words";
import type { Section } from "./section";

function cellTable(run: Run, cells: MeasuredCell[], of: Quantity[]): HTMLElement {
  const first = cells[0]!;
  const plain = Object.keys(first).filter((name) => isNumber(first[name]) && !of.some((each) => each.name === name) && name !== "cell");
  return table({
    caption: `Cells of ${run.label}`,
    head: [
      { content: "cell", numeric: true },
      ...plain.map((name) => ({ content: name, numeric: true })),
      ...of.flatMap((each) => [{ content: each.name, numeric: true }, ...(each.rate ? [{ content: "95 % interval", numeric: true }] : [])]),
    ],
    rows: cells.map((cell) => [
      numeric(number(cell.cell), cell.cell),
      ...plain.map((name) => numeric(number(cell[name]), cell[name])),
      ...of.flatMap((each) => {
        const point = each.of(cell);
        if (!each.rate) return [numeric(number(point.value), point.value)];
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
      each.points.map((point) => [
        each.label || "all",
        numeric(number(point.x), point.x),
        ...[point.value, point.low, point.high].map((value) => numeric(number(value), value)),
      ]),
    ),
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
  short: "Measurements",
  render: (context: Context) => {
    const runs = context.runs.filter((run) => run.kind === "measurement" && (run.summary?.cells ?? []).length > 0);
    return runs.length === 0 ? null : runs.flatMap(content);
  },
};
