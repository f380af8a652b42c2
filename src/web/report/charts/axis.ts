// What the charts over a measured quantity share: labelled values on their axis and the steps of it.

import { isNumber } from "../../shared/format";
import type { PublishedRow, Run } from "../payload";

/** A labelled value on the axis. */
export interface Mark { x: number; label: string }

/** The nearest step that is 1, 2 or 5 times a power of ten. */
export function niceStep(raw: number): number {
  const power = 10 ** Math.floor(Math.log10(raw));
  const lead = raw / power;
  return power * (lead < 1.4 ? 1 : lead < 3.2 ? 2 : lead < 7 ? 5 : 10);
}

// ---- Published values as marks in charts.

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
