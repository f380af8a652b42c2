// Ground, course, rocks, rover and paths as entities of a 3-D scene.

import {
  type Color, type CylinderPrimitive, type LinePrimitive, LineType, type Pose, type SceneEntity, type SceneUpdate,
  type SpherePrimitive, type Vector3,
} from "@foxglove/schemas";

import type { ReplayPayload, Rock, Shape } from "../replay/payload";
import { extentOf, gridFaces, GroundHeights, WALL_HEIGHT_M, wallWithin } from "../replay/scene/ground";
import { alongZ, colour, fromList, NO_TURN, pose, timestamp, vector, yaw } from "./geometry";
import { linkFrame, WORLD } from "./motion_messages";
import type { Message, Topic } from "./topics";

const GROUND = colour(0.62, 0.47, 0.36);
const ROCK = colour(0.4, 0.33, 0.3);
const GOAL = colour(0, 0.62, 0.45, 0.5);
const TOLD_GOAL = colour(0.9, 0.62, 0, 0.5);
const WALL = colour(0.34, 0.71, 0.91, 0.3);
const TRUE_PATH = colour(0, 0.45, 0.7);
const BELIEVED_PATH = colour(0.84, 0.37, 0);

const LINE_PX = 2;
const PATH_LIFT_M = 0.01;
const GOAL_HEIGHT_M = 0.02;
const TOLD_GOAL_RADIUS_M = 0.1;
const WALL_THICKNESS_M = 0.01;

type Parts = Partial<Pick<SceneEntity, "cubes" | "spheres" | "cylinders" | "lines" | "triangles">>;

/** What is drawn in a frame until one with its id replaces it. */
export function entity(t: number, frame: string, id: string, parts: Parts): SceneEntity {
  return {
    timestamp: timestamp(t), frame_id: frame, id, lifetime: { sec: 0, nsec: 0 }, frame_locked: true, metadata: [],
    arrows: [], cubes: [], spheres: [], cylinders: [], lines: [], triangles: [], texts: [], models: [], ...parts,
  };
}

const drum = (place: Pose, size: Vector3, color: Color): CylinderPrimitive => ({ pose: place, size, bottom_scale: 1, top_scale: 1, color });

function update(topic: Topic, t: number, entities: SceneEntity[]): Message {
  const content: SceneUpdate = { deletions: [], entities };
  return { topic, t, content };
}

function groundParts({ ground: { x0, y0, step, nx, ny, z } }: ReplayPayload): Parts {
  const points = z.map((height, i) => vector(x0 + (i % nx) * step, y0 + Math.floor(i / nx) * step, height));
  return { triangles: [{ pose: pose(vector(0, 0, 0)), points, color: GROUND, colors: [], indices: gridFaces(nx, ny) }] };
}

function wallParts({ course }: ReplayPayload, heights: GroundHeights): Parts {
  const cubes = course.walls.flatMap((wall) => {
    const ends = wallWithin(wall, extentOf(course));
    if (!ends) return [];
    const { foot, from, to } = ends;
    const along = (from + to) / 2;
    const z = heights.at(foot.x, foot.y) + WALL_HEIGHT_M / 2;
    const center = vector(foot.x - wall.ny * along, foot.y + wall.nx * along, z);
    const size = vector(to - from, WALL_THICKNESS_M, WALL_HEIGHT_M);
    return [{ pose: pose(center, yaw(Math.atan2(wall.nx, -wall.ny))), size, color: WALL }];
  });
  return { cubes };
}

function course(replay: ReplayPayload, t: number): Message {
  const heights = new GroundHeights(replay.ground);
  const { goal, told_goal: told } = replay.course;
  const disc = (x: number, y: number, radius: number, color: Color): Parts => ({
    cylinders: [drum(pose(vector(x, y, heights.at(x, y))), vector(2 * radius, 2 * radius, GOAL_HEIGHT_M), color)],
  });
  return update("/scene/course", t, [
    entity(t, WORLD, "ground", groundParts(replay)),
    entity(t, WORLD, "goal", disc(goal.x, goal.y, goal.radius, GOAL)),
    entity(t, WORLD, "told_goal", disc(told.x, told.y, TOLD_GOAL_RADIUS_M, TOLD_GOAL)),
    entity(t, WORLD, "walls", wallParts(replay, heights)),
  ]);
}

const ellipsoid = ({ x, y, z, a, b, c, yaw: angle }: Rock): SpherePrimitive => ({
  pose: pose(vector(x, y, z), yaw(angle)),
  size: vector(2 * a, 2 * b, 2 * c),
  color: ROCK,
});

// A cap by frusta. There are no messages for quadrics beside spheres.
const CAP_LAYERS = 6;

function cap({ x, y, z, a, b, c, yaw: angle }: Rock, growth: number): CylinderPrimitive[] {
  // Denser towards the top, where it bends.
  const shares = Array.from({ length: CAP_LAYERS + 1 }, (_, i) => (i / CAP_LAYERS) ** 2);
  const radius = (s: number): number => Math.sqrt((growth + (1 - growth) * s) * s);
  return shares.slice(1).map((below, i) => {
    const above = shares[i]!;
    const r = radius(below);
    return {
      pose: pose(vector(x, y, z + c * (1 - 0.5 * (below + above))), yaw(angle)),
      size: vector(2 * a * r, 2 * b * r, c * (below - above)),
      bottom_scale: 1,
      top_scale: radius(above) / r,
      color: ROCK,
    };
  });
}

