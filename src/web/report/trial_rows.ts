// Trials of all runs as rows of one table.

import { isNumber, words } from "../shared/format";
import type { Run } from "./payload";
import { ratedRows } from "./prefix";
import { replayLink } from "./replay_link";
import { columnWords } from "./words";

export interface TrialRow {
  run: string;
  trial: number;
  outcome: string; detail: string;
  /** Link of its replay page, or "". */
  replay: string;
  /** Index of its run. */
  of: number;
  /** "", or that the trial is in no rate. */
  unrated: string;
  /** Values by column name: field names are "v_" + name, so that no name can hide another member. */
  [value: `v_${string}`]: number | null;
}

export interface ColumnInfo { name: string; unit: string }

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

// ---- The conditions by which some trials are shown, and what is wrong with those that say nothing.

interface TrialFilter { text: string; run: string; outcome: string; onlyReplays: boolean; onlyRated: boolean }

interface Found {
  rows: TrialRow[];
  /** Words of the search that could not be understood, each with the reason; they ask for nothing. */
  problems: string[];
}

const OPERATORS: Record<string, (a: number, b: number) => boolean> = {
  "<": (a, b) => a < b,
  ">": (a, b) => a > b,
  "<=": (a, b) => a <= b,
  ">=": (a, b) => a >= b,
  "=": (a, b) => a === b,
};
const OPERATOR = /<=|>=|<|>|=/;
const NUMBER = /^[-−]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i;
const TEXTS = ["outcome", "detail", "run"] as const;

type Condition = (row: TrialRow) => boolean;

const holdsWord = (text: string, wanted: string) => text.toLowerCase().includes(wanted) || words(text).toLowerCase().includes(wanted);

// By its name in trials.csv, or as its title has it, with _ for a blank.
function fieldNamed(name: string, columns: ColumnInfo[]): "trial" | `v_${string}` | null {
  if (name === "trial") return "trial";
  const called = (of: (column: ColumnInfo) => string) => columns.find((each) => of(each).toLowerCase() === name);
  const column = called((each) => each.name) ?? called((each) => columnWords(each.name).replaceAll(" ", "_"));
  return column ? fieldOf(column.name) : null;
}

// "energy_wh>20" compares a column, "outcome=jammed" a text; any other word is looked for in all texts.
function condition(word: string, columns: ColumnInfo[]): Condition | string {
  const operator = OPERATOR.exec(word)?.[0];
  const [name = "", limit = ""] = operator === undefined ? [] : word.toLowerCase().split(operator);
  if (operator === undefined) {
    const wanted = word.toLowerCase();
    return (row) =>
      String(row.trial) === wanted || [row.run, row.outcome, row.unrated, row.detail].some((text) => holdsWord(text, wanted));
  }
  const text = TEXTS.find((each) => each === name);
  if (text && operator === "=" && limit !== "") return (row) => holdsWord(row[text], limit);
  const field = fieldNamed(name, columns);
  if (field === null) return `there is no column “${name}”: see Columns, or a word without ${operator}`;
  if (!NUMBER.test(limit)) return `${name}${operator} needs a number`;
  const bound = Number(limit.replace("−", "-"));
  return (row) => {
    const value = row[field];
    return isNumber(value) && OPERATORS[operator]!(value, bound);
  };
}

/** The rows that meet every word of the text and every choice. */
export function matching(rows: TrialRow[], columns: ColumnInfo[], filter: TrialFilter): Found {
  const searched = filter.text.trim().replace(/\s*(<=|>=|<|>|=)\s*/g, "$1");
  const read = searched.split(/\s+/).filter(Boolean).map((word) => condition(word, columns));
  const conditions = read.filter((each): each is Condition => typeof each !== "string");
  const kept = rows.filter(
    (row) =>
      (filter.run === "" || row.run === filter.run) &&
      (filter.outcome === "" || row.outcome === filter.outcome) &&
      (!filter.onlyReplays || row.replay !== "") &&
      (!filter.onlyRated || row.unrated === "") &&
      conditions.every((holds) => holds(row)),
  );
  return { rows: kept, problems: read.filter((each): each is string => typeof each === "string") };
}
