// Where the arcs, the splines and the map of a decision lie.

import type { Place, Splines, Step, Vote } from "../payload";

const ARC_M = 1.4;
const BACK_ARC_M = 0.8;
const TURN_RADIUS_M = 0.5;
/** A path is drawn in so many. */
export const PIECES = 24;

export interface Frame {
  /** From the believed world to the one that is drawn. */
  place(x: number, y: number): [number, number];
  /** From the rover's frame at the decision, where arcs begin. */
  ahead(x: number, y: number): [number, number];
  /** From the frame in which splines begin. */
  along(x: number, y: number): [number, number];
}

/** From the frame of a pose. */
export function placed(pose: Place, x: number, y: number): [number, number] {
  const [c, s] = [Math.cos(pose.heading), Math.sin(pose.heading)];
  return [pose.x + c * x - s * y, pose.y + s * x + c * y];
}

/** From the believed world to where it truly is, by the error of a rover that was at `pose` and believed to be at `believed`. */
export function corrected(believed: Place, pose: Place, x: number, y: number): [number, number] {
  const [c, s] = [Math.cos(believed.heading), Math.sin(believed.heading)];
  const [dx, dy] = [x - believed.x, y - believed.y];
  return placed(pose, c * dx + s * dy, c * dy - s * dx);
}

/** The map lies in the believed world; `atTruth` moves it by the rover's error of the moment at which it looked. */
export function frameOf(step: Step, atTruth: boolean): Frame {
  const { believed, pose, look, spline_start: start } = step;
  const place = (x: number, y: number): [number, number] => (atTruth ? corrected(look.believed, pose, x, y) : [x, y]);
  return { place, ahead: (x, y) => place(...placed(believed, x, y)), along: (x, y) => place(...placed(start, x, y)) };
}

/** A point of an arc in the rover's frame, `share` of its drawn length along. */
export function arcPoint(vote: Vote, share: number): Place {
  const k = vote.curvature;
  const reach = vote.kind === "backward" ? -BACK_ARC_M : ARC_M;
  // Tight arcs stop before they would close.
  const length = Math.abs(k * reach) > 2.4 ? (Math.sign(reach) * 2.4) / Math.abs(k) : reach;
  const s = share * length;
  if (Math.abs(k * s) < 1e-6) return { x: s, y: (k * s * s) / 2, heading: k * s };
  return { x: Math.sin(k * s) / k, y: (1 - Math.cos(k * s)) / k, heading: k * s };
}

/** Turns in place are arcs beside the rover, to the side that it would turn to. */
export function turnPoint(vote: Vote, share: number): Place {
  const side = vote.curvature < 0 ? -1 : 1;
  const angle = side * (0.5 + 0.8 * share);
  return { x: TURN_RADIUS_M * Math.cos(angle), y: TURN_RADIUS_M * Math.sin(angle), heading: angle + (side * Math.PI) / 2 };
}

export function elevationRange(elevation: (number | null)[]): { low: number; high: number } {
  let low = Infinity;
  let high = -Infinity;
  for (const z of elevation) {
    if (z === null) continue;
    low = Math.min(low, z);
    high = Math.max(high, z);
  }
  return high > low ? { low, high } : { low: low - 0.5, high: low + 0.5 };
}

// ---- Where the splines of a decision lead: two clothoids each, in the frame in which they begin.

/** Indices in the order of drawing: the chosen one last, on top, before it the better ones. */
export function drawingOrder(splines: Splines): number[] {
  const order = splines.merged.map((_, i) => i);
  return order.sort((a, b) => Number(a === splines.chosen) - Number(b === splines.chosen) || splines.merged[a]! - splines.merged[b]!);
}

/** Heading after `s`: the integral of a curvature that is linear between the start, the middle and the end. */
function headingAfter(splines: Splines, i: number, s: number): number {
  const half = splines.length[i]! / 2;
  const knots = [splines.start[i]!, splines.first[i]!, splines.second[i]!] as const;
  const ramp = (from: number, to: number, way: number): number => from * way + ((to - from) * way * way) / (2 * half);
  const beyond = Math.max(0, s - half);
  return ramp(knots[0], knots[1], Math.min(s, half)) + (beyond > 0 ? ramp(knots[1], knots[2], beyond) : 0);
}

/** Points at multiples of 1 / PIECES of the length; beyond 1 straight on. */
export function splinePath(splines: Splines, i: number): (share: number) => Place {
  const length = splines.length[i]!;
  const step = length / PIECES;
  const points: Place[] = [{ x: 0, y: 0, heading: 0 }];
  for (let k = 1; k <= PIECES; ++k) {
    const before = points[k - 1]!;
    const middle = headingAfter(splines, i, (k - 0.5) * step);
    const heading = headingAfter(splines, i, k * step);
    // Simpson's rule of x' = cos, y' = sin of the heading.
    const mean = (of: (angle: number) => number): number => (of(before.heading) + 4 * of(middle) + of(heading)) / 6;
    points.push({ x: before.x + step * mean(Math.cos), y: before.y + step * mean(Math.sin), heading });
  }
  const end = points[PIECES]!;
  return (share) => {
    if (share <= 1) return points[Math.round(share * PIECES)]!;
    const on = (share - 1) * length;
    return { x: end.x + on * Math.cos(end.heading), y: end.y + on * Math.sin(end.heading), heading: end.heading };
  };
}
