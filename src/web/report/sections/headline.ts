// Success of every run with its interval.

import { breakable, el, type Child } from "../../shared/dom";
import { MISSING, number, percent, percentInterval } from "../../shared/format";
import { numeric, rowHeader, table, type Cell } from "../../shared/table";
import { rateBar } from "../charts/glyphs";
import type { Context } from "../context";
import { failuresOf } from "../endings";
import type { Run } from "../payload";
import { methodName, SHARED_LAYOUTS } from "../words";
import { hasUnrated, ratedTrials } from "../prefix";
import { stoppingOf, stoppingText } from "../stopping";
import { accounting } from "./header";
import type { Section } from "./section";

interface Rate {
  count: number;
  trials: number;
  rate: number | null;
  ci95: [number | null, number | null];
  ci_method?: string;
}

function rateCells(rate: Rate | undefined): Cell[] {
  if (!rate) return [{ content: MISSING }, { content: "" }];
  const [low, high] = rate.ci95 ?? [null, null];
  const text = el(
    "div",
    { class: "rate" },
    el("strong", { "data-value": rate.rate }, percent(rate.rate)),
    el("span", { class: "of" }, `${number(rate.count)} of ${number(rate.trials)}`),
  );
  const bar = el(
    "div",
    { class: "rate-drawn" },
    rateBar(rate.rate, low, high),
    el("span", { class: "of", "data-low": low, "data-high": high }, percentInterval(low, high)),
  );
  return [{ content: text, numeric: true, value: rate.rate }, { content: bar }];
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
  return { content: el("div", { class: "rate" }, el("span", {}, number(completed)), ...notes), numeric: true, value: completed };
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
  short: "Success",
  render: (context: Context) => {
    const runs = context.runs.filter((run) => run.summary?.declared_success);
    if (runs.length === 0) return null;
    return [
      table({
        caption: "Success of each run",
        className: "headline-table",
        stacks: true,
        head: [
          "Run",
          { content: "Trials", numeric: true },
          { content: "Declared success", numeric: true },
          "Declared, 95 % interval",
          { content: "True success", numeric: true },
          "True, 95 % interval",
          { content: "Median distance [m]", numeric: true },
          "Commonest other end",
        ],
        rows: runs.map(row),
      }),
      el(
        "p",
        { class: "note" },
        "Declared: the rover believed that it was at its goal, which is how the published runs were judged. True: it also " +
          `was there. Bars run from 0 to 100 %: the dot is the rate, the bar its 95 % interval${methods(runs)}. ` +
          "Simulator faults are in no rate.",
      ),
      ...cautions(runs),
    ];
  },
};
