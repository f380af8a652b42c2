// Events of the time line, with those that follow from scans and activities where nobody wrote them.
import type { ReplayPayload, TrialEvent } from "./payload";

/** The order of the rows; kinds that are not here come after. */
const ORDER = ["scan", "look", "hazard", "chosen", "turn", "felt", "scrape", "stall", "reflection", "waypoint", "tracker", "overlay", "end"];

export function timelineEvents(payload: ReplayPayload): TrialEvent[] {
  const events = [...payload.events];
  const has = (kind: string): boolean => payload.events.some((event) => event.kind === kind);
  if (!has("scan")) {
    for (const { t, x, y, heading } of payload.scans) events.push({ t, kind: "scan", detail: "", x, y, heading });
  }
  for (const kind of ["turn", "stall"]) if (!has(kind)) events.push(...startsOf(kind, payload));
  return events.sort((a, b) => a.t - b.t);
}

function startsOf(activity: string, { motion }: ReplayPayload): TrialEvent[] {
  const wanted = motion.activity_names.indexOf(activity);
  const starts: TrialEvent[] = [];
  motion.activity.forEach((now, i) => {
    if (now !== wanted || motion.activity[i - 1] === wanted) return;
    // A sample is written at the end of what it tells of.
    const from = Math.max(0, i - 1);
    const place = { x: motion.x[from]!, y: motion.y[from]!, heading: 0 };
    starts.push({ t: motion.t[from]!, kind: activity, detail: "", ...place });
  });
  return starts;
}

/** The kinds that occur, in the order of the rows. */
export function kindsOf(events: TrialEvent[]): string[] {
  const place = (kind: string): number => (ORDER.includes(kind) ? ORDER.indexOf(kind) : ORDER.length);
  return [...new Set(events.map((event) => event.kind))].sort((a, b) => place(a) - place(b));
}

const WORDS: Record<string, string> = {
  scan: "scanned the ground ahead",
  look: "looked",
  hazard: "believes in a hazard",
  chosen: "chose",
  turn: "begins a turn in place",
  felt: "felt",
  scrape: "scraped a rock",
  stall: "is stuck",
  reflection: "operators turned the rover back at a mirror line of the arena",
  overlay: "its navigator failed to say what it shows",
  end: "the trial ended",
};

// What the kind alone leaves open; "turns in place" of the record are others, and fewer.
const NAMES: Record<string, string> = { turn: "turn in place", overlay: "overlay failed" };

/** A kind in a word or two. */
export function kindName(kind: string): string { return NAMES[kind] ?? kind; }

export function kindTitle(kind: string): string {
  if (kind === "turn") return "turns in place; one that goes on after a look counts again";
  return WORDS[kind] ?? kind;
}

/** An event as a person would say it. */
export function inWords({ kind, detail }: TrialEvent): string {
  const words = WORDS[kind] ?? kind;
  if (kind === "hazard" && /^[#.]+$/.test(detail)) {
    const stripes = [...detail].flatMap((mark, i) => (mark === "#" ? [i + 1] : []));
    return `${words}: stripe${stripes.length > 1 ? "s" : ""} ${stripes.join(", ")} of ${detail.length} from the left`;
  }
  return detail ? `${words}: ${detail.replaceAll("_", " ")}` : words;
}

export interface Run { from: number; to: number; activity: string }

/** Runs of one activity: sample i tells what happened up to its time. */
export function activityRuns({ motion }: ReplayPayload): Run[] {
  const runs: Run[] = [];
  for (let i = 1; i < motion.t.length; ++i) {
    const activity = motion.activity_names[motion.activity[i]!] ?? "";
    const last = runs[runs.length - 1];
    if (last?.activity === activity) last.to = motion.t[i]!;
    else runs.push({ from: motion.t[i - 1]!, to: motion.t[i]!, activity });
  }
  return runs;
}
