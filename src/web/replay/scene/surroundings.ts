// What lies around the terrain: a sky with its sun, ground to the horizon, or the hall that an arena
// stands in. All of it is drawn only: the simulator has no terrain there.
import {
  AdditiveBlending, BackSide, BoxGeometry, type BufferGeometry, CanvasTexture, Color, Fog, Group,
  Mesh, MeshBasicMaterial, MeshLambertMaterial, type Object3D, PlaneGeometry, SphereGeometry, Sprite, SpriteMaterial,
  type Texture, type Vector3,
} from "three";
import type { Palette } from "../palette";
import { colouredByHeight, geometryOf } from "./geometry";
import type { Extent, GroundHeights } from "./ground";
import { noise3 } from "./noise";
import { SOIL_TILE_M } from "./textures";
import type { WorldKind } from "./world";

const SKY_RADIUS_M = 400;
const SUN_SIZE_M = 34;
// Rings of ground around the terrain, m from its edge, and how high hills grow there.
const RINGS_M = [0, 1.5, 5, 14, 40, 110, 260];
const HILLS = { mars: 0.035, field: 0.006, hall: 0 };
const HILL_M = 38;
const RING_CORNERS = 26;
const HAZE_M = { from: 15, to: 230 };
// Of the hall: from the terrain's edge to the walls, and upwards.
const HALL_MARGIN_M = 3;
const HALL_HEIGHT_M = 3.4;
const RIM = { width_m: 0.06, above_m: 0.05, below_m: 0.12 };

interface Surroundings {
  /** Stands still. */
  fixed: Group;
  /** Goes with the camera, so that it is always as far away. */
  sky: Group;
  haze: Fog | null;
}

export interface Light {
  /** Unit vector towards the sun. */
  toward: Vector3;
  /** The grain of the soil in this light; null for a plain picture. */
  soil: Texture | null;
}

export function makeSurroundings(kind: WorldKind, extent: Extent, heights: GroundHeights, { toward, soil }: Light, palette: Palette): Surroundings {
  if (kind === "hall") return { fixed: makeHall(extent, heights, palette), sky: new Group(), haze: null };
  const fixed = new Group();
  fixed.add(makeHorizon(kind, extent, heights, soil, palette));
  const sky = new Group();
  sky.add(makeSky(palette), makeSun(kind, toward));
  return { fixed, sky, haze: new Fog(palette.sky, HAZE_M.from, HAZE_M.to) };
}

/** Half a ball, paler towards the horizon. */
function makeSky({ sky, zenith }: Palette): Mesh {
  const [low, high] = [new Color(sky), new Color(zenith)];
  const ball = colouredByHeight(new SphereGeometry(SKY_RADIUS_M, 24, 14).rotateX(Math.PI / 2), (z) =>
    low.clone().lerp(high, Math.max(0, z / SKY_RADIUS_M) ** 0.6));
  const mesh = new Mesh(ball, new MeshBasicMaterial({ vertexColors: true, side: BackSide, depthWrite: false, fog: false }));
  mesh.renderOrder = -10;
  mesh.frustumCulled = false;
  return mesh;
}

function makeSun(kind: WorldKind, toward: Vector3): Sprite {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 128;
  const context = canvas.getContext("2d")!;
  const glow = context.createRadialGradient(64, 64, 0, 64, 64, 64);
  // Dust of Mars scatters blue light forwards: a bluish glow around the sun.
  const tint = kind === "mars" ? "206, 222, 240" : "255, 246, 225";
  for (const [at, alpha] of [[0, 1], [0.1, 1], [0.16, 0.4], [0.45, 0.12], [1, 0]]) glow.addColorStop(at!, `rgba(${tint}, ${alpha})`);
  context.fillStyle = glow;
  context.fillRect(0, 0, 128, 128);
  const material = new SpriteMaterial({ map: new CanvasTexture(canvas), blending: AdditiveBlending, depthWrite: false, fog: false });
  const sun = new Sprite(material);
  sun.renderOrder = -9;
  sun.scale.setScalar(SUN_SIZE_M * 4);
  sun.position.copy(toward).multiplyScalar(0.97 * SKY_RADIUS_M);
  return sun;
}

/** Ground from the edge of the terrain to the horizon: on in the plane of the terrain, with hills far away. */
function makeHorizon(kind: WorldKind, extent: Extent, heights: GroundHeights, soil: Texture | null, palette: Palette): Mesh {
  const plane = planeOf(extent, heights);
  const positions: number[] = [];
  const uv: number[] = [];
  const corners: number[] = [];
  const around = 4 * RING_CORNERS;
  RINGS_M.forEach((away, ring) => {
    for (let i = 0; i < around; ++i) {
      const { x, y } = onEdge(extent, i, away);
      const hill = HILLS[kind] * away * (noise3(x / HILL_M + 50, y / HILL_M + 50, 0, 5) - 0.3);
      positions.push(x, y, ring === 0 ? heights.at(x, y) : plane(x, y) + hill);
      uv.push(x / SOIL_TILE_M, y / SOIL_TILE_M);
    }
    for (let i = 0; ring > 0 && i < around; ++i) {
      const [a, b] = [(ring - 1) * around + i, (ring - 1) * around + ((i + 1) % around)];
      corners.push(a, a + around, b, b, a + around, b + around);
    }
  });
  return new Mesh(geometryOf(positions, { uv, faces: corners }), new MeshLambertMaterial({ color: palette.around, map: soil }));
}

