// How trials ended, and by which cause. Every count is a button that shows its trials in the table.

import { breakable, button, el, type Child } from "../../shared/dom";
import { number, percent, words } from "../../shared/format";
import { outcomeSentence } from "../../shared/outcomes";
import { type Cell, numeric, rowHeader, table } from "../../shared/table";
import type { Context } from "../context";
import { causesOf } from "../endings";
import type { Run } from "../payload";
import { hasUnrated } from "../prefix";
import type { Section } from "./section";

type Counts = Record<string, number>;

const countsOf = (run: Run): Counts => run.summary?.outcomes ?? {};

const total = (run: Run) => Object.values(countsOf(run)).reduce((sum, count) => sum + count, 0);

// A hatch for each outcome, so that bars differ without their colour.
const TONES: Record<string, string> = { goal_reached: "good", false_goal: "doubtful", simulator_fault: "fault" };

function bar(share: number, outcome: string): HTMLElement {
  return el("span", { class: "share-bar", "aria-hidden": "true" },
    share > 0 && el("span", { class: `share ${TONES[outcome] ?? "failed"}`, style: `width:${(100 * share).toFixed(2)}%` }));
}

function countButton(context: Context, run: Run, outcome: string): HTMLElement | string {
  const count = countsOf(run)[outcome] ?? 0;
  if (count === 0) return el("span", { class: "count-none" }, "0");
  return button([number(count), el("span", { class: "visually-hidden" }, ` trials: show ${words(outcome)} of ${run.label} in the table`)],
    "Show these trials in the table", () => context.showTrials({ run: run.label, outcome, onlyRated: hasUnrated(run) }),
    { class: "count", "data-outcome": outcome, "data-run": run.label, "data-value": count });
}

function occurring(runs: Run[]): string[] {
  const names = [...new Set(runs.flatMap((run) => Object.keys(countsOf(run))))];
  return names.filter((name) => runs.some((run) => (countsOf(run)[name] ?? 0) > 0));
}

/** What the drives of an outcome did; with counts where it was not one thing. */
function causes(run: Run, outcome: string): Child {
  const found = causesOf(run).filter((cause) => cause.outcome === outcome);
  if (found.length === 0) return outcomeSentence(outcome);
  if (found.length === 1) return el("span", { "data-cause-count": found[0]!.count }, sentenceOf(found[0]!.words));
  return el("ul", { class: "causes" }, ...found.map(({ count, words: cause }) =>
    el("li", { "data-cause-count": count }, `${number(count)} ${cause}`)));
}

const sentenceOf = (text: string) => `${text[0]!.toUpperCase()}${text.slice(1)}.`;

function oneRun(context: Context, run: Run): HTMLElement {
  const trials = total(run);
  return table({
    caption: "How the trials ended",
    className: "one-run",
    stacks: true,
    head: ["Outcome", numeric("Trials"), numeric("Share"), "", "What the drives did"],
    rows: occurring([run]).sort((a, b) => countsOf(run)[b]! - countsOf(run)[a]!).map((name) => {
      const count = countsOf(run)[name] ?? 0;
      return [
        rowHeader(words(name)),
        numeric(countButton(context, run, name), count),
        numeric(percent(count / trials), count / trials),
        bar(count / trials, name),
        causes(run, name),
      ];
    }),
  });
}

function cell(context: Context, run: Run, outcome: string): Cell {
  const count = countsOf(run)[outcome] ?? 0;
  const content = el("div", { class: "outcome-cell" }, countButton(context, run, outcome), bar(count / (total(run) || 1), outcome));
  return { content, value: count };
}

function manyRuns(context: Context, runs: Run[]): Child[] {
  const names = occurring(runs);
  return [
    table({
      caption: "How the trials of each run ended",
      head: ["Run", ...names.map(words)],
      rows: runs.map((run): (Child | Cell)[] => [rowHeader(breakable(run.label)), ...names.map((name) => cell(context, run, name))]),
    }),
    el("dl", { class: "meanings" },
      ...names.map((name) => el("div", {}, el("dt", {}, words(name)), el("dd", {}, outcomeSentence(name))))),
  ];
}

export const outcomes: Section = {
  id: "outcomes",
  title: "Why drives ended",
  short: "Outcomes",
  render: (context: Context) => {
    const runs = context.runs.filter((run) => run.kind !== "measurement" && total(run) > 0);
    if (runs.length === 0) return null;
    return [
      ...(runs.length === 1 ? [oneRun(context, runs[0]!)] : manyRuns(context, runs)),
      el("p", { class: "note" }, "A bar is the share of the run's trials. A count shows its trials in the table of trials."),
    ];
  },
};
