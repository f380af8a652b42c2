// The mark of each kind of event: a shape and a colour of its own.

import { el, svg } from "../../shared/dom";
import type { Run } from "../events";
import { clock } from "../format";
import type { TrialEvent } from "../payload";

interface Look {
  /** About (0, 0), some 10 wide. */
  path: string;
  /** A variable of the style sheet. */
  colour: string;
}

const LOOKS: Record<string, Look> = {
  scan: { path: "M-1-5h2v10h-2z", colour: "--series-6" },
  look: { path: "M-1-5h2v10h-2z", colour: "--series-6" },
  hazard: { path: "M0-5 5 4h-10z", colour: "--series-2" },
  chosen: { path: "M0-5 4 0 0 5-4 0z", colour: "--series-3" },
  turn: { path: "M-4 0a4 4 0 1 1 8 0a4 4 0 1 1-8 0M-2 0a2 2 0 1 0 4 0a2 2 0 1 0-4 0", colour: "--series-1" },
  felt: { path: "M0-5 1.5-1.5 5 0 1.5 1.5 0 5-1.5 1.5-5 0-1.5-1.5z", colour: "--series-5" },
  scrape: { path: "M-4-5 0-1 4-5 5-4 1 0 5 4 4 5 0 1-4 5-5 4-1 0-5-4z", colour: "--series-4" },
  stall: { path: "M-4-4h8v8h-8z", colour: "--bad" },
  reflection: { path: "M-3-5h2v10h-2zM1-5h2v10h-2z", colour: "--series-4" },
  end: { path: "M-3-5h7l-2 2.5 2 2.5h-5.5v5h-1.5z", colour: "--text" },
};

const OTHER: Look = { path: "M-3 0a3 3 0 1 1 6 0a3 3 0 1 1-6 0", colour: "--muted" };

export function markOf(kind: string): Look { return LOOKS[kind] ?? OTHER; }

interface Band { colour: string; height: number }

/** Activities differ in height too: what moves is high, what stands low. */
function bandOf(activity: string): Band {
  const bands: Record<string, Band> = {
    drive: { colour: "--series-1", height: 16 },
    turn: { colour: "--series-3", height: 12 },
    steer: { colour: "--series-4", height: 10 },
    scan: { colour: "--series-6", height: 6 },
    image: { colour: "--series-6", height: 6 },
    compute: { colour: "--series-5", height: 5 },
    overhead: { colour: "--line-strong", height: 3 },
    stall: { colour: "--bad", height: 8 },
  };
  return bands[activity] ?? { colour: "--muted", height: 4 };
}

// ---- What the rover did, as a band along the time line: each activity has a colour and a height.

/** The key of the band. */
export function activityKey(runs: Run[]): HTMLElement {
  const key = el("p", { class: "activity-key" }, "Activity: ");
  for (const name of new Set(runs.map((run) => run.activity))) {
    const { colour, height } = bandOf(name);
    const band = svg("rect", { x: 0, y: 16 - height, width: 12, height, style: `fill: var(${colour})` });
    key.append(el("span", {}, svg("svg", { viewBox: "0 0 12 16", width: 12, height: 16, "aria-hidden": "true" }, band), name));
  }
  return key;
}

/** The band itself: it stands on `bottom`; `place` is where a time is drawn. */
export function activityBand(runs: Run[], place: (t: number) => number, bottom: number): SVGRectElement[] {
  return runs.map(({ from, to, activity }) => {
    const { colour, height } = bandOf(activity);
    const x = place(from);
    return svg("rect", { x, y: bottom - height, width: Math.max(0.75, place(to) - x), height, style: `fill: var(${colour})` },
      svg("title", {}, `${activity}, ${clock(from)} to ${clock(to)}`));
  });
}

// ---- Walking along the marks of the time line by keys: left and right along a row, up and down between
// rows. One stop of the Tab key for all marks.

export interface Mark { event: TrialEvent; element: SVGGElement }

/** Makes the first mark the one that the Tab key stops at. */
export function startWalk(marks: Mark[]): void { marks[0]?.element.setAttribute("tabindex", "0"); }

/** Goes where the key says; true where it was a key of the walk. */
export function walk(marks: Mark[], key: string, go: (event: TrialEvent) => void): boolean {
  const at = marks.findIndex(({ element }) => element === document.activeElement);
  const here = marks[at];
  if (!here) return false;
  const goal = next(marks, at, key);
  if (goal) {
    here.element.setAttribute("tabindex", "-1");
    goal.element.setAttribute("tabindex", "0");
    goal.element.focus();
    go(goal.event);
  } else if (key === "Enter" || key === " ") {
    go(here.event);
  } else {
    return false;
  }
  return true;
}

function next(marks: Mark[], at: number, key: string): Mark | null {
  const { kind, t } = marks[at]!.event;
  if (key === "ArrowRight" || key === "ArrowLeft") {
    const other = marks[at + (key === "ArrowRight" ? 1 : -1)];
    return other?.event.kind === kind ? other : null;
  }
  if (key !== "ArrowDown" && key !== "ArrowUp") return null;
  const rows = [...new Set(marks.map(({ event }) => event.kind))];
  const row = rows[rows.indexOf(kind) + (key === "ArrowDown" ? 1 : -1)];
  const away = (mark: Mark): number => Math.abs(mark.event.t - t);
  return marks.filter(({ event }) => event.kind === row).sort((a, b) => away(a) - away(b))[0] ?? null;
}
