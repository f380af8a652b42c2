// Where the splines of a decision lead: two clothoids each, in the frame in which they begin.
import type { Splines } from "../payload";
import { type ArcPoint, PIECES } from "./arcs";

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
export function splinePath(splines: Splines, i: number): (share: number) => ArcPoint {
  const length = splines.length[i]!;
  const step = length / PIECES;
  const points: ArcPoint[] = [{ x: 0, y: 0, heading: 0 }];
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
