// Whether a JSON value is the data of a replay (replay/payload.ts), so that nothing after has to ask.

import { type Motion, MOTION_COLUMNS, type ReplayPayload } from "../replay/payload";

const VERSION = 1;
// The last moment has every digit and those before it are rounded, so it may come a little early.
const ROUNDING_S = 1e-6;

/** Members that are numbers. */
const numbers = (...names: string[]): Record<string, Shape> => Object.fromEntries(names.map((name) => [name, "number"]));

const POSE = numbers("x", "y", "heading");

const REPLAY: Shape = {
  title: "text", scenario: "text", cell: "text", seed: "any", trial: "number", outcome: "text", detail: "text", repeats_stored: "any",
  record_hash: "text", command: "text", provenance: {},
  record: [{ name: "text", unit: "text", value: "number?" }],
  course: {
    start: POSE,
    goal: numbers("x", "y", "radius"),
    told_goal: numbers("x", "y"),
    bounds: numbers("x_min", "x_max", "y_min", "y_max"),
    walls: [numbers("nx", "ny", "offset")],
  },
  ground: { ...numbers("x0", "y0", "step", "nx", "ny"), z: ["number"] },
  rocks: [numbers("x", "y", "z", "a", "b", "c", "yaw")],
  rock_moves: [numbers("x", "y", "rock", "t", "z")],
  rover: { links: [{ name: "text", parent: "number", pivot: ["number"], axis: ["number"], shapes: [{ kind: "text" }] }] },
  motion: {
    ...Object.fromEntries(MOTION_COLUMNS.map((name) => [name, ["number"]])),
    joints: {}, activity_names: ["text"], breaks: ["number"],
  },
  scans: [{ ...POSE, t: "number", points: [numbers("x", "y", "z", "stripe", "height")], hazards: ["boolean"] }],
  steps: [{
    ...numbers("t", "step"),
    believed: POSE,
    behind: "boolean",
    map: { ...numbers("x0", "y0", "xstep", "ystep", "nx", "ny"), goodness: ["number"], certainty: ["number"], elevation: ["number?"] },
    votes: [{ kind: "text", ...numbers("curvature", "hazard", "certainty", "waypoint", "merged"), chosen: "boolean" }],
    points: [["number"]],
  }],
  events: [{ ...POSE, t: "number", kind: "text", detail: "text" }],
};

// Of a version of the program that has no overlays there are none.
const OVERLAYS: Shape = {
  shown: [{
    t: "number", pose: POSE, believed: POSE,
    lines: [{ name: "text", points: [["number"]] }],
    grids: [{ name: "text", ...numbers("x0", "y0", "step", "nx", "ny"), values: ["number"] }],
  }],
};

const SHAPES: Record<string, Shape> = {
  box: { center: ["number"], size: ["number"] },
  wheel: { center: ["number"], radius: "number", width: "number" },
  capsule: { from: ["number"], to: ["number"], radius: "number" },
  sphere: { center: ["number"], radius: "number" },
};

function motionProblem(motion: Motion): string | null {
  const { t: times, joints } = motion;
  if (times.length === 0) return "motion.t must not be empty";
  const descends = times.findIndex((t, i) => t < (times[i - 1] ?? 0) - ROUNDING_S);
  if (descends >= 0) return `motion.t[${descends}] must be no less than the time before it`;
  const asLong = (name: string, column: number[]): string | null =>
    column.length === times.length ? null : `${name} must be as long as motion.t`;
  return (
    first(MOTION_COLUMNS, (name) => asLong(`motion.${name}`, motion[name])) ??
    first(Object.entries(joints), ([name, column]) => {
      const path = `motion.joints.${name}`;
      return mismatch(column, ["number"], path) ?? asLong(path, column);
    })
  );
}

function linkProblem({ links }: ReplayPayload["rover"]): string | null {
  return first(links, ({ parent, axis, shapes }, i) => {
    if (i > 0 && !(parent in links && parent < i)) return `rover.links[${i}].parent must come before it`;
    if (!(Math.hypot(...axis) > 0)) return `rover.links[${i}].axis must have a length`;
    return first(shapes, (shape, k) => {
      const path = `rover.links[${i}].shapes[${k}]`;
      const wanted = SHAPES[shape.kind];
      return wanted ? mismatch(shape, wanted, path) : `${path}.kind is not known`;
    });
  });
}

