// Whether a JSON value is the data of a replay (replay/payload.ts), so that nothing after has to ask.
import type { Motion, ReplayPayload } from "../replay/payload";
import { first, mismatch, type Shape } from "./shape";

const VERSION = 1;
// The last moment has every digit and those before it are rounded, so it may come a little early.
const ROUNDING_S = 1e-6;

const PLACE = { x: "number", y: "number" } as const;
const POSE = { ...PLACE, heading: "number" } as const;

/** Columns with an entry for each moment. */
const MOTION = {
  t: ["number"],
  x: ["number"],
  y: ["number"],
  z: ["number"],
  qw: ["number"],
  qx: ["number"],
  qy: ["number"],
  qz: ["number"],
  believed_x: ["number"],
  believed_y: ["number"],
  believed_heading: ["number"],
  activity: ["number"],
  tilt: ["number"],
} as const;

const COLUMNS = Object.keys(MOTION) as (keyof typeof MOTION)[];

const REPLAY: Shape = {
  title: "text",
  scenario: "text",
  cell: "text",
  seed: "any",
  trial: "number",
  outcome: "text",
  detail: "text",
  repeats_stored: "any",
  record_hash: "text",
  command: "text",
  provenance: {},
  record: [{ name: "text", unit: "text", value: "number?" }],
  course: {
    start: POSE,
    goal: { ...PLACE, radius: "number" },
    told_goal: PLACE,
    bounds: { x_min: "number", x_max: "number", y_min: "number", y_max: "number" },
    walls: [{ nx: "number", ny: "number", offset: "number" }],
  },
  ground: { x0: "number", y0: "number", step: "number", nx: "number", ny: "number", z: ["number"] },
  rocks: [{ ...PLACE, z: "number", a: "number", b: "number", c: "number", yaw: "number" }],
  rock_moves: [{ ...PLACE, rock: "number", t: "number", z: "number" }],
  rover: { links: [{ name: "text", parent: "number", pivot: ["number"], axis: ["number"], shapes: [{ kind: "text" }] }] },
  motion: { ...MOTION, joints: {}, activity_names: ["text"], breaks: ["number"] },
  scans: [
    {
      ...POSE,
      t: "number",
      points: [{ ...PLACE, z: "number", stripe: "number", height: "number" }],
      hazards: ["boolean"],
    },
  ],
  steps: [
    {
      t: "number",
      step: "number",
      believed: POSE,
      behind: "boolean",
      map: {
        x0: "number",
        y0: "number",
        xstep: "number",
        ystep: "number",
        nx: "number",
        ny: "number",
        goodness: ["number"],
        certainty: ["number"],
        elevation: ["number?"],
      },
      votes: [
        {
          kind: "text",
          curvature: "number",
          hazard: "number",
          certainty: "number",
          waypoint: "number",
          merged: "number",
          chosen: "boolean",
        },
      ],
      points: [["number"]],
    },
  ],
  events: [{ ...POSE, t: "number", kind: "text", detail: "text" }],
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
    first(COLUMNS, (name) => asLong(`motion.${name}`, motion[name])) ??
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
    first([...moves, ...steps, ...events, ...scans], ({ t }) => (t >= 0 ? null : `the time ${t} must be at least 0`));
  if (problem) throw new Error(`the data of the replay is damaged: ${problem}`);
  return { ...replay, motion: { ...replay.motion, t: inOrder(replay.motion.t) } };
}
