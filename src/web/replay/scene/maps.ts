// One decision of a map-based navigator: its map on the ground, the arcs that it weighed, and some
// of the points that it saw.
import {
  BufferGeometry,
  Color,
  DoubleSide,
  Float32BufferAttribute,
  Group,
  Mesh,
  MeshBasicMaterial,
  Points,
  PointsMaterial,
} from "three";
import { ramp, type Palette } from "../palette";
import type { Step, Vote } from "../payload";
import type { Layers } from "../view";
import { arcPoint, elevationRange, frameOf, turnPoint, type Frame } from "./arcs";
import type { GroundHeights } from "./ground";

type Rgb = [number, number, number];

const MAP_LIFT_M = 0.012;
const ARC_LIFT_M = 0.03;
const ARC_PIECES = 24;
const FULL_VOTE = 255;
// Edge of arcs that were not chosen, linear light.
const PALE: Rgb = [0.8, 0.8, 0.8];
const LEAST_ALPHA = 0.2;
const MOST_ALPHA = 0.75;

export class StepPicture {
  readonly group = new Group();
  private readonly flat = new MeshBasicMaterial({
    vertexColors: true,
    transparent: true,
    side: DoubleSide,
    depthWrite: false,
  });
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
    if (layers.votes) this.addVotes(step, frame);
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
    const mesh = new Mesh(coloured(positions, colours, 4), this.flat);
    mesh.renderOrder = 1;
    this.group.add(mesh);
  }

  // All arcs are one mesh, in the order of drawing: pale edges keep dark arcs apart from dark cells.
  private addVotes(step: Step, frame: Frame): void {
    const votes = [...step.votes].sort((a, b) => Number(a.chosen) - Number(b.chosen) || a.merged - b.merged);
    const strips = new Strips(frame, this.heights);
    for (const vote of votes) {
      const width = (vote.chosen ? 0.03 : 0.006) + 0.022 * (vote.merged / FULL_VOTE);
      const lift = ARC_LIFT_M + (vote.chosen ? 0.006 : 0);
      strips.add(vote, width + (vote.chosen ? 0.03 : 0.008), lift, vote.chosen ? this.chosen : PALE);
      strips.add(vote, width, lift + 0.003, linear(ramp(vote.merged / FULL_VOTE)));
    }
    const mesh = new Mesh(coloured(strips.positions, strips.colours, 3), this.solid);
    mesh.renderOrder = 2;
    this.group.add(mesh);
  }

  private addPoints(step: Step): void {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new Float32BufferAttribute(step.points.flat(), 3));
    this.group.add(new Points(geometry, this.seen));
  }
}

/** Strips along arcs; those of chosen ones end in arrows. */
class Strips {
  readonly positions: number[] = [];
  readonly colours: number[] = [];

  constructor(
    private readonly frame: Frame,
    private readonly heights: GroundHeights,
  ) {}

  add(vote: Vote, width: number, lift: number, colour: Rgb): void {
    const put = (share: number, side: number): void => {
      const { x, y, heading } = vote.kind === "turn" ? turnPoint(vote, share) : arcPoint(vote, share);
      const [wx, wy] = this.frame.ahead(x - side * Math.sin(heading), y + side * Math.cos(heading));
      this.positions.push(wx, wy, this.heights.at(wx, wy) + lift);
      this.colours.push(...colour);
    };
    for (let i = 0; i < ARC_PIECES; ++i) {
      const [a, b] = [i / ARC_PIECES, (i + 1) / ARC_PIECES];
      for (const [share, side] of [[a, -1], [b, -1], [b, 1], [a, -1], [b, 1], [a, 1]] as const) {
        put(share, (side * width) / 2);
      }
    }
    if (!vote.chosen) return;
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

function coloured(positions: number[], colours: number[], channels: number): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(positions, 3));
  geometry.setAttribute("color", new Float32BufferAttribute(colours, channels));
  return geometry;
}
