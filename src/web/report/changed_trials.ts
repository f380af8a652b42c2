// Trials of two runs with the same seed that ended in another way.

import type { Run } from "./payload";
import { trackOf } from "./tracks";

export interface Change {
  first: string;
  second: string;
  /** In the order of their numbers. */
  trials: number[];
}

/** The trials that both runs hold in their rates, and those of them that ended otherwise; the commonest change first. */
export function changesOf(first: Run, second: Run): { compared: number; changes: Change[] } {
  const ends = outcomesOf(first);
  const changes = new Map<string, Change>();
  let compared = 0;
  for (const [trial, outcome] of outcomesOf(second)) {
    const before = ends.get(trial);
    if (before === undefined) continue;
    ++compared;
    if (before === outcome) continue;
    const key = `${before} ${outcome}`;
    if (!changes.has(key)) changes.set(key, { first: before, second: outcome, trials: [] });
    changes.get(key)!.trials.push(trial);
  }
  return { compared, changes: [...changes.values()].sort((a, b) => b.trials.length - a.trials.length) };
}

function outcomesOf(run: Run): Map<number, string> {
  const rated = run.prefix_trials ?? Infinity;
  const ends = (run.trials?.trial ?? []).map((trial, row): [number, string] =>
    [trial, run.trials.outcome_names[run.trials.outcome[row]!] ?? ""]);
  return new Map(ends.filter(([trial, outcome]) => trial < rated && outcome !== "simulator_fault"));
}

/** Of the commonest changes one trial each whose tracks both runs have. */
export function drawnChanges(first: Run, second: Run, changes: Change[], most: number): number[] {
  return changes
    .flatMap(({ trials }) => trials.find((trial) => trackOf(first, trial) && trackOf(second, trial)) ?? [])
    .slice(0, most);
}
