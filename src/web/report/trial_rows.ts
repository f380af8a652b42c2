// Trials of all runs as rows, and the conditions by which some are shown.

import { isNumber, words } from "../shared/format";
import type { Run } from "./payload";
import { ratedTrials } from "./prefix";

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

// Only places beside the page: nothing with a scheme of its own.
function safeLink(link: string | undefined): string {
  return link !== undefined && !/^[a-z][a-z0-9+.-]*:/i.test(link.trim()) && !link.startsWith("//") ? link : "";
}

const NOT_IN_RATES = "not in the rates";

function rowsOfRun(run: Run, of: number): TrialRow[] {
  const { trial, outcome, outcome_names, detail, detail_texts, columns } = run.trials;
  const rated = ratedTrials(run);
  return trial.map((number, i) => {
    const row: TrialRow = {
      run: run.label,
      trial: number,
      outcome: outcome_names[outcome[i] ?? -1] ?? "",
      detail: detail_texts?.[detail?.[i] ?? -1] ?? "",
      replay: safeLink(run.replays?.[String(number)]),
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

export interface TrialFilter {
  text: string;
  run: string;
  outcome: string;
  onlyReplays: boolean;
  onlyRated: boolean;
}

const OPERATORS: Record<string, (a: number, b: number) => boolean> = {
  "<": (a, b) => a < b,
  ">": (a, b) => a > b,
  "<=": (a, b) => a <= b,
  ">=": (a, b) => a >= b,
  "=": (a, b) => a === b,
};

type Condition = (row: TrialRow) => boolean;

// "energy_wh>20" compares a column; any other word is looked for in the texts.
function condition(word: string): Condition {
  const [, name, operator, limit] = /^([a-z][a-z0-9_]*)(<=|>=|<|>|=)(-?[0-9.]+(?:e-?\d+)?)$/i.exec(word) ?? [];
  if (name !== undefined && operator !== undefined) {
    const field = name === "trial" ? "trial" : fieldOf(name);
    return (row) => {
      const value = row[field];
      return isNumber(value) && OPERATORS[operator]!(value, Number(limit));
    };
  }
  const wanted = word.toLowerCase();
  return (row) =>
    String(row.trial) === wanted ||
    [row.run, row.outcome, words(row.outcome), row.unrated, row.detail].some((text) => text.toLowerCase().includes(wanted));
}

/** The rows that meet every word of the text and every choice. */
export function matching(rows: TrialRow[], filter: TrialFilter): TrialRow[] {
  const conditions = filter.text.trim().split(/\s+/).filter(Boolean).map(condition);
  return rows.filter(
    (row) =>
      (filter.run === "" || row.run === filter.run) &&
      (filter.outcome === "" || row.outcome === filter.outcome) &&
      (!filter.onlyReplays || row.replay !== "") &&
      (!filter.onlyRated || row.unrated === "") &&
      conditions.every((holds) => holds(row)),
  );
}
