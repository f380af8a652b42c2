// One decision of a map-based navigator: its map on the ground, the arcs or splines that it weighed,
// and some of the points that it saw.

import { Color, DoubleSide, Group, Mesh, MeshBasicMaterial, Points, PointsMaterial } from "three";

import { type Palette, ramp } from "../palette";
import type { Place, Splines, Step, Vote } from "../payload";
import type { Layers } from "../view";
import { arcPoint, drawingOrder, elevationRange, type Frame, frameOf, PIECES, splinePath, turnPoint } from "./arcs";
import { geometryOf } from "./geometry";
import type { GroundHeights } from "./ground";

type Rgb = [number, number, number];

const MAP_LIFT_M = 0.012;
const ARC_LIFT_M = 0.03;
const FULL_VOTE = 255;
// Of the width of an arc: there are ten times as many splines.
const SPLINE_WIDTH = 0.35;
// Edge of arcs that were not chosen, linear light.
const PALE: Rgb = [0.8, 0.8, 0.8];
const LEAST_ALPHA = 0.2;
const MOST_ALPHA = 0.75;

export class StepPicture {
  readonly group = new Group();
  private readonly flat = new MeshBasicMaterial({ vertexColors: true, transparent: true, side: DoubleSide, depthWrite: false });
  private readonly solid = new MeshBasicMaterial({ vertexColors: true, side: DoubleSide });
  private readonly seen = new PointsMaterial({ size: 3, sizeAttenuation: false });
  private chosen: Rgb = PALE;
  private key = "";

  constructor(private readonly heights: GroundHeights) {}

  recolour(palette: Palette): void {
    this.chosen = new Color(palette.chosen).toArray() as Rgb;
    this.key = "";
    this.seen.color.set(palette.clear);
  }

  show(step: Step | null, layers: Layers): void {
    this.group.visible = step !== null;
    if (step === null) return;
    const key = [step.step, step.t, layers.map, layers.mapAtTruth, layers.votes, layers.scan].join();
    if (key === this.key) return;
    this.key = key;
    for (const child of [...this.group.children]) {
      this.group.remove(child);
      (child as Mesh).geometry.dispose();
    }
    const frame = frameOf(step, layers.mapAtTruth);
    if (layers.map !== "off") this.addMap(step, layers.map, frame);
    if (layers.votes) this.addPaths(step, frame);
    if (layers.scan) this.addPoints(step);
  }

  private addMap(step: Step, kind: "goodness" | "certainty" | "elevation", frame: Frame): void {
    const { map } = step;
    const range = elevationRange(map.elevation);
    const positions: number[] = [];
    const colours: number[] = [];
    for (let i = 0; i < map.nx * map.ny; ++i) {
      const colour = cellColour(map, i, kind, range);
      if (!colour) continue;
      const x = map.x0 + (i % map.nx) * map.xstep;
      const y = map.y0 + Math.floor(i / map.nx) * map.ystep;
      for (const [u, v] of CELL_CORNERS) {
        const [wx, wy] = frame.place(x + u * map.xstep, y + v * map.ystep);
        positions.push(wx, wy, this.heights.at(wx, wy) + MAP_LIFT_M);
        colours.push(...colour);
      }
    }
    const mesh = new Mesh(geometryOf(positions, { color: colours, channels: 4 }), this.flat);
    mesh.renderOrder = 1;
    this.group.add(mesh);
  }

  // All arcs are one mesh, in the order of drawing: pale edges keep dark arcs apart from dark cells.
  private addPaths(step: Step, frame: Frame): void {
    const strips = new Strips(this.heights);
    this.addArcs(step.votes, frame, strips);
    if (step.splines) this.addSplines(step.splines, frame, strips);
    const mesh = new Mesh(geometryOf(strips.positions, { color: strips.colours }), this.solid);
    mesh.renderOrder = 2;
    this.group.add(mesh);
  }

