// Heights of the ground between the points that the page holds.
import type { Course, Ground } from "../payload";

export interface Extent {
  xMin: number;
  xMax: number;
  yMin: number;
  yMax: number;
}

export class GroundHeights {
  constructor(private readonly ground: Ground) {}

  get empty(): boolean {
    return this.ground.nx < 2 || this.ground.ny < 2;
  }

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

/** 1, 2 or 5 times a power of ten, such that some `count` of them span `length`. */
export function niceStep(length: number, count: number): number {
  const raw = Math.max(1e-6, length / count);
  const power = 10 ** Math.floor(Math.log10(raw));
  const share = raw / power;
  return power * (share <= 1.5 ? 1 : share <= 3.5 ? 2 : share <= 7.5 ? 5 : 10);
}
