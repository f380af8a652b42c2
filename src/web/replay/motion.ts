// What the rover did at any time: samples, and what lies between two of them.
import type { Motion, Place } from "./payload";

export interface Quaternion { w: number; x: number; y: number; z: number }

/** All that is shown of one moment. */
export interface Moment {
  t: number;
  /** Of the last sample at or before t. */
  index: number;
  x: number; y: number; z: number;
  attitude: Quaternion;
  heading: number;
  joints: Record<string, number>;
  believed: Place;
  /** What it does until the next sample, which tells of it. */
  activity: string;
  tilt: number;
  /** Distance from the believed to the true position, m. */
  error: number;
}

/** Index of the last entry <= value of an ascending list; -1 where all are greater. Cost: log n. */
export function lastAtOrBefore(values: ArrayLike<number>, value: number): number {
  let low = 0;
  let high = values.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (values[middle]! <= value) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

/** Heading of the x axis of an attitude, rad. */
export function headingOf(q: Quaternion): number {
  return Math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z));
}

/** The angle from `a` to `b` the short way round, in (-pi, pi]. */
export function angleBetween(a: number, b: number): number {
  const turn = (b - a) % (2 * Math.PI);
  if (turn > Math.PI) return turn - 2 * Math.PI;
  return turn <= -Math.PI ? turn + 2 * Math.PI : turn;
}

/** Spherical interpolation, the short way round; both must be unit quaternions. */
export function slerp(a: Quaternion, b: Quaternion, share: number): Quaternion {
  let cosine = a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z;
  const sign = cosine < 0 ? -1 : 1;
  cosine = Math.min(1, Math.abs(cosine));
  const angle = Math.acos(cosine);
  // Below this the arc is a line to double precision, and its sine no longer divides.
  const near = angle < 1e-6;
  const wa = near ? 1 - share : Math.sin((1 - share) * angle) / Math.sin(angle);
  const wb = sign * (near ? share : Math.sin(share * angle) / Math.sin(angle));
  return { w: wa * a.w + wb * b.w, x: wa * a.x + wb * b.x, y: wa * a.y + wb * b.y, z: wa * a.z + wb * b.z };
}

const mix = (a: number, b: number, share: number): number => share === 0 ? a : share === 1 ? b : a + share * (b - a);

export class Course {
  private readonly breaks: Set<number> = new Set(this.motion.breaks);
  private readonly names: string[] = Object.keys(this.motion.joints);

  constructor(readonly motion: Motion) {
  }

  get length(): number { return this.motion.t.length; }

  get start(): number { return this.motion.t[0] ?? 0; }

  get end(): number { return this.motion.t[this.length - 1] ?? 0; }

  /** Whether operators set the rover elsewhere between sample `index` - 1 and `index`. */
  brokenBefore(index: number): boolean { return this.breaks.has(index); }

  attitude(index: number): Quaternion {
    const { qw, qx, qy, qz } = this.motion;
    return { w: qw[index] ?? 1, x: qx[index] ?? 0, y: qy[index] ?? 0, z: qz[index] ?? 0 };
  }

  /** Whether nothing moves between sample `index` and the next. */
  standsAfter(index: number): boolean {
    const { x, y, z, believed_heading: heading, joints } = this.motion;
    const next = index + 1;
    const moved = Math.hypot(x[next]! - x[index]!, y[next]! - y[index]!, z[next]! - z[index]!);
    if (this.brokenBefore(next) || moved > STILL_M) return false;
    const a = this.attitude(index);
    const b = this.attitude(next);
    if (Math.abs(a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z) < 1 - STILL_RAD * STILL_RAD / 8) return false;
    if (Math.abs(heading[next]! - heading[index]!) > STILL_RAD) return false;
    return this.names.every((name) => Math.abs(joints[name]![next]! - joints[name]![index]!) <= STILL_RAD);
  }

  /** Between samples poses are interpolated, save where operators moved the rover: there it waits. */
  at(t: number): Moment {
    const { motion } = this;
    const index = Math.max(0, lastAtOrBefore(motion.t, t));
    const next = Math.min(index + 1, this.length - 1);
    const from = motion.t[index] ?? 0;
    const span = (motion.t[next] ?? from) - from;
    const hold = span <= 0 || this.brokenBefore(next);
    const share = hold ? 0 : Math.min(1, Math.max(0, (t - from) / span));
    const value = (list: number[]): number => mix(list[index] ?? 0, list[next] ?? 0, share);
    const attitude = share === 0 ? this.attitude(index) : slerp(this.attitude(index), this.attitude(next), share);
    const joints: Record<string, number> = {};
    for (const name of this.names) joints[name] = value(motion.joints[name]!);
    const heading = motion.believed_heading[index] ?? 0;
    const turned = angleBetween(heading, motion.believed_heading[next] ?? heading);
    const believed = { x: value(motion.believed_x), y: value(motion.believed_y), heading: heading + share * turned };
    const x = value(motion.x);
    const y = value(motion.y);
    return {
      t,
      index,
      x,
      y,
      z: value(motion.z),
      attitude,
      heading: headingOf(attitude),
      joints,
      believed,
      activity: motion.activity_names[motion.activity[t > from ? next : index] ?? -1] ?? "",
      tilt: value(motion.tilt),
      error: Math.hypot(believed.x - x, believed.y - y),
    };
  }
}

// Less than what can be seen, more than what rounding of the data makes.
const STILL_M = 2e-4;
const STILL_RAD = 2e-3;
