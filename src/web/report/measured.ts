// The cells of a measurement in summary.json: plain members are its factors and the numbers that
// rates are of, objects are rates, and names with mean_ or rms_ are means.

import { isNumber } from "../shared/format";
import type { Run } from "./payload";

export type MeasuredCell = Record<string, any>;

export interface Measured {
  value: number | null;
  low: number | null;
  high: number | null;
}

export interface Quantity {
  name: string;
  rate: boolean;
  of: (cell: MeasuredCell) => Measured;
}

const isMean = (name: string) => /^(mean|rms)_/.test(name);

/** Rates and means, in their order. */
export function quantities(cells: MeasuredCell[]): Quantity[] {
  const first = cells[0] ?? {};
  return Object.keys(first).flatMap((name): Quantity[] => {
    if (typeof first[name] === "object" && first[name] !== null && "rate" in first[name]) {
      return [{ name, rate: true, of: (cell) => ({ value: cell[name]?.rate ?? null, low: cell[name]?.ci95?.[0] ?? null, high: cell[name]?.ci95?.[1] ?? null }) }];
    }
    if (isMean(name)) return [{ name, rate: false, of: (cell) => ({ value: cell[name] ?? null, low: null, high: null }) }];
    return [];
  });
}

/** The factors: as the data names them, else plain members that come before the first rate and vary less than the cells. */
export function factorNames(run: Run, cells: MeasuredCell[]): string[] {
  if (run.factors) return run.factors;
  const first = cells[0] ?? {};
  const names = Object.keys(first);
  const rate = names.findIndex((name) => typeof first[name] === "object" && first[name] !== null);
  const plain = (rate < 0 ? names : names.slice(0, rate)).filter((name) => name !== "cell" && name !== "runs" && !isMean(name) && isNumber(first[name]));
  // The last plain one is what the rates are of.
  return plain.length > 1 ? plain.slice(0, -1) : plain;
}
