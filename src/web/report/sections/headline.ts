// Success of every run with its interval.

import { breakable, type Child, el } from "../../shared/dom";
import { MISSING, number, percent, percentInterval } from "../../shared/format";
import { type Cell, numeric, rowHeader, table } from "../../shared/table";
import { rateBar } from "../charts/glyphs";
import type { Context } from "../context";
import { failuresOf } from "../endings";
import type { Run } from "../payload";
import { hasUnrated, ratedTrials } from "../prefix";
import { methodName, SHARED_LAYOUTS } from "../words";
import { accounting } from "./header";
import type { Section } from "./section";

interface Rate {
  count: number; trials: number;
  rate: number | null;
  ci95: [number | null, number | null];
  ci_method?: string;
}

function rateCells(rate: Rate | undefined): Cell[] {
  if (!rate) return [{ content: MISSING }, { content: "" }];
  const [low, high] = rate.ci95 ?? [null, null];
  const text = el("div", { class: "rate" },
    el("strong", { "data-value": rate.rate }, percent(rate.rate)),
    el("span", { class: "of" }, `${number(rate.count)} of ${number(rate.trials)}`));
  const bar = el("div", { class: "rate-drawn" },
    rateBar(rate.rate, low, high),
    el("span", { class: "of", "data-low": low, "data-high": high }, percentInterval(low, high)));
  return [numeric(text, rate.rate), { content: bar }];
}

function commonest(run: Run): Cell {
  const [first] = failuresOf(run);
  return { content: first ? `${first.words} (${number(first.count)}${first.limit ? ", by a limit of the run" : ""})` : "none" };
}

function trialsCell(run: Run): Cell {
  const { planned, completed, faulted, pending } = accounting(run);
  const notes: Child[] = [];
  if (faulted) notes.push(el("span", { class: "of" }, `${number(faulted)} faulted`));
  if (pending) notes.push(el("span", { class: "of" }, `${number(pending)} pending of ${number(planned)}`));
  if (hasUnrated(run)) notes.push(el("span", { class: "of" }, `rates from the first ${number(ratedTrials(run))}`));
  return numeric(el("div", { class: "rate" }, el("span", {}, number(completed)), ...notes), completed);
}

function row(run: Run): (Child | Cell)[] {
  const distance = run.summary?.distance_m?.median;
  return [
    rowHeader(breakable(run.label)),
    trialsCell(run),
    ...rateCells(run.summary?.declared_success),
    ...rateCells(run.summary?.true_success),
    numeric(number(distance, 3), distance),
    commonest(run),
  ];
}

function methods(runs: Run[]): string {
  const names = new Set(runs.flatMap((run) => [run.summary?.declared_success?.ci_method, run.summary?.true_success?.ci_method]));
  const known = [...names].filter(Boolean).map(methodName);
  return known.length > 0 ? ` (${known.join(" and ")})` : "";
}

// What a reader must know before believing the table.
function cautions(runs: Run[]): Child[] {
  const several = runs.length > 1;
  const caution = (run: Run, text: string) =>
    el("p", { class: "note caution", role: "note" }, several ? el("strong", {}, breakable(run.label), ": ") : null, text);
  return runs.flatMap((run) => {
    const stopping = stoppingOf(run);
    return [
      stopping ? caution(run, stoppingText(stopping)) : null,
      run.shared_layouts ? caution(run, SHARED_LAYOUTS) : null,
      hasUnrated(run)
        ? caution(run, `Rates, curves and distributions are of the first ${number(ratedTrials(run))} trials, up to one that is still to be run. ` +
            "Those that are stored beyond it are in the table of trials alone: they would favour what ends early.")
        : null,
    ];
  });
}

export const headline: Section = {
  id: "headline",
  title: "Success",
  render: (context: Context) => {
    const runs = context.runs.filter((run) => run.summary?.declared_success);
    if (runs.length === 0) return null;
    return [
      table({
        caption: "Success of each run",
        className: "headline-table",
        stacks: true,
        head: [
          "Run", numeric("Trials"), numeric("Declared success"), "Declared, 95 % interval", numeric("True success"), "True, 95 % interval",
          numeric("Median distance [m]"), "Commonest other end",
        ],
        rows: runs.map(row),
      }),
      el("p", { class: "note" },
        "Declared: the rover believed that it was at its goal, which is how the published runs were judged. True: it also " +
          `was there. Bars run from 0 to 100 %: the dot is the rate, the bar its 95 % interval${methods(runs)}. ` +
          "Simulator faults are in no rate."),
      ...cautions(runs),
    ];
  },
};

// ---- Runs that were ended by looking at their rate: rule, end and the interval that allows for it.

/** As in summary.json. */
interface Stopping {
  half_width: number; max_trials: number; block: number; confidence: number;
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

function stoppingOf(run: Run): Stopping | undefined { return run.summary?.stopping ?? undefined; }

/** Rule, looks and end in words. */
function stoppingText(of: Stopping): string {
  const { count, trials } = of.declared_success;
  return (
    `Run until the interval of declared success was as narrow as ± ${percent(of.half_width)}, looked at every ${number(of.block)} trials, ` +
    `${number(of.max_trials)} at most: ${ENDS[of.end] ?? "not yet precise enough"} after ${number(of.trials)}, of which ` +
    `${number(count)} of ${number(trials)} were successful. Intervals of both success rates allow for that rule; ` +
    "all others on this page take the number of trials as fixed beforehand, which it was not."
  );
}
