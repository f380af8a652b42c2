// How many drives ended in each way, by cause.

import { causeWords } from "../shared/outcomes";
import type { Run } from "./payload";

export interface Cause {
  outcome: string; words: string;
  count: number;
  /** A limit of the run ended these drives: they had neither arrived nor failed. */
  limit: boolean;
}

const LAST = ["goal_reached", "simulator_fault", "measured"];

/** Details that mean the same in words are one cause. The commonest first. */
export function causesOf(run: Run): Cause[] {
  const causes = new Map<string, Cause>();
  for (const { outcome, detail, count, limit = false } of endingsOf(run)) {
    const words = causeWords(outcome, detail);
    const key = `${outcome}: ${words}`;
    causes.set(key, { outcome, words, limit: limit || (causes.get(key)?.limit ?? false), count: (causes.get(key)?.count ?? 0) + count });
  }
  return [...causes.values()].sort((a, b) => b.count - a.count);
}

/** Those of drives that did not reach the goal. */
export const failuresOf = (run: Run): Cause[] => causesOf(run).filter(({ outcome }) => !LAST.includes(outcome));

function endingsOf(run: Run): Run["endings"] {
  if ((run.endings ?? []).length > 0) return run.endings;
  const outcomes = Object.entries((run.summary?.outcomes ?? {}) as Record<string, number>);
  return outcomes.filter(([, count]) => count > 0).map(([outcome, count]) => ({ outcome, detail: "", count, limit: outcome === "time_limit" }));
}
