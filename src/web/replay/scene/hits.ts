// Where rays of light meet ground and rocks, in their true shapes.
import { Vector3 } from "three";
import type { Rock } from "../payload";
import type { GroundHeights } from "./ground";

const STEP_M = 0.04;
const HALVINGS = 8;

export interface PlacedRock {
  rock: Rock;
  x: number;
  y: number;
  z: number;
}

/** Distance to the first surface along a unit ray; null where there is none within `reach`. */
export function firstHit(from: Vector3, ray: Vector3, reach: number, heights: GroundHeights, rocks: PlacedRock[]): number | null {
  let nearest = groundHit(from, ray, reach, heights);
  for (const rock of rocks) {
    const hit = rockHit(from, ray, rock);
    if (hit !== null && hit < (nearest ?? reach)) nearest = hit;
  }
  return nearest;
}

function groundHit(from: Vector3, ray: Vector3, reach: number, heights: GroundHeights): number | null {
  const above = (s: number): number => from.z + s * ray.z - heights.at(from.x + s * ray.x, from.y + s * ray.y);
  for (let s = 0; s < reach; s += STEP_M) {
    if (above(s + STEP_M) > 0) continue;
    let [low, high] = [s, s + STEP_M];
    for (let i = 0; i < HALVINGS; ++i) {
      const middle = (low + high) / 2;
      if (above(middle) > 0) low = middle;
      else high = middle;
    }
    return high;
  }
  return null;
}

/** Every rock is a quadric in its own unit coordinates: rho^2 = A s + B s^2, see payload.ts; ellipsoids have z^2 + rho^2 = 1. */
function rockHit(from: Vector3, ray: Vector3, { rock, x, y, z }: PlacedRock): number | null {
  const [c, s] = [Math.cos(rock.yaw), Math.sin(rock.yaw)];
  const own = (dx: number, dy: number, dz: number): Vector3 =>
    new Vector3((c * dx + s * dy) / rock.a, (c * dy - s * dx) / rock.b, dz / rock.c);
  const p = own(from.x - x, from.y - y, from.z - z);
  const d = own(ray.x, ray.y, ray.z);
  const { growth } = rock;
  const [u, v] = growth ? [1 - p.z, -d.z] : [p.z, d.z];
  const [linear, square] = growth ? [growth, 1 - growth] : [0, -1];
  // F(t) = rho^2 - linear w - square w^2 - constant with w = u + v t.
  const constant = growth ? 0 : 1;
  const a = d.x * d.x + d.y * d.y - square * v * v;
  const b = 2 * (p.x * d.x + p.y * d.y) - linear * v - 2 * square * u * v;
  const f = p.x * p.x + p.y * p.y - linear * u - square * u * u - constant;
  const root = b * b - 4 * a * f;
  if (root < 0 || Math.abs(a) < 1e-12) return null;
  const ends = [(-b - Math.sqrt(root)) / (2 * a), (-b + Math.sqrt(root)) / (2 * a)].sort((one, other) => one - other);
  // A cap ends at its base, and its quadric goes on above its top.
  const on = (t: number): boolean => t > 0 && (!growth || (u + v * t >= 0 && u + v * t <= 1));
  return ends.find(on) ?? null;
}
