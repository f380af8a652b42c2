// The cells of a measurement in summary.json: objects are rates, names with mean_ or rms_ are means,
// and the other members are factors and the numbers that rates are of.

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

/** The factors that have more than one value. */
export function variedFactors(run: Run, cells: MeasuredCell[]): string[] {
  return (run.factors ?? []).filter((name) => new Set(cells.map((cell) => cell[name])).size > 1);
}