  private addArcs(votes: Vote[], frame: Frame, strips: Strips): void {
    for (const vote of [...votes].sort((a, b) => Number(a.chosen) - Number(b.chosen) || a.merged - b.merged)) {
      const at = (share: number): Place => (vote.kind === "turn" ? turnPoint(vote, share) : arcPoint(vote, share));
      const width = (vote.chosen ? 0.03 : 0.006) + 0.022 * (vote.merged / FULL_VOTE);
      const lift = ARC_LIFT_M + (vote.chosen ? 0.006 : 0);
      strips.add({ at, frame: frame.ahead, arrow: vote.chosen }, width + (vote.chosen ? 0.03 : 0.008), lift, vote.chosen ? this.chosen : PALE);
      strips.add({ at, frame: frame.ahead, arrow: vote.chosen }, width, lift + 0.003, linear(ramp(vote.merged / FULL_VOTE)));
    }
  }

  // One that the motors could not follow has no vote: its edge alone is drawn.
  private addSplines(splines: Splines, frame: Frame, strips: Strips): void {
    for (const i of drawingOrder(splines)) {
      const chosen = i === splines.chosen;
      const path: Strip = { at: splinePath(splines, i), frame: frame.along, arrow: chosen };
      const share = splines.merged[i]! / FULL_VOTE;
      const width = chosen ? 0.03 + 0.022 * share : SPLINE_WIDTH * (0.006 + 0.022 * share);
      const lift = ARC_LIFT_M + (chosen ? 0.006 : 0);
      strips.add(path, width + (chosen ? 0.03 : SPLINE_WIDTH * 0.008), lift, chosen ? this.chosen : PALE);
      if (splines.feasible[i]) strips.add(path, width, lift + 0.003, linear(ramp(share)));
    }
  }

  private addPoints(step: Step): void {
    this.group.add(new Points(geometryOf(step.points.flat()), this.seen));
  }
}

interface Strip {
  at: (share: number) => Place;
  /** From the frame of its points to the world that is drawn. */
  frame: Frame["ahead"];
  /** Whether it ends in one. */
  arrow: boolean;
}

/** Strips along arcs and splines. */
class Strips {
  readonly positions: number[] = [];
  readonly colours: number[] = [];

  constructor(private readonly heights: GroundHeights) {}

  add({ at, frame, arrow }: Strip, width: number, lift: number, colour: Rgb): void {
    const put = (share: number, side: number): void => {
      const { x, y, heading } = at(share);
      const [wx, wy] = frame(x - side * Math.sin(heading), y + side * Math.cos(heading));
      this.positions.push(wx, wy, this.heights.at(wx, wy) + lift);
      this.colours.push(...colour);
    };
    for (let i = 0; i < PIECES; ++i) {
      const [a, b] = [i / PIECES, (i + 1) / PIECES];
      for (const [share, side] of [[a, -1], [b, -1], [b, 1], [a, -1], [b, 1], [a, 1]] as const) {
        put(share, (side * width) / 2);
      }
    }
    if (!arrow) return;
    put(1, -1.4 * width);
    put(1 + 1.2 * width, 0);
    put(1, 1.4 * width);
  }
}

const CELL_CORNERS = [[0, 0], [1, 0], [1, 1], [0, 0], [1, 1], [0, 1]] as const;

/** Vertex colours are taken as linear light. */
const linear = (rgb: Rgb): Rgb => rgb.map((value) => (value / 255) ** 2.2) as Rgb;

/** Red, green, blue (linear light) and opacity, 0 to 1; null where nothing is known. */
function cellColour(
  map: Step["map"],
  index: number,
  kind: "goodness" | "certainty" | "elevation",
  range: { low: number; high: number },
): [number, number, number, number] | null {
  const goodness = map.goodness[index] ?? -1;
  const certainty = map.certainty[index] ?? -1;
  const elevation = map.elevation[index] ?? null;
  let share: number;
  let alpha = MOST_ALPHA;
  if (kind === "elevation") {
    if (elevation === null) return null;
    share = (elevation - range.low) / (range.high - range.low);
  } else {
    if (goodness < 0 || certainty < 0) return null;
    share = (kind === "goodness" ? goodness : certainty) / FULL_VOTE;
    if (kind === "goodness") alpha = LEAST_ALPHA + (MOST_ALPHA - LEAST_ALPHA) * (certainty / FULL_VOTE);
  }
  return [...linear(ramp(share)), alpha];
}
