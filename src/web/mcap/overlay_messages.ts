// What the navigator shows of itself: its lines as a scene, each of its grids on a topic of its own.
import { LineType, type Color, type Grid, SceneEntityDeletionType, type SceneUpdate } from "@foxglove/schemas";
import { lastAtOrBefore } from "../replay/motion";
import { lineNames } from "../replay/overlays";
import type { Overlay, OverlayGrid, ReplayPayload } from "../replay/payload";
import { colour, NO_TURN, pose, timestamp, vector } from "./geometry";
import { WORLD } from "./motion_messages";
import { entity } from "./scene_messages";
import { fieldsOf, FLOAT_BYTES, packed } from "./sensing_messages";
import { gridTopic, type Message } from "./topics";

const COLOURS: Color[] = [
  colour(0.42, 0.3, 0.9), colour(0.45, 0.7, 0.1), colour(0, 0.65, 0.7), colour(0.75, 0.25, 0.85), colour(0.85, 0.65, 0.1), colour(0.5, 0.58, 0.65),
];
const LINE_PX = 3;
const LIFT_M = 0.015;
const FULL_VALUE = 255;

// Names come and go: each message takes away what the one before showed.
function scene({ t, lines }: Overlay, names: string[], z: number): SceneUpdate {
  const shown = names.filter((name) => lines.some((line) => line.name === name));
  return {
    deletions: [{ timestamp: timestamp(t), type: SceneEntityDeletionType.ALL, id: "" }],
    entities: shown.map((name) => entity(t, WORLD, name, {
      lines: lines.filter((line) => line.name === name).map(({ points }) => ({
        type: LineType.LINE_STRIP,
        pose: pose(vector(0, 0, 0), NO_TURN),
        thickness: LINE_PX,
        scale_invariant: true,
        points: points.map(([x, y]) => vector(x, y, z + LIFT_M)),
        color: COLOURS[names.indexOf(name) % COLOURS.length]!,
        colors: [],
        indices: [],
      })),
    })),
  };
}

function grid(t: number, { x0, y0, step, nx, values }: OverlayGrid, z: number): Grid {
  return {
    timestamp: timestamp(t),
    frame_id: WORLD,
    pose: pose(vector(x0, y0, z)),
    column_count: nx,
    cell_size: { x: step, y: step },
    row_stride: nx * FLOAT_BYTES,
    cell_stride: FLOAT_BYTES,
    fields: fieldsOf(["value"]),
    data: packed(values.map((value) => [value < 0 ? NaN : value / FULL_VALUE])),
  };
}

/** In the believed world, as high as the rover stood. */
export function overlayMessages({ overlays, motion }: ReplayPayload): Message[] {
  if (!overlays) return [];
  const names = lineNames(overlays);
  return overlays.shown.flatMap((overlay): Message[] => {
    const { t, grids } = overlay;
    const z = motion.z[Math.max(0, lastAtOrBefore(motion.t, t))]!;
    const lines: Message[] = names.length > 0 ? [{ topic: "/scene/overlay", t, content: scene(overlay, names, z) }] : [];
    return [...lines, ...grids.map((each) => ({ topic: gridTopic(each.name), t, content: grid(t, each, z) }))];
  });
}
