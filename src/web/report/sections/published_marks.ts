// Published values as marks in charts.

import { isNumber } from "../../shared/format";
import type { Mark } from "../charts/axis";
import type { PublishedRow, Run } from "../payload";

const STATISTICS: Record<string, string> = { min: "minimum", max: "maximum" };

function statistic(row: PublishedRow): string {
  const last = row.id.slice(row.id.lastIndexOf(".") + 1);
  return STATISTICS[last] ?? last;
}

/** Of the rows that are wanted; the same value once. Labels begin with `prefix`. */
export function publishedMarks(runs: Run[], wanted: (row: PublishedRow) => boolean, prefix = "published "): Mark[] {
  const marks = new Map<string, Mark>();
  for (const run of runs) {
    for (const row of run.published?.rows ?? []) {
      if (!wanted(row) || !isNumber(row.published_value)) continue;
      const label = `${prefix}${statistic(row)} ${row.published.replace(/^-/, "−")}`;
      marks.set(label, { x: row.published_value, label });
    }
  }
  return [...marks.values()];
}
