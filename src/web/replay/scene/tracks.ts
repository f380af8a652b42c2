// Prints that the wheels leave in the soil, from where the record says that they rolled. The soil of the
// simulator does not change: prints are drawn only.

import { type BufferGeometry, DoubleSide, Group, Mesh, MeshBasicMaterial, Quaternion, Vector3 } from "three";

import { type Course, lastAtOrBefore, type Moment } from "../motion";
import type { Palette } from "../palette";
import type { RoverShape, Shape } from "../payload";
import { geometryOf } from "./geometry";
import type { GroundHeights } from "./ground";
import { MOST_TRACK_TRIANGLES } from "./limits";
import { PRINT_TILE_M, printTexture } from "./textures";

const LIFT_M = 0.003;
// A wheel whose lowest point is higher above the soil leaves no print: it is on a rock.
const TOUCHES_M = 0.02;
// Pieces of a track are at least this long, and longer where there would be too many.
const LEAST_PIECE_M = 0.02;
const CORNERS = 6;

/** The print's middle below a wheel, and half of its width across. */
interface Print {
  x: number; y: number; acrossX: number; acrossY: number;
  /** Length of the track so far, m. */
  along: number;
}

interface Piece { sample: number; from: Print; to: Print }

/** Where the track of one wheel may go on: null where the wheel touches no soil. */
interface Anchors {
  samples: number[];
  prints: (Print | null)[];
}

export class Tracks {
  readonly group = new Group();
  private readonly material = new MeshBasicMaterial({ map: printTexture(), transparent: true, side: DoubleSide, depthWrite: false, polygonOffset: true, polygonOffsetFactor: -2 });
  private readonly places = new WheelPlaces(this.rover);
  private readonly anchors = this.places.wheels.map((): Anchors => ({ samples: [], prints: [] }));
  private readonly pieces = this.record();
  private readonly pieceSamples = this.pieces.map(({ sample }) => sample);
  private readonly done = new Mesh(ribbons(this.pieces, this.heights), this.material);
  private readonly tip = new Mesh(ribbons([], this.heights), this.material);

  constructor(private readonly course: Course, private readonly rover: RoverShape, private readonly heights: GroundHeights) {
    for (const mesh of [this.done, this.tip]) {
      mesh.frustumCulled = false;
      // Before the maps and arcs that lie on the soil.
      mesh.renderOrder = 0.5;
      this.group.add(mesh);
    }
  }

  recolour(palette: Palette): void { this.material.color.set(palette.track); }

  show(moment: Moment, visible: boolean): void {
    this.group.visible = visible;
    if (!visible) return;
    this.done.geometry.setDrawRange(0, CORNERS * this.countAt(moment.index));
    const here = this.places.at(moment);
    const growing: Piece[] = [];
    this.anchors.forEach(({ samples, prints }, wheel) => {
      const from = prints[lastAtOrBefore(samples, moment.index)];
      const to = from && this.printOf(here[wheel]!, wheel, from);
      if (from && to) growing.push({ sample: moment.index, from, to });
    });
    this.tip.geometry.dispose();
    this.tip.geometry = ribbons(growing, this.heights);
  }

  /** Middles of the prints that are drawn, from the first on: x, y and width. */
  drawn(): { x: number; y: number; width: number }[] {
    const { count } = this.done.geometry.drawRange;
    const drawn = this.group.visible ? this.pieces.slice(0, count / CORNERS) : [];
    return drawn.map(({ to: { x, y, acrossX, acrossY } }) => ({ x, y, width: 2 * Math.hypot(acrossX, acrossY) }));
  }

  private countAt(sample: number): number { return lastAtOrBefore(this.pieceSamples, sample) + 1; }

  private record(): Piece[] {
    const { course } = this;
    const places = Array.from({ length: course.length }, (_, i) => this.places.at(poseOf(course, i)));
    const spacing = Math.max(LEAST_PIECE_M, (2 * travelOf(places)) / MOST_TRACK_TRIANGLES);
    const pieces: Piece[] = [];
    places.forEach((wheels, sample) => {
      wheels.forEach((place, wheel) => {
        const { samples, prints } = this.anchors[wheel]!;
        const from = course.brokenBefore(sample) ? null : (prints[prints.length - 1] ?? null);
        const to = this.printOf(place, wheel, from);
        if (from && to && to.along - from.along < spacing) return;
        if (from && to) pieces.push({ sample, from, to });
        samples.push(sample);
        prints.push(to);
      });
    });
    return pieces;
  }

