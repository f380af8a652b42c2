// Two runs in short: in which settings they differ, and what became of it.

import { breakable, type Child, el } from "../../shared/dom";
import { counted, interval, isNumber, number, percent, points, pointsInterval, pValue, words } from "../../shared/format";
import { causeWords } from "../../shared/outcomes";
import { rowHeader, table } from "../../shared/table";
import { boxOf, trackLines } from "../charts/plan";
import type { Context } from "../context";
import type { Comparison, Run } from "../payload";
import { replayAnchor } from "../replay_link";
import { detailOf, outcomeOf, trackOf } from "../tracks";
import { columnWords, unitText } from "../words";
import { plan } from "./examples";
import type { Section } from "./section";

const SIGNIFICANT = 0.05;
const MOST_SETTINGS = 8;
const MOST_CHANGES = 5;
const MOST_PAIRS = 3;
const MOST_MEANS = 4;

function settings(of: Comparison): HTMLElement {
  const rows = of.settings ?? [];
  if (rows.length === 0) return el("p", {}, "No setting differs.");
  const content = table({
    caption: `Settings in which ${of.second} differs from ${of.first}`,
    className: "settings-table",
    head: ["Setting", of.first, of.second],
    rows: rows.map((row) => [rowHeader(el("code", {}, row.path)), breakable(row.first), breakable(row.second)]),
  });
  const title = `${counted(rows.length, "setting")} ${rows.length === 1 ? "differs" : "differ"}`;
  if (rows.length <= MOST_SETTINGS) return el("div", {}, el("p", { class: "changes-lead" }, `${title}:`), content);
  return el("details", { class: "numbers" }, el("summary", {}, title), content);
}

/** "rose by 3.0 points (...)", or that nothing is shown. */
function verdict(of: Comparison, row: Comparison["successes"][number]): HTMLElement | null {
  if (!isNumber(row.difference) || !isNumber(row.first) || !isNumber(row.second)) return null;
  const known = isNumber(row.p);
  const differs = known && row.p! < SIGNIFICANT;
  const moved = row.difference === 0 ? "stayed the same" : `${row.difference > 0 ? "rose" : "fell"} by ${points(Math.abs(row.difference))} points`;
  const meaning = !known ? "whether by chance is not known" : differs ? "more than chance would do" : "which chance alone might do";
  return el("li", { class: differs ? "differs" : null },
    `${row.what[0]!.toUpperCase()}${row.what.slice(1)} `, el("strong", { "data-value": row.difference }, moved),
    el("span", { "data-low": row.low, "data-high": row.high }, ` (difference ${pointsInterval(row.low, row.high)}`),
    `), from ${percent(row.first)} of ${of.first} to ${percent(row.second)} of ${of.second}: `,
    el("em", {}, meaning), known ? ` (p ${pValue(row.p)})` : "", ".");
}

const CLEAR = ["true_distance_m", "sim_time_s", "energy_wh", "hazards_believed", "turns_in_place", "scrapes", "position_error_m"];

function means(of: Comparison): HTMLElement | null {
  const clear = of.columns
    .filter((row) => row.trials === "all" && CLEAR.includes(row.name) && isNumber(row.low) && isNumber(row.high) && (row.low > 0 || row.high < 0))
    .slice(0, MOST_MEANS);
  if (clear.length === 0) return null;
  const unit = (text: string) => (text === "" || text === "1" ? "" : ` ${unitText(text)}`);
  return el("li", {}, "Of the means, ", ...clear.map((row, i) => el("span", {}, i > 0 ? "; " : "",
    `${columnWords(row.name)} ${row.difference! > 0 ? "grew" : "fell"} from ${number(row.first, 3)} to ${number(row.second, 3)}${unit(row.unit)} `,
    el("span", { "data-value": row.difference }, `(difference ${interval(row.low, row.high)})`))), ".");
}

function changeList(of: Comparison, changes: Change[]): Child {
  return el("ul", { class: "change-list" }, ...changes.slice(0, MOST_CHANGES).map(({ first, second, trials }) =>
    el("li", {}, el("strong", { "data-value": trials.length }, number(trials.length)), ` ${words(first)} in `, breakable(of.first), `, ${words(second)} in `, breakable(of.second))));
}

function side(run: Run, trial: number, box: ReturnType<typeof boxOf>): HTMLElement {
  return el("figure", { class: "pair-side" }, plan(run, trackOf(run, trial)!, box),
    el("figcaption", {}, el("strong", {}, breakable(run.label)), `: ${causeWords(outcomeOf(run, trial), detailOf(run, trial))}. `,
      replayAnchor(run, trial, ` of ${run.label}`)));
}

function pair(first: Run, second: Run, trial: number): HTMLElement {
  const places = [first, second].flatMap((run) => trackLines(trackOf(run, trial)!).flat());
  const box = boxOf(first.course!, places);
  return el("div", { class: "pair", "data-trial": trial }, el("h4", {}, `Trial ${trial}`),
    el("div", { class: "pair-sides" }, side(first, trial, box), side(second, trial, box)));
}

function changedTrials(of: Comparison, first: Run | undefined, second: Run | undefined): Child[] {
  if (!first || !second) return [];
  const { compared, changes } = changesOf(first, second);
  const changed = changes.reduce((sum, { trials }) => sum + trials.length, 0);
  if (compared === 0) return [];
  const drawn = first.course && second.course ? drawnChanges(first, second, changes, MOST_PAIRS) : [];
  return [
    el("p", { class: "changed-count" }, el("strong", { "data-value": changed }, number(changed)), ` of ${counted(compared, "trial")} with the same seed ended in another way.`),
    changed > 0 ? changeList(of, changes) : null,
    drawn.length > 0 ? el("p", { class: "note" }, "One trial of each of the commonest changes, in both runs:") : null,
    drawn.length > 0 ? el("div", { class: "pairs" }, ...drawn.map((trial) => pair(first, second, trial))) : null,
  ];
}

function content(context: Context, of: Comparison): Child[] {
  const run = (label: string) => context.runs.find((each) => each.label === label);
  return [
    el("h3", {}, `${of.second} against ${of.first}`),
    settings(of),
    el("ul", { class: "verdicts" }, ...of.successes.map((row) => verdict(of, row)), means(of)),
    ...(of.paired ? changedTrials(of, run(of.first), run(of.second)) : []),
  ];
}

export const changes: Section = {
  id: "changes",
  title: "What differs",
  render: (context: Context) => {
    const all = context.payload.comparisons ?? [];
    return all.length === 0 ? null : [
      ...all.flatMap((of) => content(context, of)),
      el("p", { class: "note" }, "Values in brackets are 95 % intervals of differences. All differences, and how they were tested, are further below."),
    ];
  },
};

// ---- Trials of two runs with the same seed that ended in another way.

interface Change {
  first: string; second: string;
  /** In the order of their numbers. */
  trials: number[];
}

/** The trials that both runs hold in their rates, and those of them that ended otherwise; the commonest change first. */
function changesOf(first: Run, second: Run): { compared: number; changes: Change[] } {
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
function drawnChanges(first: Run, second: Run, changes: Change[], most: number): number[] {
  return changes
    .flatMap(({ trials }) => trials.find((trial) => trackOf(first, trial) && trackOf(second, trial)) ?? [])
    .slice(0, most);
}
