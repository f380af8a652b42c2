// What `rockyard replay` writes into its page (replay/data.h). SI units; W is the world
// (x from start to goal, z up), R the rover (x forward, y left, z up, origin on the ground under the
// chassis while it stands on level ground). Angles in rad. What is undefined is null.

export interface ReplayPayload {
  version: 1;
  title: string; scenario: string; cell: string;
  seed: number | string;
  trial: number;
  outcome: string; detail: string;
  /** Path of the setting that decided how it ended; "" where none did. */
  cause_setting: string;
  /** Whether the drive repeated the stored record bit for bit; null where there was none. */
  repeats_stored: boolean | null;
  /** Hash of the trial's record. */
  record_hash: string;
  command: string;
  provenance: Record<string, unknown>;
  /** The record of the trial, column by column. */
  record: { name: string; unit: string; value: number | null }[];
  course: Course;
  world: World;
  ground: Ground;
  rocks: Rock[];
  /** Where rocks were pushed: rock index, time, new centre; in the order of time. */
  rock_moves: RockMove[];
  rover: RoverShape;
  sensor: Sensor;
  motion: Motion;
  scans: Scan[];
  steps: Step[];
  /** What stereo cameras saw; null where the trial had no images. */
  eyes: Eyes | null;
  /** What the navigator shows of itself; null where it shows nothing. */
  overlays: Overlays | null;
  events: TrialEvent[];
  /** A second trial, shown beside this one on one clock; null where there is none. */
  beside: ReplayPayload | null;
}

export interface Course {
  start: { x: number; y: number; heading: number };
  goal: { x: number; y: number; radius: number };
  /** The designated goal, where it was designated with errors. */
  told_goal: { x: number; y: number };
  /** Where the rover drives to before the goal, in that order. */
  waypoints: { x: number; y: number }[];
  /** Corners of the area that holds terrain. */
  bounds: { x_min: number; x_max: number; y_min: number; y_max: number };
  /** Vertical planes that bound the arena: normal . p = offset, the normal points out of it. They have no upper edge. */
  walls: { nx: number; ny: number; offset: number }[];
  /** y of the lines at which operators reflect the rover; none but in the reflected arena. */
  mirror_lines: number[];
}

/** Where the drive takes place. */
export interface World {
  /** m/s2. */
  gravity: number;
  /** Where the sun, or a lamp, stands: above the horizon, and from x to the left (sensors.sun). */
  sun: { elevation: number; azimuth: number };
  arena: {
    kind: "open" | "walled" | "virtual_unfolded" | "virtual_reflected";
    /** The arena itself, without margins. */
    x_min: number; x_max: number; y_min: number; y_max: number;
    /** Of virtual arenas: the layout is mirrored at y = +- this; else 0. */
    mirror_line: number;
  };
}

/** The terrain sensor that the drive goes by, as it truly is, in R. */
export interface Sensor {
  /** As a scenario names it: "light_stripe", "stereo", ... */
  name: string;
  /** Farthest range, m. */
  reach: number;
  /** Light planes, from left to right: directions within half_fan of the axis, normal to `normal`. */
  lasers: { emitter: [number, number, number]; normal: [number, number, number]; axis: [number, number, number]; half_fan: number }[];
  /** Unit rays once around the edge of each image, from its upper left corner along its upper edge; equally many of a side. */
  cameras: { name: string; eye: [number, number, number]; rim: [number, number, number][] }[];
}

/** Heights of the ground without rocks, row-major: z[iy * nx + ix] at (x0 + ix step, y0 + iy step). */
export interface Ground { x0: number; y0: number; step: number; nx: number; ny: number; z: number[] }

/** An ellipsoid, partly below the ground. */
export interface Rock {
  x: number; y: number; z: number;
  /** Semi-axes along its own x, y, z. */
  a: number; b: number; c: number;
  yaw: number;
  /** Of its top above the ground. */
  height: number;
  /**
   * A of a cap that stands on its centre, as wide as sqrt(A s + (1 - A) s^2) times its base at the
   * share s of its height c below its top; absent for ellipsoids.
   */
  growth?: number;
}

export interface RockMove { rock: number; t: number; x: number; y: number; z: number }

/**
 * The rover as links with boxes, cylinders, capsules and spheres. Link 0 is the chassis, whose frame
 * is R. Each other link turns about `axis` through `pivot` (both in the frame of its parent, on level
 * ground with all angles 0, where all frames are parallel to R) by the channel of `motion.joints`
 * that has its name.
 */
export interface RoverShape {
  links: {
    name: string;
    parent: number;
    pivot: [number, number, number]; axis: [number, number, number];
    shapes: Shape[];
  }[];
}

export type Shape =
  | { kind: "box"; part: string; center: [number, number, number]; size: [number, number, number] }
  /** Axis along y. */
  | { kind: "wheel"; part: string; center: [number, number, number]; radius: number; width: number }
  | { kind: "capsule"; part: string; from: [number, number, number]; to: [number, number, number]; radius: number }
  | { kind: "sphere"; part: string; center: [number, number, number]; radius: number };

