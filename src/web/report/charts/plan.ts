// Drives from above: x to the right, y up, one scale for both, in metres. The same drawing is the map of
// a run and the small plan of one trial.

import { svg } from "../../shared/dom";
import { number } from "../../shared/format";
import type { Course, Track } from "../payload";
import { outcomeLines, outcomeMarks } from "../series";

export type Place = [x: number, y: number];

/** What is drawn in the style of one outcome. */
export interface PlanLayer {
  outcome: string;
  /** Each a line, m. */
  lines: Place[][];
  /** Where drives ended, m. */
  ends: Place[];
}

interface PlanSpec {
  course: Course;
  /** From below to above. */
  layers: PlanLayer[];
  rocks?: { at: Place; radius: number }[];
  /** Room for all of this: m. */
  box: Box;
  /** Axes with numbers. */
  axes?: boolean;
  lineWidth?: number;
}

export interface Box { x0: number; x1: number; y0: number; y1: number }

const places = (numbers_cm: number[]) =>
  Array.from({ length: numbers_cm.length / 2 }, (_, i): Place => [numbers_cm[2 * i]! / 100, numbers_cm[2 * i + 1]! / 100]);

/** The lines of a track, m. */
export const trackLines = (track: Track): Place[][] => track.pieces_cm.map(places);

/** What holds start, goal and all these places, with a border. */
export function boxOf(course: Course, places: Place[]): Box {
  const border = 0.3;
  const radius = course.goal_radius_m ?? 0;
  const [gx, gy] = course.goal;
  const box: Box = { x0: Infinity, x1: -Infinity, y0: Infinity, y1: -Infinity };
  const corners: Place[] = [[gx - radius, gy - radius], [gx + radius, gy + radius], course.start, ...course.waypoints];
  for (const each of [corners, places]) {
    for (const [x, y] of each) {
      box.x0 = Math.min(box.x0, x - border);
      box.x1 = Math.max(box.x1, x + border);
      box.y0 = Math.min(box.y0, y - border);
      box.y1 = Math.max(box.y1, y + border);
    }
  }
  return box;
}

const TICK_STEPS = [0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000];
const LEAST_TICK_GAP = 46;

function ticks(from: number, to: number, scale: number): number[] {
  const step = TICK_STEPS.find((each) => each * scale >= LEAST_TICK_GAP) ?? (to - from);
  const first = Math.ceil(from / step);
  return Array.from({ length: Math.max(0, Math.floor(to / step) - first + 1) }, (_, i) => (first + i) * step);
}

interface Frame {
  left: number; bottom: number; width: number; height: number; scale: number;
  at: (place: Place) => Place;
}

function frameOf({ box, axes }: PlanSpec, width: number, mostHeight: number): Frame {
  const left = axes ? 34 : 0;
  const bottom = axes ? 36 : 0;
  const scale = Math.min((width - left - 1) / (box.x1 - box.x0), (mostHeight - bottom) / (box.y1 - box.y0));
  const height = scale * (box.y1 - box.y0);
  return {
    left, bottom, height, scale,
    width: scale * (box.x1 - box.x0),
    at: ([x, y]) => [left + scale * (x - box.x0), height - scale * (y - box.y0)],
  };
}

function axisElements({ box }: PlanSpec, frame: Frame): SVGElement[] {
  const text = (x: number, y: number, anchor: string, content: string) =>
    svg("text", { x, y, "text-anchor": anchor, class: "plan-text" }, content);
  const grid = (from: Place, to: Place) => svg("line", { x1: from[0], y1: from[1], x2: to[0], y2: to[1], class: "plan-grid" });
  const alongX = ticks(box.x0, box.x1, frame.scale).flatMap((x) => {
    const [px] = frame.at([x, 0]);
    return [grid([px, 0], [px, frame.height]), text(px, frame.height + 15, "middle", number(x))];
  });
  const alongY = ticks(box.y0, box.y1, frame.scale).flatMap((y) => {
    const [, py] = frame.at([0, y]);
    return [grid([frame.left, py], [frame.left + frame.width, py]), text(frame.left - 5, py + 4, "end", number(y))];
  });
  return [...alongX, ...alongY, text(frame.left + frame.width, frame.height + 31, "end", "x and y [m]")];
}

function courseElements({ course, box }: PlanSpec, frame: Frame): SVGElement[] {
  const [gx, gy] = frame.at(course.goal);
  const [sx, sy] = frame.at(course.start);
  const mirrors = course.mirror_lines_m.filter((y) => y > box.y0 && y < box.y1).map((y) => {
    const [x1, py] = frame.at([box.x0, y]);
    return svg("line", { x1, y1: py, x2: x1 + frame.width, y2: py, class: "plan-mirror" });
  });
  const waypoints = course.waypoints.map((place) => {
    const [x, y] = frame.at(place);
    return svg("circle", { cx: x, cy: y, r: 3, class: "plan-goal" });
  });
  return [
    ...mirrors,
    svg("circle", { cx: gx, cy: gy, r: Math.max(3, frame.scale * course.goal_radius_m), class: "plan-goal" }),
    ...waypoints,
    svg("path", { d: `M${sx - 5},${sy}H${sx + 5}M${sx},${sy - 5}V${sy + 5}`, class: "plan-start" }),
  ];
}

// Every fifth contour is bolder. What lies beyond the box is cut off.
function contourElements({ course }: PlanSpec, { at, left, width, height }: Frame): SVGElement {
  const lines = course.contours.map(({ height_m, line_cm }) => {
    const bold = Math.round(height_m / course.contour_interval_m) % 5 === 0;
    const points = places(line_cm).map((place) => at(place).map((each) => each.toFixed(1)).join(",")).join(" ");
    return svg("polyline", { points, class: bold ? "plan-contour plan-bold" : "plan-contour" },
      svg("title", {}, `${number(height_m)} m`));
  });
  const size = { width: Math.max(width, 1), height: Math.max(height, 1) };
  return svg("svg", { x: left, y: 0, ...size, viewBox: `${left} 0 ${size.width} ${size.height}`, style: "overflow: hidden" }, ...lines);
}

// Many marks on a narrow page are small, so that they leave something of each other.
const markSize = (width: number) => Math.min(1, Math.max(0.5, Math.round(width / 70) / 10));

/** The drawing, no wider or higher than that (pixels). */
export function drawPlan(spec: PlanSpec, width: number, mostHeight: number): SVGSVGElement {
  const frame = frameOf(spec, width, mostHeight);
  const [w, h] = [Math.ceil(frame.left + frame.width + 1), Math.ceil(frame.height + frame.bottom)];
  const rocks = (spec.rocks ?? []).map(({ at, radius }) => {
    const [cx, cy] = frame.at(at);
    return svg("circle", { cx: cx.toFixed(1), cy: cy.toFixed(1), r: Math.max(0.7, frame.scale * radius).toFixed(1), class: "plan-rock" });
  });
  const layers = spec.layers.map(({ outcome, lines, ends }) =>
    svg("g", { "data-outcome": outcome },
      outcomeLines(outcome, lines.filter((line) => line.length > 1).map((line) => line.map(frame.at)), spec.lineWidth),
      outcomeMarks(outcome, ends.map(frame.at), ends.length > 1 ? markSize(width) : 1)));
  return svg("svg", { width: w, height: h, viewBox: `0 0 ${w} ${h}`, class: "plan" },
    ...(spec.course.contours.length > 0 ? [contourElements(spec, frame)] : []), ...(spec.axes ? axisElements(spec, frame) : []), ...rocks, ...courseElements(spec, frame), ...layers);
}
