// Columns of the trials as distributions: errors of dead reckoning, time and energy.

import { el } from "../../shared/dom";
import { counted, number } from "../../shared/format";
import type { Mark } from "../charts/axis";
import { chartFigure } from "../charts/figure";
import { binTable, drawHistograms, sampleOf, summaryTable, type Sample } from "../charts/histogram";
import type { Context, ShownRun } from "../context";
import type { PublishedRow } from "../payload";
import { partOfTrials } from "../prefix";
import { columnLabel, columnWords, unitText } from "../words";
import { publishedMarks } from "./published_marks";
import type { Section } from "./section";

interface Distribution {
  column: string;
  title: string;
  what: string;
  /** Beginning of the ids of published values, after the scenario's name. */
  published?: string;
  /** Drawn in a unit of its own: thousandths are hard to read. */
  drawn?: { factor: number; unit: string };
  /** The parameter that ends a trial at a value of this column, and what it is called. */
  limit?: { path: string; label: string; where: string };
  summary: (summary: Record<string, any>) => Record<string, number | null> | undefined;
}

const ERRORS: Distribution[] = [
  {
    column: "distance_error_percent", title: "Distance error", published: "distance_error",
    what: "dead-reckoned less true path length, in per cent of the true one; below zero the rover believed to have driven less than it had",
    summary: (summary) => summary.dead_reckoning?.distance_error_percent,
  },
  {
    column: "heading_error_deg", title: "Heading error", published: "heading_error",
    what: "size of the difference between believed and true heading at the end",
    summary: (summary) => summary.dead_reckoning?.heading_error_deg,
  },
  {
    column: "position_error_m", title: "Position error", published: "position_error",
    what: "distance between believed and true position at the end",
    summary: (summary) => summary.dead_reckoning?.position_error_m,
  },
];

const COSTS: Distribution[] = [
  {
    column: "sim_time_s", title: "Time", what: "simulated time of the whole trial", limit: { path: "referee.time_limit_s", label: "time limit", where: "the time limit is" },
    summary: (summary) => summary.sim_time_s,
  },
  {
    column: "energy_wh", title: "Energy", what: "taken from the batteries in the whole trial", limit: { path: "energy.battery_wh", label: "batteries empty", where: "the batteries are empty" },
    summary: (summary) => summary.energy_wh,
  },
  {
    column: "net_rate_m_s", title: "Net rate", what: "distance gained towards the goal over the time of the trial",
    drawn: { factor: 1000, unit: "mm/s" },
    summary: (summary) => summary.columns?.net_rate_m_s,
  },
];

function unitOf(shown: ShownRun, name: string): string {
  return shown.run.trials.columns.find((each) => each.name === name)?.unit ?? "";
}

function alternative(samples: Sample[], of: Distribution, unit: string): string {
  const parts = samples.map(({ shown }) => {
    const summary = of.summary(shown.run.summary ?? {});
    return `${shown.run.label}: median ${number(summary?.median)} ${unitText(unit)}, 90 % of trials from ${number(summary?.p05)} to ${number(summary?.p95)}`;
  });
  return `Histogram of the ${columnWords(of.column)}. ${parts.join("; ")}.`;
}

function isOf(row: PublishedRow, prefix: string | undefined): boolean {
  if (prefix === undefined) return false;
  return ["min", "mode", "mean", "max"].some((end) => row.id.endsWith(`.${prefix}.${end}`) || row.id === `${prefix}.${end}`);
}

// Of six digits, as the values are.
const NEARLY = 1 - 1e-5;

interface Reached {
  mark: Mark;
  /** How many trials of which run, in words. */
  text: string;
}

/** Limits that some trials came to: those make a spike, or a hump of their own beyond. */
function limitsReached(samples: Sample[], of: Distribution): Reached[] {
  return samples.flatMap(({ shown, values }) => {
    const limit = Number(shown.run.parameters?.find((each) => each.path === of.limit?.path)?.value);
    const count = values.filter((value) => value >= NEARLY * limit).length;
    if (!of.limit || !(limit > 0) || count === 0) return [];
    const label = `${of.limit.label} ${number(limit)}`;
    const run = samples.length > 1 ? `of ${shown.run.label} ` : "";
    return [{ mark: { x: limit, label }, text: `${number(count)} of ${counted(values.length, "trial")} ${run}lie at or beyond it` }];
  });
}

function figure(context: Context, of: Distribution): HTMLElement | null {
  const samples = context.drives().map((shown) => sampleOf(shown, of.column, of.drawn?.factor ?? 1)).filter((each): each is Sample => each !== null);
  const first = samples[0];
  if (!first) return null;
  const unit = unitOf(first.shown, of.column);
  const drawnUnit = of.drawn?.unit ?? unit;
  const reached = limitsReached(samples, of);
  const marks = [
    ...publishedMarks(samples.map((each) => each.shown.run), (row) => isOf(row, of.published), ""),
    ...new Map(reached.map(({ mark }) => [mark.label, mark])).values(),
  ];
  const limits = reached.length > 0 ? ` The dashed upright is where ${of.limit!.where}: ${reached.map(({ text }) => text).join(", ")}.` : "";
  return chartFigure({
    id: `histogram-${of.column}`,
    title: of.title,
    caption: `Share of trials by ${columnWords(of.column)}: ${of.what}.${limits}`,
    alternative: alternative(samples, of, unit),
    draw: (width) => drawHistograms(samples, marks, columnLabel(of.column, drawnUnit), width),
    numbers: () => {
      const rows = samples.flatMap(({ shown }) => {
        const summary = of.summary(shown.run.summary ?? {});
        return summary ? [{ label: shown.run.label, summary }] : [];
      });
      return [summaryTable(rows, columnLabel(of.column, unit)), binTable(samples, columnLabel(of.column, drawnUnit))];
    },
  });
}

const HOW_TO_READ =
  "Bars are shares of a run's trials, faults left out. Below them the dot is the median, and the line holds 90 % of the trials.";
const PUBLISHED = " Dashed uprights are the published minimum, mode and maximum, where there are any.";

function section(id: string, title: string, short: string, distributions: Distribution[]): Section {
  return {
    id,
    title,
    short,
    follows: true,
    render: (context) => {
      const figures = distributions.map((each) => figure(context, each));
      if (figures.every((each) => each === null)) return null;
      const part = partOfTrials(context.drives().map(({ run }) => run), " Bars are of");
      return [el("p", { class: "note" }, HOW_TO_READ + (id === "dead-reckoning" ? PUBLISHED : "") + part), el("div", { class: "chart-grid three" }, ...figures)];
    },
  };
}

export const deadReckoning = section("dead-reckoning", "Errors of dead reckoning", "Dead reckoning", ERRORS);
export const timeAndEnergy = section("time-energy", "Time and energy", "Time and energy", COSTS);