/** Point i of a ring around the terrain, `away` from its edge, counter-clockwise. */
function onEdge({ xMin, xMax, yMin, yMax }: Extent, i: number, away: number): { x: number; y: number } {
  const side = Math.floor(i / RING_CORNERS);
  const share = (i % RING_CORNERS) / RING_CORNERS;
  const [w, e, s, n] = [xMin - away, xMax + away, yMin - away, yMax + away];
  if (side === 0) return { x: w + share * (e - w), y: s };
  if (side === 1) return { x: e, y: s + share * (n - s) };
  if (side === 2) return { x: e - share * (e - w), y: n };
  return { x: w, y: n - share * (n - s) };
}

/** Through the terrain's four corners, as well as a plane can. */
function planeOf({ xMin, xMax, yMin, yMax }: Extent, heights: GroundHeights): (x: number, y: number) => number {
  const [sw, se, nw, ne] = [heights.at(xMin, yMin), heights.at(xMax, yMin), heights.at(xMin, yMax), heights.at(xMax, yMax)];
  const alongX = (se + ne - sw - nw) / 2 / (xMax - xMin);
  const alongY = (nw + ne - sw - se) / 2 / (yMax - yMin);
  const middle = (sw + se + nw + ne) / 4;
  return (x, y) => middle + alongX * (x - (xMin + xMax) / 2) + alongY * (y - (yMin + yMax) / 2);
}

/** Floor, walls and the rim of the box that holds the soil. Walls are seen from within only. */
function makeHall(extent: Extent, heights: GroundHeights, palette: Palette): Group {
  const { xMin, xMax, yMin, yMax } = extent;
  const hall = new Group();
  const [cx, cy] = [(xMin + xMax) / 2, (yMin + yMax) / 2];
  const [length, width] = [xMax - xMin, yMax - yMin];
  const low = lowestEdge(extent, heights) - RIM.below_m;
  const [long, wide] = [length + 2 * HALL_MARGIN_M, width + 2 * HALL_MARGIN_M];
  const floor = new Mesh(new PlaneGeometry(long, wide), new MeshLambertMaterial({ color: palette.around }));
  floor.position.set(cx, cy, low);
  floor.receiveShadow = true;
  const walls = new Mesh(shadedBox(long, wide, palette), new MeshBasicMaterial({ vertexColors: true, side: BackSide }));
  walls.position.set(cx, cy, low + HALL_HEIGHT_M / 2 - 0.01);
  hall.add(floor, walls, ...makeRim(extent, heights, low, palette));
  return hall;
}

function shadedBox(length: number, width: number, { sky, zenith, around }: Palette): BufferGeometry {
  const [foot, middle, top] = [new Color(around), new Color(sky), new Color(zenith)];
  return colouredByHeight(new BoxGeometry(length, width, HALL_HEIGHT_M, 1, 1, 4), (z) => {
    const share = z / HALL_HEIGHT_M + 0.5;
    return share < 0.2 ? foot.clone().lerp(middle, 0.6) : middle.clone().lerp(top, share);
  });
}

/** Boards along the four edges, down to the floor. */
function makeRim({ xMin, xMax, yMin, yMax }: Extent, heights: GroundHeights, low: number, palette: Palette): Object3D[] {
  const material = new MeshLambertMaterial({ color: new Color(palette.rock).lerp(new Color(palette.around), 0.55) });
  const board = (x0: number, y0: number, x1: number, y1: number): Mesh => {
    const length = Math.hypot(x1 - x0, y1 - y0);
    const geometry = new BoxGeometry(length + RIM.width_m, RIM.width_m, 1, Math.ceil(length / 0.5), 1, 1);
    const position = geometry.getAttribute("position");
    for (let i = 0; i < position.count; ++i) {
      const share = Math.min(1, Math.max(0, position.getX(i) / length + 0.5));
      const [x, y] = [x0 + share * (x1 - x0), y0 + share * (y1 - y0)];
      position.setZ(i, position.getZ(i) > 0 ? heights.at(x, y) + RIM.above_m : low);
    }
    const mesh = new Mesh(geometry, material);
    mesh.position.set((x0 + x1) / 2, (y0 + y1) / 2, 0);
    mesh.rotation.z = Math.atan2(y1 - y0, x1 - x0);
    mesh.castShadow = mesh.receiveShadow = true;
    return mesh;
  };
  const out = RIM.width_m / 2;
  const [w, e, s, n] = [xMin - out, xMax + out, yMin - out, yMax + out];
  return [board(w, s, e, s), board(e, s, e, n), board(e, n, w, n), board(w, n, w, s)];
}

function lowestEdge(extent: Extent, heights: GroundHeights): number {
  let low = Infinity;
  for (let i = 0; i < 4 * RING_CORNERS; ++i) {
    const { x, y } = onEdge(extent, i, 0);
    low = Math.min(low, heights.at(x, y));
  }
  return low;
}
