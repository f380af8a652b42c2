// Heights of the ground between the points that the page holds.
import type { Course, Ground } from "../payload";

/** As walls are drawn: they have none. */
export const WALL_HEIGHT_M = 0.35;

export interface Extent { xMin: number; xMax: number; yMin: number; yMax: number }

export class GroundHeights {
  constructor(private readonly ground: Ground) {}

  get empty(): boolean { return this.ground.nx < 2 || this.ground.ny < 2; }

  /** Bilinear; beyond the edge as at the edge. */
  at(x: number, y: number): number {
    const { x0, y0, step, nx, ny, z } = this.ground;
    if (this.empty) return z[0] ?? 0;
    const u = Math.min(nx - 1, Math.max(0, (x - x0) / step));
    const v = Math.min(ny - 1, Math.max(0, (y - y0) / step));
    const ix = Math.min(nx - 2, Math.floor(u));
    const iy = Math.min(ny - 2, Math.floor(v));
    const row = iy * nx + ix;
    const low = (1 - (u - ix)) * z[row]! + (u - ix) * z[row + 1]!;
    const high = (1 - (u - ix)) * z[row + nx]! + (u - ix) * z[row + nx + 1]!;
    return (1 - (v - iy)) * low + (v - iy) * high;
  }
}

export function extentOf(course: Course): Extent {
  const { x_min, x_max, y_min, y_max } = course.bounds;
  return { xMin: x_min, xMax: x_max, yMin: y_min, yMax: y_max };
}

/** The triangles of nx by ny points, row by row, as three indices each. */
export function gridFaces(nx: number, ny: number): number[] {
  return Array.from({ length: Math.max(0, nx - 1) * Math.max(0, ny - 1) }, (_, i) => {
    const corner = Math.floor(i / (nx - 1)) * nx + (i % (nx - 1));
    return [corner, corner + 1, corner + nx + 1, corner, corner + nx + 1, corner + nx];
  }).flat();
}

/** 1, 2 or 5 times a power of ten, such that some `count` of them span `length`. */
export function niceStep(length: number, count: number): number {
  const raw = Math.max(1e-6, length / count);
  const power = 10 ** Math.floor(Math.log10(raw));
  const share = raw / power;
  return power * (share <= 1.5 ? 1 : share <= 3.5 ? 2 : share <= 7.5 ? 5 : 10);
}

/**
 * The part of a wall that lies within the ground: from foot + from * along to foot + to * along, where
 * along is (-ny, nx). Null where the wall passes it by.
 */
export function wallWithin(
  { nx, ny, offset }: Course["walls"][number],
  extent: Extent,
): { foot: { x: number; y: number }; from: number; to: number } | null {
  const reach = Math.hypot(extent.xMax - extent.xMin, extent.yMax - extent.yMin);
  const middle = { x: (extent.xMin + extent.xMax) / 2, y: (extent.yMin + extent.yMax) / 2 };
  const away = offset - (nx * middle.x + ny * middle.y);
  const foot = { x: middle.x + away * nx, y: middle.y + away * ny };
  const ends = clip(foot, { x: -ny, y: nx }, extent, reach);
  return ends && { foot, ...ends };
}

// The part of a line through `foot` that lies within the ground, a little beyond its edge.
function clip(
  foot: { x: number; y: number },
  along: { x: number; y: number },
  extent: Extent,
  reach: number,
): { from: number; to: number } | null {
  const slack = 0.01 * reach;
  let from = -reach;
  let to = reach;
  const sides: [number, number, number, number][] = [
    [foot.x, along.x, extent.xMin - slack, extent.xMax + slack],
    [foot.y, along.y, extent.yMin - slack, extent.yMax + slack],
  ];
  for (const [start, rate, low, high] of sides) {
    if (Math.abs(rate) < 1e-9) {
      if (start < low || start > high) return null;
      continue;
    }
    const ends = [(low - start) / rate, (high - start) / rate].sort((a, b) => a - b);
    from = Math.max(from, ends[0]!);
    to = Math.min(to, ends[1]!);
  }
  return to > from ? { from, to } : null;
}
