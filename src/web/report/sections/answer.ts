// The answer first: how often drives of one run arrived, and why the others ended.

import { el, type Child } from "../../shared/dom";
import { number, percent, pointsInterval, words } from "../../shared/format";
import type { Context } from "../context";
import { failuresOf, type Cause } from "../endings";
import type { Run } from "../payload";
import type { Section } from "./section";

const exact = (value: unknown, text: string) => el("span", { "data-value": String(value) }, text);

const parameter = (run: Run, path: string): string => words((run.parameters ?? []).find((each) => each.path === path)?.value ?? "");

/** Rovers are named where the program knows their shape. */
const roverOf = (run: Run): string => run.course?.rover || "The rover";

function rate(of: any, first: boolean): Child {
  const [low, high] = of.ci95 ?? [null, null];
  return el("span", { class: "answer-rate" },
    el("strong", { "data-value": of.rate }, percent(of.rate, 0)),
    first ? el("span", {}, " of ", exact(of.trials, number(of.trials)), " drives") : null,
    el("span", { class: "answer-interval", "data-low": low, "data-high": high }, ` (${first ? "95 % interval " : ""}${pointsInterval(low, high, 0)})`));
}

function sentence(run: Run): HTMLElement {
  const { declared_success: declared, true_success: truly } = run.summary;
  return el("p", { class: "answer" },
    `${roverOf(run)} declared arrival in `, rate(declared, true), ", and truly was at the goal in ", rate(truly, false), ".");
}

// The last of five is named rather than called another way.
const NAMED_CAUSES = 4;

/** Drives that a limit ended have not failed: what they would have come to is told as a range. */
function limits(run: Run): HTMLElement | null {
  const ended = failuresOf(run).filter(({ limit }) => limit);
  const { count, trials } = run.summary.ended_by_limit ?? {};
  const [low, high] = run.summary.declared_success_without_limits ?? [];
  if (!count) return null;
  return el("p", { class: "answer-limits" },
    el("strong", { "data-value": count }, number(count)), ` of ${number(trials)} ended by a limit of the run before they had arrived or failed (`,
    ended.map(({ count: of, words: cause }) => `${number(of)} ${cause}`).join("; "), "). Without patience and time limit, between ",
    exact(low, percent(low, 0)), " and ", exact(high, percent(high, 0)), " of these drives declare arrival.");
}

function causes(run: Run): HTMLElement | null {
  const failures = failuresOf(run).filter(({ limit }) => !limit);
  const failed = failures.reduce((sum, { count }) => sum + count, 0);
  if (failed === 0 && failuresOf(run).length > 0) return null;
  if (failed === 0) return el("p", {}, "Every drive reached the goal.");
  const named = failures.length === NAMED_CAUSES + 1 ? NAMED_CAUSES + 1 : NAMED_CAUSES;
  const more = failures.slice(named).reduce((sum, { count }) => sum + count, 0);
  const part = ({ count, words: cause }: Cause, i: number): Child =>
    el("span", {}, i > 0 ? "; " : "", el("strong", { "data-value": count }, number(count)), ` ${cause}`);
  return el("p", { class: "answer-causes" },
    "Of the ", exact(failed, number(failed)), failed === 1 ? " drive that failed, " : " drives that failed, ",
    ...failures.slice(0, named).map(part),
    more > 0 ? el("span", {}, "; ", exact(more, number(more)), " ended in other ways") : null, ".");
}

/** What drove, over what; what is not known is left out. */
function how(run: Run): HTMLElement {
  const navigator = parameter(run, "navigation.navigator");
  const sensor = parameter(run, "sensors.terrain_sensor");
  const localization = words(String(run.summary.localization ?? ""));
  const parts = [
    `Scenario ${run.summary.scenario}`,
    navigator && `navigator ${navigator}`,
    sensor && `terrain sensor ${sensor}`,
    localization && `localization by ${localization}`,
  ].filter(Boolean);
  return el("p", { class: "note" }, `${parts.join(", ")}.`);
}

export const answer: Section = {
  id: "answer",
  title: "In short",
  render: (context: Context) => {
    const [run] = context.runs;
    if (context.runs.length !== 1 || !run?.summary?.declared_success?.trials) return null;
    return [sentence(run), limits(run), causes(run), how(run)];
  },
};
