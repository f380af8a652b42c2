// Runs that were ended by looking at their rate: rule, end and the interval that allows for it.

import { number, percent } from "../shared/format";
import type { Run } from "./payload";

/** As in summary.json. */
export interface Stopping {
  half_width: number;
  max_trials: number;
  block: number;
  confidence: number;
  end: string;
  trials: number;
  declared_success: { count: number; trials: number };
  /** Of declared success at the last look. */
  interval: [number, number];
}

const ENDS: Record<string, string> = {
  precise: "precise enough",
  max_trials: "ended at the most trials, not precise enough",
  budget: "ended when the budget was used up, not precise enough",
};

export function stoppingOf(run: Run): Stopping | undefined {
  return run.summary?.stopping ?? undefined;
}

/** Rule, looks and end in words. */
export function stoppingText(of: Stopping): string {
  const { count, trials } = of.declared_success;
  return (
    `Run until the interval of declared success was as narrow as ± ${percent(of.half_width)}, looked at every ${number(of.block)} trials, ` +
    `${number(of.max_trials)} at most: ${ENDS[of.end] ?? "not yet precise enough"} after ${number(of.trials)}, of which ` +
    `${number(count)} of ${number(trials)} were successful. Intervals of both success rates allow for that rule; ` +
    "all others on this page take the number of trials as fixed beforehand, which it was not."
  );
}
