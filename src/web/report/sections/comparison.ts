// Differences between two runs.

import * as Plot from "@observablehq/plot";

import { type Child, el } from "../../shared/dom";
import { counted, interval, isNumber, number, percent, points, pointsInterval, pValue } from "../../shared/format";
import { type Cell, numberCells, numeric, numericHeads, rowHeader, table } from "../../shared/table";
import { chartFigure } from "../charts/figure";
import type { Context } from "../context";
import type { Comparison } from "../payload";
import { columnLabel, columnWords, isOwnColumn } from "../words";
import type { Section } from "./section";

type Column = Comparison["columns"][number];

const CLEAR = (low: number | null, high: number | null) => isNumber(low) && isNumber(high) && (low > 0 || high < 0);

function successRows(of: Comparison): Difference[] {
  return of.successes.flatMap((row) =>
    isNumber(row.difference) && isNumber(row.low) && isNumber(row.high)
      ? [{ label: row.what, difference: 100 * row.difference, low: 100 * row.low, high: 100 * row.high }]
      : [],
  );
}

// What is looked at first; positions and headings at the end have means that say little.
const DRAWN: Record<Column["trials"], string[]> = {
  all: [
    "true_distance_m", "true_goal_distance_m", "sim_time_s", "energy_wh", "net_rate_m_s", "scans", "hazards_believed", "turns_in_place",
    "scrapes", "max_tilt_deg", "min_clearance_m", "heading_error_deg", "position_error_m",
  ],
  arrived: ["path_ratio", "sim_time_s", "energy_wh"],
};
const MOST_DRAWN = 16;
// One column that grew fifty times must not press the others into dots.
const MOST_PERCENT = 100;

function drawnColumns(of: Comparison): Column[] {
  const known = of.columns.filter((row) => DRAWN[row.trials]?.includes(row.name) || (row.trials === "all" && isOwnColumn(row.name)));
  return known.length > 0 ? known : of.columns.slice(0, MOST_DRAWN);
}

const drawnLabel = (row: Column) => (row.trials === "arrived" ? `${columnWords(row.name)} (arrived)` : columnWords(row.name));

// Columns have different units: as a share of the first run's mean they go on one axis.
function columnRows(of: Comparison): Difference[] {
  return drawnColumns(of).flatMap((row) => {
    if (!isNumber(row.first) || !isNumber(row.difference) || !isNumber(row.low) || !isNumber(row.high)) return [];
    if (row.first === 0) return [];
    const scale = 100 / Math.abs(row.first);
    return [{ label: drawnLabel(row), difference: scale * row.difference, low: scale * row.low, high: scale * row.high }];
  });
}

// Of a mean of 0 there is no share: such columns are named with their means.
function notDrawn(of: Comparison): string {
  const texts = drawnColumns(of)
    .filter((row) => row.first === 0 && isNumber(row.second) && row.second !== 0)
    .map((row) => `${drawnLabel(row)} (0, then ${number(row.second, 3)})`);
  return texts.length > 0 ? ` Not drawn, because a share of 0 is not defined: ${texts.join(", ")}.` : "";
}

const sentence = (rows: Difference[], unit: string) =>
  rows.map((row) => `${row.label}: ${number(row.difference, 3)} ${unit} (${interval(row.low, row.high)})`).join("; ");

function successTable(of: Comparison): HTMLElement {
  return table({
    caption: `Success of ${of.first} and ${of.second}`,
    className: "compact",
    head: ["Success", ...numericHeads(of.first, of.second, "Difference [points]", "95 % interval", "p")],
    rows: of.successes.map((row) => [
      rowHeader(row.what),
      numeric(percent(row.first), row.first),
      numeric(percent(row.second), row.second),
      numeric(points(row.difference), row.difference),
      numeric(pointsInterval(row.low, row.high)),
      numeric(pValue(row.p), row.p),
    ]),
  });
}

function columnRow(of: Comparison, row: Column): (Child | Cell)[] {
  const arrived = of.paired ? "those that arrived in both" : "those that arrived";
  const n = isNumber(row.n_second) ? `${number(row.n)} / ${number(row.n_second)}` : number(row.n);
  return [
    rowHeader(columnLabel(row.name, row.unit)),
    row.trials === "arrived" ? arrived : "all",
    numeric(n, row.n),
    ...numberCells(row.first, row.second),
    numeric(CLEAR(row.low, row.high) ? el("strong", {}, number(row.difference, 3)) : number(row.difference, 3), row.difference),
    numeric(interval(row.low, row.high)),
  ];
}

