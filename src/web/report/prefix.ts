// Which trials the rates are of. After a gap (a trial that is still to be run) a run may hold more
// trials; those that ended early are too many among them, so that they are in no rate.

import type { Run } from "./payload";

const storedTrials = (run: Run): number => run.trials?.trial?.length ?? 0;

/** So many trials at the beginning of the table are in the rates. */
export function ratedTrials(run: Run): number {
  return run.prefix_trials ?? storedTrials(run);
}

/** True where the table holds trials that are in no rate. */
export function hasUnrated(run: Run): boolean {
  return ratedTrials(run) < storedTrials(run);
}
