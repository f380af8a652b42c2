// The title of the page, and what it is about in facts.

import { breakable, type Child, el } from "../../shared/dom";
import { counted, number, words } from "../../shared/format";
import { themeSwitch } from "../../shared/theme";
import type { Context } from "../context";
import type { Run, Sweep } from "../payload";
import { hasUnrated, ratedTrials } from "../prefix";
import type { Section } from "./section";

/** [planned, completed, faulted, pending], as far as the summary gives them. */
export function accounting(run: Run): { planned?: number; completed?: number; faulted?: number; pending?: number } {
  return run.summary?.accounting ?? run.summary?.trials ?? {};
}

function trialsText(run: Run): string {
  const { planned, completed, faulted, pending } = accounting(run);
  const parts = [`${number(completed)} of ${number(planned)} completed`];
  if (faulted) parts.push(counted(faulted, "simulator fault"));
  if (pending) parts.push(`${number(pending)} pending`);
  if (hasUnrated(run)) parts.push(`rates from the first ${number(ratedTrials(run))}`);
  return parts.join(", ");
}

function facts(entries: [string, Child][]): HTMLElement {
  return el("dl", { class: "facts" },
    ...entries
      .filter(([, value]) => value !== null && value !== undefined && value !== "")
      .map(([name, value]) => el("div", {}, el("dt", {}, name), el("dd", {}, value))));
}

/** What the scenario was changed by; null is "not known", of runs of older programs. */
function settingsText(settings: string[] | null | undefined): Child {
  if (!settings || settings.length === 0) return null;
  return breakable(settings.join(", "));
}

function runFacts(run: Run): HTMLElement {
  const summary = run.summary ?? {};
  const ablations: string[] = summary.ablations ?? [];
  return facts([
    ["Scenario", summary.scenario],
    ["Changed settings", settingsText(summary.settings)],
    ["Seed", summary.seed === undefined ? null : String(summary.seed)],
    ["Trials", trialsText(run)],
    ["Localization", run.kind === "measurement" ? null : words(String(summary.localization ?? ""))],
    ["Simulated as perfect", ablations.map(words).join(", ")],
    ["Trial hash", el("code", {}, summary.trial_hash ?? "")],
    ["Build", [summary.provenance?.version, summary.provenance?.commit].filter(Boolean).join(" ")],
  ]);
}

function sumOf(runs: Run[], name: "planned" | "completed" | "faulted" | "pending"): number {
  return runs.reduce((sum, run) => sum + (accounting(run)[name] ?? 0), 0);
}

function manyFacts(runs: Run[], sweeps: Sweep[]): HTMLElement {
  const alone = runs.filter((run) => run.sweep === null || run.sweep === undefined).length;
  const builds = new Set(runs.map((run) => run.summary?.provenance?.commit).filter(Boolean));
  return facts([
    ["Campaigns", sweeps.map((sweep) => sweep.label).join(", ")],
    ["Runs", alone > 0 ? number(alone) : null],
    ["Cells", runs.length - alone > 0 ? number(runs.length - alone) : null],
    ["Trials", `${number(sumOf(runs, "completed"))} of ${number(sumOf(runs, "planned"))} completed`],
    ["Simulator faults", sumOf(runs, "faulted") > 0 ? number(sumOf(runs, "faulted")) : null],
    ["Pending", sumOf(runs, "pending") > 0 ? number(sumOf(runs, "pending")) : null],
    ["In the rates", runs.some(hasUnrated) ? `the first ${number(runs.reduce((sum, run) => sum + ratedTrials(run), 0))} of the runs` : null],
    ["Builds", [...builds].join(", ")],
  ]);
}

/** Of one run all that tells it from others, of several their numbers. */
function pageFacts({ runs, payload }: Context): HTMLElement {
  return runs.length === 1 ? runFacts(runs[0]!) : manyFacts(runs, payload.sweeps ?? []);
}

export function pageHeader({ payload }: Context): HTMLElement {
  return el("header", { class: "page-header" },
    el("div", { class: "title-row" }, el("h1", {}, payload.title || "rockyard report"), themeSwitch()));
}

// ---- What was run: the facts of a run or of all of them.

export const about: Section = {
  id: "about",
  title: "What was run",
  render: (context: Context) => (context.runs.length > 0 ? [pageFacts(context)] : null),
};
