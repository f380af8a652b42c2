// What the rover saw and decided: points, maps, votes, events.
import { LogLevel, NumericType, type Grid, type Log, type PackedElementField, type PointCloud } from "@foxglove/schemas";
import { lastAtOrBefore } from "../replay/motion";
import type { ReplayPayload, Step, TrialEvent } from "../replay/payload";
import { pose, timestamp, vector } from "./geometry";
import { WORLD } from "./motion_messages";
import type { Message } from "./topics";

export const FLOAT_BYTES = 4;

export const fieldsOf = (names: readonly string[]): PackedElementField[] =>
  names.map((name, i) => ({ name, offset: i * FLOAT_BYTES, type: NumericType.FLOAT32 }));

/** Rows of numbers as little-endian floats, whatever the machine. */
export function packed(rows: readonly (readonly number[])[]): Uint8Array {
  const all = rows.flat();
  const view = new DataView(new ArrayBuffer(all.length * FLOAT_BYTES));
  all.forEach((value, i) => view.setFloat32(i * FLOAT_BYTES, value, true));
  return new Uint8Array(view.buffer);
}

function cloud(t: number, names: readonly string[], rows: readonly (readonly number[])[]): PointCloud {
  return {
    timestamp: timestamp(t),
    frame_id: WORLD,
    pose: pose(vector(0, 0, 0)),
    point_stride: names.length * FLOAT_BYTES,
    fields: fieldsOf(names),
    data: packed(rows),
  };
}

function scanMessages({ scans }: ReplayPayload): Message[] {
  return scans.map(({ t, points, hazards }) => ({
    topic: "/scan",
    t,
    content: cloud(
      t,
      ["x", "y", "z", "stripe", "height", "hazard"],
      points.map(({ x, y, z, stripe, height }) => [x, y, z, stripe, height, hazards[stripe] ? 1 : 0]),
    ),
  }));
}

// The map has no height of its own: it lies as high as the rover stood, where the ground does not hide it.
function grid(t: number, { map }: Step, z: number): Grid {
  const names = ["goodness", "certainty", "elevation"];
  const cell = names.length * FLOAT_BYTES;
  return {
    timestamp: timestamp(t),
    frame_id: WORLD,
    pose: pose(vector(map.x0, map.y0, z)),
    column_count: map.nx,
    cell_size: { x: map.xstep, y: map.ystep },
    row_stride: map.nx * cell,
    cell_stride: cell,
    fields: fieldsOf(names),
    data: packed(map.goodness.map((good, i) => [good, map.certainty[i] ?? -1, map.elevation[i] ?? NaN])),
  };
}

function stepMessages({ steps, motion }: ReplayPayload): Message[] {
  return steps.flatMap((step): Message[] => {
    const { t, votes, behind, points } = step;
    const z = motion.z[Math.max(0, lastAtOrBefore(motion.t, t))]!;
    const messages: Message[] = [
      { topic: "/map", t, content: grid(t, step, z) },
      { topic: "/votes", t, content: { timestamp: timestamp(t), step: step.step, behind, votes } },
    ];
    if (points.length > 0) messages.push({ topic: "/look", t, content: cloud(t, ["x", "y", "z"], points) });
    return messages;
  });
}

const TROUBLE = ["hazard", "felt", "scrape", "stall", "reflection"];

function levelOf({ kind }: TrialEvent, outcome: string): LogLevel {
  if (kind === "end" && outcome !== "goal_reached") return LogLevel.ERROR;
  return TROUBLE.includes(kind) ? LogLevel.WARNING : LogLevel.INFO;
}

function eventMessages({ events, outcome }: ReplayPayload): Message[] {
  return events.map((event) => {
    const { t, kind, detail } = event;
    const content: Log = { timestamp: timestamp(t), level: levelOf(event, outcome), message: detail, name: kind, file: "", line: 0 };
    return { topic: "/events", t, content };
  });
}

export const sensingMessages = (replay: ReplayPayload): Message[] => [
  ...scanMessages(replay),
  ...stepMessages(replay),
  ...eventMessages(replay),
];
