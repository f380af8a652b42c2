// Which trials the rates are of. After a gap (a trial that is still to be run) a run may hold more
// trials; those that ended early are too many among them, so that they are in no rate. Of a run of
// very many trials the page holds a part.

import { number } from "../shared/format";
import type { Run } from "./payload";

const shownTrials = (run: Run): number => run.trials?.trial?.length ?? 0;

/** So many trials are in the rates. */
export function ratedTrials(run: Run): number { return run.prefix_trials ?? shownTrials(run); }

/** So many trials at the beginning of the table are in the rates. */
export function ratedRows(run: Run): number {
  const rated = ratedTrials(run);
  const beyond = (run.trials?.trial ?? []).findIndex((trial) => trial >= rated);
  return beyond < 0 ? shownTrials(run) : beyond;
}

/** True where the table holds trials that are in no rate. */
export function hasUnrated(run: Run): boolean { return ratedRows(run) < shownTrials(run); }

/** What has to be said where the page holds a part of the trials; "" where it holds all. */
export function partOfTrials(runs: Run[], what: string): string {
  const parts = runs
    .filter((run) => (run.stored_trials ?? 0) > shownTrials(run))
    .map((run) => `${number(shownTrials(run))} of ${number(run.stored_trials)} trials of ${run.label}`);
  if (parts.length === 0) return "";
  return `${what} ${parts.join(", ")}, at equal steps of their numbers; all are in trials.csv, and in every rate, mean, interval and curve of this page.`;
}