function columnTable(of: Comparison): HTMLElement {
  return table({
    caption: `Means of ${of.first} and ${of.second}`,
    tall: of.columns.length > MOST_DRAWN,
    head: ["Column", "Trials", ...numericHeads("n", of.first, of.second, "Difference", "95 % interval")],
    rows: of.columns.map((row) => columnRow(of, row)),
  });
}

function forests(of: Comparison, at: number): HTMLElement {
  const successes = successRows(of);
  const columns = columnRows(of);
  const read = "A square is the difference, the line its 95 % interval: where it crosses zero, the runs may be alike. An arrow: it goes on; a number above it is a difference beyond the axis.";
  // The short chart has its table below it, beside the long one.
  const success = el("div", { class: "chart-figure" },
    successes.length > 0 &&
      chartFigure({
        id: `forest-success-${at}`,
        title: "Success",
        caption: `Rate of ${of.second} less that of ${of.first}, in percentage points. ${read}`,
        alternative: sentence(successes, "points"),
        draw: (width) => drawForest(successes, "difference [percentage points]", width),
        numbers: () => [forestTable(successes, "percentage points")],
      }),
    successTable(of));
  return el("div", { class: "chart-grid" },
    success,
    columns.length === 0
      ? el("p", { class: "note" }, "No difference of means is drawn, since none has an interval: so few trials are too few for one.")
      : chartFigure({
          id: `forest-columns-${at}`,
          title: "Means",
          caption: `Mean of ${of.second} less that of ${of.first}, in per cent of the latter, for the columns that are looked at first; the table below has all. ${read}${notDrawn(of)}`,
          alternative: sentence(columns, "%"),
          draw: (width) => drawForest(columns, "difference [%]", width, MOST_PERCENT),
          numbers: () => [forestTable(columns, `% of ${of.first}`)],
        }));
}

function content(of: Comparison, at: number): Child[] {
  const how = of.paired ? `${counted(of.pairs, "pair")} of trials with the same seed` : "two samples, not in pairs";
  return [
    el("h3", {}, `${of.second} against ${of.first}`),
    el("p", { class: "note" }, `Compared: ${how}.`),
    forests(of, at),
    columnTable(of),
    (of.notes ?? []).length > 0 ? el("ul", { class: "note" }, ...of.notes.map((note) => el("li", {}, note))) : null,
  ];
}

export const comparison: Section = {
  id: "comparison",
  title: "All differences between runs",
  short: "Differences",
  render: (context: Context) => {
    const all = context.payload.comparisons ?? [];
    return all.length === 0 ? null : all.flatMap(content);
  },
};

// ---- Differences with their intervals, one below the other.

export interface Difference { label: string; difference: number; low: number; high: number }

const LETTER = 7;
// One wide interval must not press all others into a line: what goes further is cut and gets an arrow.
const MOST_OF_MEDIAN = 6;

function reach(rows: Difference[], most: number): number {
  const ends = rows.map((row) => Math.max(Math.abs(row.low), Math.abs(row.high))).sort((a, b) => a - b);
  const median = ends[Math.floor(ends.length / 2)] ?? 1;
  return 1.08 * (Math.min(ends[ends.length - 1] ?? 1, MOST_OF_MEDIAN * median, most) || 1);
}

interface Arrow { label: string; x: number; text: string }

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

function forestTable(rows: Difference[], unit: string): HTMLElement {
  return table({
    caption: `Differences as drawn, ${unit}`,
    head: ["", ...numericHeads("difference", "from", "to")],
    rows: rows.map((row) => [rowHeader(row.label), ...numberCells(row.difference, row.low, row.high)]),
  });
}

/** The axis ends at `most` at the latest. On a narrow page labels stand above their bars, on a wide one beside them. */
function drawForest(rows: Difference[], xLabel: string, width: number, most = Infinity): Element {
  const longest = LETTER * Math.max(...rows.map((row) => row.label.length));
  const beside = longest < 0.42 * width;
  const far = reach(rows, most);
  const farther = beyond(rows, far);
  const value = { x: "x", y: "label", text: "text", dy: -10, fill: "currentColor" } as const;
  const within = (value: number) => Math.min(far, Math.max(-far, value));
  const line = { y: "label", stroke: "var(--series-1)", strokeWidth: 2 } as const;
  return Plot.plot({
    width, height: 54 + rows.length * (beside ? 28 : 44), marginLeft: beside ? longest + 18 : 12,
    marginRight: 24, marginTop: 8, marginBottom: 42,
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