  private printOf({ center, axle }: WheelPlace, wheel: number, before: Print | null): Print | null {
    const { radius, width } = this.places.wheels[wheel]!.shape;
    const { x, y, z } = center;
    if (z - radius - this.heights.at(x, y) > TOUCHES_M) return null;
    const flat = Math.hypot(axle.x, axle.y);
    const half = width / 2 / Math.max(1e-6, flat);
    const along = before ? before.along + Math.hypot(x - before.x, y - before.y) : 0;
    return { x, y, acrossX: half * axle.x, acrossY: half * axle.y, along };
  }
}

function poseOf(course: Course, sample: number): RoverPose {
  const { x, y, z, joints } = course.motion;
  const angles = Object.entries(joints).map(([name, values]) => [name, values[sample]!]);
  return { x: x[sample]!, y: y[sample]!, z: z[sample]!, attitude: course.attitude(sample), joints: Object.fromEntries(angles) };
}

/** How far all wheels went together, m. */
function travelOf(places: WheelPlace[][]): number {
  let sum = 0;
  for (let i = 1; i < places.length; ++i) {
    places[i]!.forEach(({ center }, wheel) => {
      const before = places[i - 1]![wheel]!.center;
      sum += Math.hypot(center.x - before.x, center.y - before.y);
    });
  }
  return sum;
}

/** Two triangles a piece, from edge to edge of both prints. */
function ribbons(pieces: Piece[], heights: GroundHeights): BufferGeometry {
  const positions: number[] = [];
  const uv: number[] = [];
  const put = ({ x, y, acrossX, acrossY, along }: Print, side: 1 | -1): void => {
    const [px, py] = [x + side * acrossX, y + side * acrossY];
    positions.push(px, py, heights.at(px, py) + LIFT_M);
    uv.push(0.5 + 0.5 * side, along / PRINT_TILE_M);
  };
  for (const { from, to } of pieces) {
    for (const [print, side] of [[from, -1], [to, -1], [to, 1], [from, -1], [to, 1], [from, 1]] as const) put(print, side);
  }
  return geometryOf(positions, { uv });
}

// ---- Where the wheels are, from the pose of the rover and the angles of its joints.

type Wheel = Extract<Shape, { kind: "wheel" }>;

interface WheelPlace {
  center: Vector3;
  /** Unit vector along the axle, to the left. */
  axle: Vector3;
}

type RoverPose = Pick<Moment, "x" | "y" | "z" | "attitude" | "joints">;

class WheelPlaces {
  /** In the order of the links. */
  readonly wheels: { link: number; shape: Wheel }[] = [];
  private readonly links: { name: string; parent: number; pivot: Vector3; axis: Vector3 }[];

  constructor({ links }: RoverShape) {
    this.links = links.map(({ name, parent, pivot, axis }) => {
      return { name, parent, pivot: new Vector3(...pivot), axis: new Vector3(...axis).normalize() };
    });
    links.forEach(({ shapes }, link) => {
      for (const shape of shapes) if (shape.kind === "wheel") this.wheels.push({ link, shape });
    });
  }

  at({ x, y, z, attitude, joints }: RoverPose): WheelPlace[] {
    const turns: Quaternion[] = [];
    const places: Vector3[] = [];
    this.links.forEach(({ name, parent, pivot, axis }, i) => {
      if (i === 0) {
        turns.push(new Quaternion(attitude.x, attitude.y, attitude.z, attitude.w).normalize());
        places.push(new Vector3(x, y, z));
        return;
      }
      places.push(pivot.clone().applyQuaternion(turns[parent]!).add(places[parent]!));
      turns.push(turns[parent]!.clone().multiply(new Quaternion().setFromAxisAngle(axis, joints[name] ?? 0)));
    });
    return this.wheels.map(({ link, shape }) => ({
      center: new Vector3(...shape.center).applyQuaternion(turns[link]!).add(places[link]!),
      axle: new Vector3(0, 1, 0).applyQuaternion(turns[link]!),
    }));
  }
}
