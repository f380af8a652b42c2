// Where the drive starts, where it should end, and where operators turn it back.
import { BufferGeometry, CircleGeometry, DoubleSide, Group, Mesh, MeshBasicMaterial } from "three";
import type { Palette } from "../palette";
import type { Course, ReplayPayload } from "../payload";
import { extentOf, type GroundHeights } from "./ground";
import { Lines, type Point } from "./lines";
import { makeLabel } from "./labels";

const CORNERS = 64;
const LIFT_M = 0.008;
const PIECE_M = 0.1;
const SAME_GOAL_M = 0.005;
// Words on a mirror line: how far after the start, and from where on they are not shown.
const MIRROR_LABEL_M = 1;
const MIRROR_REACH_M = 8;
export const WAYPOINT_RADIUS_M = 0.15;

export function toldElsewhere({ goal, told_goal: told }: Course): boolean {
  return Math.hypot(goal.x - told.x, goal.y - told.y) > SAME_GOAL_M;
}

/** y of the lines at which the layout of a virtual arena is mirrored, as far as there is ground. */
export function mirrorLines({ course, world }: Pick<ReplayPayload, "course" | "world">): number[] {
  const { kind, mirror_line: h } = world.arena;
  if (kind !== "virtual_unfolded") return course.mirror_lines;
  const lines: number[] = [];
  for (let y = h; y < Math.max(course.bounds.y_max, -course.bounds.y_min); y += 2 * h) lines.push(-y, y);
  return lines.filter((y) => y > course.bounds.y_min && y < course.bounds.y_max);
}

function ring(x: number, y: number, radius: number, heights: GroundHeights): Point[] {
  return Array.from({ length: CORNERS + 1 }, (_, i) => {
    const angle = (2 * Math.PI * i) / CORNERS;
    const px = x + radius * Math.cos(angle);
    const py = y + radius * Math.sin(angle);
    return [px, py, heights.at(px, py) + LIFT_M];
  });
}

function disc(x: number, y: number, radius: number, heights: GroundHeights): BufferGeometry {
  const geometry = new CircleGeometry(radius, CORNERS).translate(x, y, 0);
  const position = geometry.getAttribute("position");
  for (let i = 0; i < position.count; ++i) position.setZ(i, heights.at(position.getX(i), position.getY(i)) + LIFT_M);
  return geometry;
}

// Along x from edge to edge, on the ground.
function acrossGround(course: Course, y: number, heights: GroundHeights): Point[] {
  const { xMin, xMax } = extentOf(course);
  const count = Math.max(1, Math.ceil((xMax - xMin) / PIECE_M));
  return Array.from({ length: count + 1 }, (_, i) => {
    const x = xMin + ((xMax - xMin) * i) / count;
    return [x, y, heights.at(x, y) + LIFT_M];
  });
}

export function makeCourse(payload: ReplayPayload, heights: GroundHeights, palette: Palette): Group {
  const { course } = payload;
  const { start, goal, told_goal: told, waypoints } = course;
  const group = new Group();
  const line = (points: Point[], colour: string, dash?: [number, number]): void => {
    const lines = new Lines({ width_px: 2.5, dash });
    lines.setPath(points);
    lines.recolour(colour);
    group.add(lines.object);
  };
  const sign = (text: string, x: number, y: number, pole_m: number, colour: string, anchor: [number, number]): void => {
    const z = heights.at(x, y);
    line([[x, y, z], [x, y, z + pole_m]], colour);
    group.add(makeLabel(text, x, y, z + pole_m, { colour, anchor }));
  };
  for (const y of mirrorLines(payload)) {
    line(acrossGround(course, y, heights), palette.mirror, [0.25, 0.12]);
    const x = start.x + MIRROR_LABEL_M;
    group.add(makeLabel("the course is mirrored here", x, y, heights.at(x, y), { colour: palette.mirror, reach_m: MIRROR_REACH_M }));
  }
  line(ring(start.x, start.y, 0.12, heights), palette.label);
  sign("start", start.x, start.y, 0.1, palette.label, [0.5, -0.7]);
  waypoints.forEach(({ x, y }, i) => {
    line(ring(x, y, WAYPOINT_RADIUS_M, heights), palette.goal);
    sign(`waypoint ${i + 1}`, x, y, 0.25, palette.goal, [1.08, 0]);
  });
  const fill = new MeshBasicMaterial({ color: palette.goal, transparent: true, opacity: 0.25, side: DoubleSide, depthWrite: false });
  group.add(new Mesh(disc(goal.x, goal.y, goal.radius, heights), fill));
  line(ring(goal.x, goal.y, goal.radius, heights), palette.goal);
  sign("goal", goal.x, goal.y, 0.5, palette.goal, [1.08, 0]);
  if (toldElsewhere(course)) {
    line(ring(told.x, told.y, goal.radius, heights), palette["told-goal"], [0.08, 0.06]);
    sign("designated goal", told.x, told.y, 0.25, palette["told-goal"], [-0.08, 0]);
  }
  return group;
}
