// Where the arcs, the splines and the map of a decision lie.
import type { Place, Step, Vote } from "../payload";

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

function from(pose: Place, x: number, y: number): [number, number] {
  const [c, s] = [Math.cos(pose.heading), Math.sin(pose.heading)];
  return [pose.x + c * x - s * y, pose.y + s * x + c * y];
}

/** The map lies in the believed world; `atTruth` moves it by the rover's error of the moment at which it looked. */
export function frameOf(step: Step, atTruth: boolean): Frame {
  const { believed, pose, look, spline_start: start } = step;
  const place = (x: number, y: number): [number, number] => {
    if (!atTruth) return [x, y];
    const { x: x0, y: y0, heading } = look.believed;
    const [c, s] = [Math.cos(heading), Math.sin(heading)];
    return from(pose, c * (x - x0) + s * (y - y0), c * (y - y0) - s * (x - x0));
  };
  return {
    place,
    ahead: (x, y) => place(...from(believed, x, y)),
    along: (x, y) => place(...from(start, x, y)),
  };
}

export interface ArcPoint {
  x: number;
  y: number;
  heading: number;
}

/** A point of an arc in the rover's frame, `share` of its drawn length along. */
export function arcPoint(vote: Vote, share: number): ArcPoint {
  const k = vote.curvature;
  const reach = vote.kind === "backward" ? -BACK_ARC_M : ARC_M;
  // Tight arcs stop before they would close.
  const length = Math.abs(k * reach) > 2.4 ? (Math.sign(reach) * 2.4) / Math.abs(k) : reach;
  const s = share * length;
  if (Math.abs(k * s) < 1e-6) return { x: s, y: (k * s * s) / 2, heading: k * s };
  return { x: Math.sin(k * s) / k, y: (1 - Math.cos(k * s)) / k, heading: k * s };
}

/** Turns in place are arcs beside the rover, to the side that it would turn to. */
export function turnPoint(vote: Vote, share: number): ArcPoint {
  const side = vote.curvature < 0 ? -1 : 1;
  const angle = side * (0.5 + 0.8 * share);
  return {
    x: TURN_RADIUS_M * Math.cos(angle),
    y: TURN_RADIUS_M * Math.sin(angle),
    heading: angle + (side * Math.PI) / 2,
  };
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
