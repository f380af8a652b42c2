// The overview of a drive: which moments matter, and how ten seconds are divided among them. No clock
// and no page in it.
import { inWords } from "./events";
import type { ReplayPayload, TrialEvent } from "./payload";

/** Viewer's time of the whole, s. */
export const OVERVIEW_S = 10;

/** How long it stands at a moment that matters, s. */
const HOLD_S = 0.9;

const MOST_BEATS = 5;

// Nearer together than this share of what is played, two moments are one.
const APART = 0.02;

export interface Beat { t: number; caption: string }

// The first of each kind is told, in this order where there are more than fit.
const CAPTIONS: [string, string][] = [
  ["stall", "Here it gets stuck"],
  ["reflection", "Operators turn it back at a mirror line of the arena"],
  ["waypoint", "The first waypoint"],
  ["felt", "It feels a hazard"],
  ["scrape", "It scrapes a rock"],
  ["hazard", "The first hazard that it believes in"],
];

/** Where belief and truth are first further apart than the goal is wide. */
function partingOf({ motion, course }: ReplayPayload): Beat[] {
  const wide = course.goal.radius;
  const i = motion.t.findIndex((_, k) => Math.hypot(motion.believed_x[k]! - motion.x[k]!, motion.believed_y[k]! - motion.y[k]!) > wide);
  return i < 0 ? [] : [{ t: motion.t[i]!, caption: `From here it is wrong about its place by more than ${wide} m` }];
}

/** The moments that matter, in the order of time, the end left out. */
export function beatsOf(payload: ReplayPayload, events: TrialEvent[]): Beat[] {
  const firsts = CAPTIONS.flatMap(([kind, caption]) => {
    const first = events.find((event) => event.kind === kind);
    return first ? [{ t: first.t, caption: kind === "felt" ? `${caption}: ${inWords(first)}` : caption }] : [];
  });
  const start = { t: payload.motion.t[0]!, caption: `The goal is ${straight(payload)} m away` };
  return [start, ...partingOf(payload), ...firsts].slice(0, MOST_BEATS).sort((a, b) => a.t - b.t);
}

function straight({ course: { start, goal } }: ReplayPayload): string {
  return Math.hypot(goal.x - start.x, goal.y - start.y).toFixed(1);
}

interface Piece {
  from: number; // viewer's time, s
  to: number;
  fromShare: number; // of what is played
  toShare: number;
  caption: string;
}

/** Maps the viewer's seconds to how much of the drive is shown, and to what is said meanwhile. */
export class OverviewClock {
  private readonly pieces: Piece[] = [];

  /** `shareOf` is how much of the whole is played by a time, 0 to 1. */
  constructor(beats: Beat[], shareOf: (t: number) => number) {
    const held = apart(beats.map(({ t, caption }) => ({ share: shareOf(t), caption })));
    const travel = OVERVIEW_S - HOLD_S * held.length;
    let now = 0;
    let share = 0;
    const add = (seconds: number, toShare: number, caption: string): void => {
      this.pieces.push({ from: now, to: now + seconds, fromShare: share, toShare, caption });
      now += seconds;
      share = toShare;
    };
    let said = "";
    for (const beat of held) {
      add((beat.share - share) * travel, beat.share, said);
      add(HOLD_S, beat.share, beat.caption);
      said = beat.caption;
    }
    add((1 - share) * travel, 1, said);
  }

  at(seconds: number): { share: number; caption: string } {
    const piece = this.pieces.find(({ to }) => seconds < to) ?? this.pieces[this.pieces.length - 1]!;
    const span = piece.to - piece.from;
    const done = span > 0 ? Math.min(1, Math.max(0, (seconds - piece.from) / span)) : 1;
    return { share: piece.fromShare + done * (piece.toShare - piece.fromShare), caption: piece.caption };
  }
}

function apart(beats: { share: number; caption: string }[]): { share: number; caption: string }[] {
  const kept: { share: number; caption: string }[] = [];
  for (const beat of beats) {
    const last = kept[kept.length - 1];
    if (!last || beat.share - last.share >= APART) kept.push(beat);
  }
  return kept;
}
