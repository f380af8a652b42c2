// One drive of each outcome, neither the best nor the worst of it, as a small plan with a link to its replay.

import { breakable, type Child, el } from "../../shared/dom";
import { number, words } from "../../shared/format";
import { causeWords } from "../../shared/outcomes";
import { type Box, boxOf, drawPlan, type Place, trackLines } from "../charts/plan";
import type { Context } from "../context";
import type { Run, Track } from "../payload";
import { replayAnchor } from "../replay_link";
import { outcomeSwatch } from "../series";
import { detailOf, outcomeOf, trackOf, valueOf } from "../tracks";
import type { Section } from "./section";

const WIDTH = 320;
const HEIGHT = 200;
const MOST_RUNS = 2;

/** The plan of one trial; none where its track is not there. */
export function plan(run: Run, track: Track, box: Box): SVGSVGElement {
  const lines = trackLines(track);
  const outcome = outcomeOf(run, track.trial);
  const last = lines[lines.length - 1] ?? [];
  const rocks = Array.from({ length: track.rocks_cm.length / 3 }, (_, i) => {
    const [x, y, radius] = track.rocks_cm.slice(3 * i, 3 * i + 3).map((cm) => cm / 100);
    return { at: [x, y] as Place, radius: radius! };
  });
  const drawing = drawPlan({
    course: run.course!, box, rocks, lineWidth: 2,
    layers: [{ outcome, lines, ends: last.length > 0 ? [last[last.length - 1]!] : [] }],
  }, WIDTH, HEIGHT);
  drawing.setAttribute("role", "img");
  drawing.setAttribute("aria-label", `Plan of trial ${track.trial} of ${run.label}: ${words(outcome)}`);
  return drawing;
}

const shared = (run: Run, tracks: Track[]): Box => boxOf(run.course!, tracks.flatMap((track) => trackLines(track).flat()));

function card(run: Run, trial: number, box: Box): HTMLElement {
  const outcome = outcomeOf(run, trial);
  const track = trackOf(run, trial);
  const drawing = track && run.course ? plan(run, track, box) : null;
  const name = outcome === "goal_reached" ? "a median success" : words(outcome);
  const distance = valueOf(run, trial, "true_distance_m");
  return el("li", { class: "example", "data-trial": trial, "data-outcome": outcome },
    el("h4", {}, outcomeSwatch(outcome), name),
    drawing,
    el("p", {}, `Trial ${trial} ${causeWords(outcome, detailOf(run, trial))}, after `,
      el("span", { "data-value": distance }, `${number(distance, 3)} m`), "."),
    replayAnchor(run, trial, `: ${words(outcome)}`));
}

function cards(run: Run, titled: boolean): Child[] {
  const tracks = run.examples!.flatMap((trial) => trackOf(run, trial) ?? []);
  const box = tracks.length > 0 && run.course ? shared(run, tracks) : { x0: 0, x1: 1, y0: 0, y1: 1 };
  return [
    titled ? el("h3", {}, breakable(run.label)) : null,
    el("ul", { class: "examples" }, ...run.examples!.map((trial) => card(run, trial, box))),
  ];
}

export const examples: Section = {
  id: "examples",
  title: "One drive of each outcome",
  short: "Examples",
  render: (context: Context): Child[] | null => {
    const runs = context.runs.filter((run) => (run.examples ?? []).length > 0);
    if (runs.length === 0) return null;
    return [
      ...runs.slice(0, MOST_RUNS).flatMap((run) => cards(run, runs.length > 1)),
      el("p", { class: "note" }, "Of each outcome the trial whose distance is the median: neither its best nor its worst. Grey discs are rocks."),
    ];
  },
};