function overlaysProblem({ overlays }: ReplayPayload): string | null {
  if (!overlays) return null;
  return mismatch(overlays, OVERLAYS, "overlays") ?? first(overlays.shown, ({ lines, grids }, i) => {
    const path = `overlays.shown[${i}]`;
    return first(lines, ({ points }, k) => points.every(({ length }) => length === 2) ? null : `${path}.lines[${k}] must have points of two numbers`) ??
      first(grids, ({ nx, ny, values }, k) => values.length === nx * ny ? null : `${path}.grids[${k}] must have nx times ny values`);
  });
}

// Never descending.
function inOrder(times: readonly number[]): number[] {
  let latest = 0;
  return times.map((t) => (latest = Math.max(latest, t)));
}

/** The same data with its moments in the order of time. Throws Error with what is wrong, for people. */
export function asReplay(value: unknown): ReplayPayload {
  const replay = value as ReplayPayload;
  if (typeof value !== "object" || value === null || !("motion" in value) || replay.version !== VERSION) {
    throw new Error("it is not the data of a replay\n  try: rockyard replay RUN --trial I --data FILE.json");
  }
  const { ground, rocks, rock_moves: moves, steps, events, scans } = replay;
  const problem =
    mismatch(value, REPLAY) ??
    motionProblem(replay.motion) ??
    linkProblem(replay.rover) ??
    (ground.z.length === ground.nx * ground.ny ? null : "ground.z must have nx times ny heights") ??
    first(moves, ({ rock }, i) => (rock in rocks ? null : `rock_moves[${i}].rock must be the number of a rock`)) ??
    first(steps, ({ map: { nx, ny, goodness } }, i) =>
      goodness.length === nx * ny ? null : `steps[${i}].map.goodness must have nx times ny cells`) ??
    overlaysProblem(replay) ??
    first([...moves, ...steps, ...events, ...scans, ...(replay.overlays?.shown ?? [])], ({ t }) => (t >= 0 ? null : `the time ${t} must be at least 0`));
  if (problem) throw new Error(`the data of the replay is damaged: ${problem}`);
  return { ...replay, motion: { ...replay.motion, t: inOrder(replay.motion.t) } };
}

// ---- What a JSON value must look like, and what about it does not.

/** "number" is finite; a list of one is a list of such; an object is an object with these members. */
export type Shape =
  | "number"
  | "number?"
  | "text"
  | "boolean"
  | "any"
  | readonly [Shape]
  | { readonly [member: string]: Shape };

const isObject = (value: unknown): value is Record<string, unknown> =>
  typeof value === "object" && value !== null && !Array.isArray(value);

const LEAVES: Record<string, { test: (value: unknown) => boolean; words: string }> = {
  number: { test: Number.isFinite, words: "a number" },
  "number?": { test: (value) => value === null || Number.isFinite(value), words: "a number or null" },
  text: { test: (value) => typeof value === "string", words: "text" },
  boolean: { test: (value) => typeof value === "boolean", words: "true or false" },
  any: { test: (value) => value !== undefined, words: "there" },
};

/** The first place in `value` that differs from `shape`, in words; null where there is none. */
function mismatch(value: unknown, shape: Shape, path = ""): string | null {
  if (typeof shape === "string") {
    const { test, words } = LEAVES[shape]!;
    return test(value) ? null : `${path || "the file"} must be ${words}`;
  }
  if (Array.isArray(shape)) {
    if (!Array.isArray(value)) return `${path} must be a list`;
    return first(value, (entry, i) => mismatch(entry, shape[0] as Shape, `${path}[${i}]`));
  }
  if (!isObject(value)) return `${path || "the file"} must be an object`;
  return first(Object.entries(shape), ([name, of]) => mismatch(value[name], of, path ? `${path}.${name}` : name));
}

/** The first answer of `ask` that is not null. */
export function first<T>(values: readonly T[], ask: (value: T, index: number) => string | null): string | null {
  for (let i = 0; i < values.length; ++i) {
    const answer = ask(values[i]!, i);
    if (answer !== null) return answer;
  }
  return null;
}