/** Of `Motion`, with an entry for each moment. */
export const MOTION_COLUMNS = [
  "t",
  // True pose: origin of R in W, and the unit quaternion of its attitude.
  "x", "y", "z", "qw", "qx", "qy", "qz",
  // As the rover believes.
  "believed_x", "believed_y", "believed_heading",
  // Of the stretch that ends at the moment: indices into activity_names: drive, turn, steer, scan, stall, image, compute, overhead.
  "activity",
  "tilt",
] as const;

/**
 * One entry per moment, in the order of time; equal lengths. Between two moments positions, joints and
 * the believed pose go linearly in time (headings the short way round), attitudes by slerp: that is
 * within the tolerances of the truth. At a break two moments share one time.
 */
export interface Motion extends Record<(typeof MOTION_COLUMNS)[number], number[]> {
  /** By link name: rad. */
  joints: Record<string, number[]>;
  activity_names: string[];
  /** Indices of samples at which operators set the rover back (mirrored arena): the path breaks before. */
  breaks: number[];
  /** m, of true and believed positions. */
  position_tolerance: number;
  /** rad, of attitude and believed heading; joints have twice that. */
  angle_tolerance: number;
}

/** One scan of the light stripe sensor. */
export interface Scan {
  /** When it begins; it ends with the stretch of motion whose activity is scan. */
  t: number;
  /** Of the rover when it scanned. */
  x: number; y: number; heading: number;
  /** Points as the rover triangulates them, in W through the true pose; stripe and height as believed. */
  points: { x: number; y: number; z: number; stripe: number; height: number }[];
  /** Per stripe from left to right, of this scan alone. */
  hazards: boolean[];
}

/**
 * One decision of a map-based navigator. Of more than 240 steps only every second, or third, ... has
 * elevations, points and all of its splines; the others have nulls, none, and the chosen one.
 */
export interface Step {
  t: number; step: number;
  /** When the points were taken, at most t, and where the rover believed to be then. */
  look: { t: number; believed: Place };
  /** Where the rover believes to be as it decides: the arcs begin there, and the map lies in the believed world. */
  believed: Place;
  /** Where it truly was when the points were taken. */
  pose: Place;
  behind: boolean;
  map: {
    x0: number; y0: number; xstep: number; ystep: number; nx: number; ny: number;
    /** Row-major [iy][ix]; 0 to 255, or -1 where unknown. */
    goodness: number[];
    certainty: number[];
    /** m, null where there are no points. */
    elevation: (number | null)[];
  };
  votes: Vote[];
  /** Null where the rover chooses among arcs. */
  splines: Splines | null;
  /** Where they begin, as believed. */
  spline_start: Place;
  /** At most 120 of the points that the look gave, in W through the true pose. */
  points: [number, number, number][];
}

export interface Place { x: number; y: number; heading: number }

/** Splines of two clothoids, one entry each: the curvature is linear between its start, the middle and the end. */
export interface Splines {
  /** 1/m, positive to the left. */
  start: number[]; first: number[]; second: number[];
  /** m. */
  length: number[];
  /** From 0 to 255. */
  hazard: number[]; certainty: number[]; waypoint: number[]; merged: number[];
  /** Whether the steering motors keep up with it. */
  feasible: boolean[];
  /** Which one is driven, -1 where none is. */
  chosen: number;
}

/** Looks of stereo cameras that took images, in the order of time. */
export interface Eyes {
  /** Of the looks ahead, and of those behind, one of so many is here. */
  every: number;
  looks: StereoLook[];
}

export interface StereoLook {
  t: number;
  /** Counts every look of the trial from 0. */
  number: number;
  behind: boolean;
  /** Points that the look gave. */
  points: number;
  /** Disparities at the violet and at the yellow end of the colours, px. */
  least: number;
  most: number;
  /** PNG files in base64: the left image as it was matched, and its disparities in colours, black where there is none. */
  left: string;
  disparity: string;
}

/** What a navigator of any kind shows of its decisions, in the order of time. */
export interface Overlays {
  /** One of so many is here. */
  every: number;
  /** Each holds until the next one. None where the first alone would be too large for a page. */
  shown: Overlay[];
}

export interface Overlay {
  t: number;
  /** Where the rover truly was at t, and where it believed to be: lines and grids lie in the believed world. */
  pose: Place; believed: Place;
  lines: { name: string; points: [number, number][] }[];
  grids: OverlayGrid[];
}

/** Square cells from the lower corner of the first one, row-major [iy][ix]. */
export interface OverlayGrid {
  name: string;
  x0: number; y0: number; step: number; nx: number; ny: number;
  /** 0 (free) to 255 (blocked), or -1 where unknown. */
  values: number[];
}

export interface Vote {
  kind: "forward" | "backward" | "turn";
  /** 1/m, positive to the left; of turns the direction. */
  curvature: number;
  hazard: number; certainty: number; waypoint: number; merged: number;
  chosen: boolean;
}

export interface TrialEvent {
  t: number;
  /** "hazard", "look", "chosen", "felt", "scrape", "reflection", "turn", "stall", "end", ... */
  kind: string;
  detail: string;
  x: number; y: number; heading: number;
}