const shapes = (rocks: Rock[]): Parts => ({
  spheres: rocks.filter(({ growth }) => !growth).map(ellipsoid),
  cylinders: rocks.flatMap((rock) => (rock.growth ? cap(rock, rock.growth) : [])),
});

// Those that lie still are written once. The others are few, and are written whole at every push.
function rocks(replay: ReplayPayload, t: number): Message[] {
  const now = replay.rocks.map((rock) => ({ ...rock }));
  const pushed = [...new Set(replay.rock_moves.map(({ rock }) => rock))];
  const still = now.filter((_, i) => !pushed.includes(i));
  const messages = [update("/scene/rocks", t, [entity(t, WORLD, "rocks", shapes(still))])];
  const tell = (time: number): void => {
    const parts = shapes(pushed.map((i) => now[i]!));
    messages.push(update("/scene/pushed_rocks", time, [entity(time, WORLD, "pushed_rocks", parts)]));
  };
  if (pushed.length > 0) tell(t);
  for (const { rock, t: time, ...place } of replay.rock_moves) {
    Object.assign(now[rock]!, place);
    tell(time);
  }
  return messages;
}

/** One line for each stretch without a break. */
function path({ motion }: ReplayPayload, x: number[], y: number[], color: Color): LinePrimitive[] {
  const ends = [0, ...motion.breaks, motion.t.length];
  return ends.slice(1).map((end, k) => ({
    type: LineType.LINE_STRIP,
    pose: pose(vector(0, 0, PATH_LIFT_M), NO_TURN),
    thickness: LINE_PX,
    scale_invariant: true,
    points: motion.z.slice(ends[k], end).map((z, i) => vector(x[ends[k]! + i]!, y[ends[k]! + i]!, z)),
    color,
    colors: [],
    indices: [],
  }));
}

function paths(replay: ReplayPayload, t: number): Message {
  const { x, y, believed_x: bx, believed_y: by } = replay.motion;
  return update("/scene/paths", t, [
    entity(t, WORLD, "true_path", { lines: path(replay, x, y, TRUE_PATH) }),
    entity(t, WORLD, "believed_path", { lines: path(replay, bx, by, BELIEVED_PATH) }),
  ]);
}

/** What is there from the first moment on, and every push of a rock. */
export function sceneMessages(replay: ReplayPayload): Message[] {
  const t = replay.motion.t[0]!;
  return [course(replay, t), ...rocks(replay, t), update("/scene/rover", t, rover(replay, t)), paths(replay, t)];
}

// ---- The shapes of the rover's links as cubes, cylinders and spheres in the links' frames.

const BODY = colour(0.75, 0.75, 0.78);
const PANEL = colour(0.1, 0.2, 0.45);
const WHEEL = colour(0.2, 0.2, 0.22);
const ARM = colour(0.55, 0.55, 0.58);

function ball(center: Vector3, radius: number): SpherePrimitive {
  return { pose: pose(center), size: vector(2 * radius, 2 * radius, 2 * radius), color: ARM };
}

/** From one end to the other, with flat ends. */
function cylinder(from: Vector3, to: Vector3, radius: number, color: Color): CylinderPrimitive {
  const along = vector(to.x - from.x, to.y - from.y, to.z - from.z);
  const middle = vector((from.x + to.x) / 2, (from.y + to.y) / 2, (from.z + to.z) / 2);
  return drum(pose(middle, alongZ(along)), vector(2 * radius, 2 * radius, Math.hypot(along.x, along.y, along.z)), color);
}

function partsOf(shape: Shape): Parts {
  switch (shape.kind) {
    case "box":
      return { cubes: [{ pose: pose(fromList(shape.center)), size: fromList(shape.size), color: shape.part.includes("panel") ? PANEL : BODY }] };
    case "sphere":
      return { spheres: [ball(fromList(shape.center), shape.radius)] };
    case "wheel": {
      const { x, y, z } = fromList(shape.center);
      const half = shape.width / 2;
      return { cylinders: [cylinder(vector(x, y - half, z), vector(x, y + half, z), shape.radius, WHEEL)] };
    }
    case "capsule": {
      const [from, to] = [fromList(shape.from), fromList(shape.to)];
      return { cylinders: [cylinder(from, to, shape.radius, ARM)], spheres: [ball(from, shape.radius), ball(to, shape.radius)] };
    }
  }
}

/** An entity for each link that has shapes. */
function rover({ rover: shape }: ReplayPayload, t: number): SceneEntity[] {
  return shape.links.flatMap(({ shapes }, i) => {
    const parts = shapes.map(partsOf);
        const frame = linkFrame(shape, i);
    return shapes.length > 0 ? [entity(t, frame, frame, {
      cubes: parts.flatMap(({ cubes = [] }) => cubes),
      spheres: parts.flatMap(({ spheres = [] }) => spheres),
      cylinders: parts.flatMap(({ cylinders = [] }) => cylinders),
    })] : [];
  });
}
