// Trials of all runs as rows of one table.

import type { Run } from "./payload";
import { ratedRows } from "./prefix";
import { replayLink } from "./replay_link";

export interface TrialRow {
  run: string;
  trial: number;
  outcome: string;
  detail: string;
  /** Link of its replay page, or "". */
  replay: string;
  /** Index of its run. */
  of: number;
  /** "", or that the trial is in no rate. */
  unrated: string;
  /** Values by column name: field names are "v_" + name, so that no name can hide another member. */
  [value: `v_${string}`]: number | null;
}

export interface ColumnInfo {
  name: string;
  unit: string;
}

/** A column's field in a row. */
export const fieldOf = (name: string): `v_${string}` => `v_${name}`;

/** Every column that some run has, in the order of the first that has it. */
export function columnsOf(runs: Run[]): ColumnInfo[] {
  const all = new Map<string, ColumnInfo>();
  for (const run of runs) {
    for (const { name, unit } of run.trials?.columns ?? []) if (!all.has(name)) all.set(name, { name, unit });
  }
  return [...all.values()];
}

const NOT_IN_RATES = "not in the rates";

function rowsOfRun(run: Run, of: number): TrialRow[] {
  const { trial, outcome, outcome_names, detail, detail_texts, columns } = run.trials;
  const rated = ratedRows(run);
  return trial.map((number, i) => {
    const row: TrialRow = {
      run: run.label,
      trial: number,
      outcome: outcome_names[outcome[i] ?? -1] ?? "",
      detail: detail_texts?.[detail?.[i] ?? -1] ?? "",
      replay: replayLink(run, number),
      of,
      unrated: i < rated ? "" : NOT_IN_RATES,
    };
    for (const column of columns) row[fieldOf(column.name)] = column.values[i] ?? null;
    return row;
  });
}

export function trialRows(runs: Run[]): TrialRow[] {
  return runs.flatMap((run, of) => (run.trials ? rowsOfRun(run, of) : []));
}
