// Differences between two runs.

import { el, type Child } from "../../shared/dom";
import { counted, interval, isNumber, number, percent, points, pointsInterval, pValue } from "../../shared/format";
import { numeric, rowHeader, table, type Cell } from "../../shared/table";
import { chartFigure } from "../charts/figure";
import { drawForest, forestTable, type Difference } from "../charts/forest";
import type { Context } from "../context";
import type { Comparison } from "../payload";
import { columnLabel, columnWords } from "../words";
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
  const known = of.columns.filter((row) => DRAWN[row.trials]?.includes(row.name));
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
    head: ["Success", ...[of.first, of.second, "Difference [points]", "95 % interval", "p"].map((content) => ({ content, numeric: true }))],
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
    numeric(number(row.first), row.first),
    numeric(number(row.second), row.second),
    numeric(CLEAR(row.low, row.high) ? el("strong", {}, number(row.difference, 3)) : number(row.difference, 3), row.difference),
    numeric(interval(row.low, row.high)),
  ];
}

function columnTable(of: Comparison): HTMLElement {
  return table({
    caption: `Means of ${of.first} and ${of.second}`,
    tall: of.columns.length > MOST_DRAWN,
    head: ["Column", "Trials", ...["n", of.first, of.second, "Difference", "95 % interval"].map((content) => ({ content, numeric: true }))],
    rows: of.columns.map((row) => columnRow(of, row)),
  });
}

function forests(of: Comparison, at: number): HTMLElement {
  const successes = successRows(of);
  const columns = columnRows(of);
  const read = "A square is the difference, the line its 95 % interval: where it crosses zero, the runs may be alike. An arrow: it goes on; a number above it is a difference beyond the axis.";
  // The short chart has its table below it, beside the long one.
  const success = el(
    "div",
    { class: "chart-figure" },
    successes.length > 0 &&
      chartFigure({
        id: `forest-success-${at}`,
        title: "Success",
        caption: `Rate of ${of.second} less that of ${of.first}, in percentage points. ${read}`,
        alternative: sentence(successes, "points"),
        draw: (width) => drawForest(successes, "difference [percentage points]", width),
        numbers: () => [forestTable(successes, "percentage points")],
      }),
    successTable(of),
  );
  return el(
    "div",
    { class: "chart-grid" },
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
        }),
  );
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
