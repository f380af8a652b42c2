// Times, places, turns and colours as Foxglove's messages want them.
import type { Color, Pose, Quaternion, Time, Vector3 } from "@foxglove/schemas";

const NANOSECONDS = 1_000_000_000;

export const nanoseconds = (t: number): number => Math.round(t * NANOSECONDS);

export function timestamp(t: number): Time {
  const all = nanoseconds(t);
  return { sec: Math.floor(all / NANOSECONDS), nsec: all % NANOSECONDS };
}

export const vector = (x: number, y: number, z: number): Vector3 => ({ x, y, z });

export const fromList = ([x = 0, y = 0, z = 0]: readonly number[]): Vector3 => ({ x, y, z });

export const NO_TURN: Quaternion = { x: 0, y: 0, z: 0, w: 1 };

/** By `angle` rad about `axis` of any length but 0. */
export function turnAbout(axis: Vector3, angle: number): Quaternion {
  const scale = Math.sin(angle / 2) / Math.hypot(axis.x, axis.y, axis.z);
  return { x: scale * axis.x, y: scale * axis.y, z: scale * axis.z, w: Math.cos(angle / 2) };
}

export const yaw = (angle: number): Quaternion => turnAbout(vector(0, 0, 1), angle);

/** The turn that brings the z axis into a direction. */
export function alongZ({ x, y, z }: Vector3): Quaternion {
  const flat = Math.hypot(x, y);
  if (flat === 0) return z < 0 ? turnAbout(vector(1, 0, 0), Math.PI) : NO_TURN;
  return turnAbout(vector(-y, x, 0), Math.atan2(flat, z));
}

export const pose = (position: Vector3, orientation: Quaternion = NO_TURN): Pose => ({ position, orientation });

export const colour = (r: number, g: number, b: number, a = 1): Color => ({ r, g, b, a });
