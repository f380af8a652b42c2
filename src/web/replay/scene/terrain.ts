// The ground with a grid in metres, and the walls of an arena.
import {
  BackSide, type BufferGeometry, Color, DoubleSide, Group, LineBasicMaterial, LineSegments, Mesh,
  MeshBasicMaterial, MeshLambertMaterial, PlaneGeometry, type Sprite, type Texture,
} from "three";
import type { Palette } from "../palette";
import type { Course, Ground } from "../payload";
import { geometryOf } from "./geometry";
import { type Extent, extentOf, gridFaces, GroundHeights, niceStep, WALL_HEIGHT_M, wallWithin } from "./ground";
import { makeLabel } from "./labels";
import { MOST_SOIL_TRIANGLES } from "./limits";
import { noise3 } from "./noise";
import { SOIL_TILE_M } from "./textures";

const GRID_LIFT_M = 0.004;
// Between drawn points of ground whose heights are further apart.
const FINEST_STEP_M = 0.25;
const PATCHES = [{ size_m: 2.7, depth: 0.16 }, { size_m: 0.7, depth: 0.12 }] as const;
// In steps between labels: further away they would lie on each other.
const LABEL_REACH = 9;

export function makeGround(ground: Ground, extent: Extent, texture: Texture | null, palette: Palette): Mesh {
  const heights = new GroundHeights(ground);
  const material = new MeshLambertMaterial({ map: texture, vertexColors: true, side: DoubleSide, fog: false });
  const mesh = new Mesh(relief(drawnGrid(ground, extent), heights, palette), material);
  mesh.receiveShadow = true;
  return mesh;
}

type Grid = Pick<Ground, "x0" | "y0" | "step" | "nx" | "ny">;

/** The page's own points, or closer ones where they are far apart, because colours go from point to point. */
function drawnGrid(ground: Ground, { xMin, xMax, yMin, yMax }: Extent): Grid {
  const step = Math.min(ground.step, FINEST_STEP_M);
  const whole = { x0: xMin, y0: yMin, step, nx: Math.ceil((xMax - xMin) / step) + 1, ny: Math.ceil((yMax - yMin) / step) + 1 };
  const few = 2 * whole.nx * whole.ny <= MOST_SOIL_TRIANGLES;
  return few || ground.nx < 2 || ground.ny < 2 ? whole : ground;
}

function relief({ x0, y0, step, nx, ny }: Grid, heights: GroundHeights, palette: Palette): BufferGeometry {
  const positions: number[] = [];
  const uv: number[] = [];
  const colours: number[] = [];
  const base = new Color(palette.ground);
  for (let i = 0; i < nx * ny; ++i) {
    const x = x0 + (i % nx) * step;
    const y = y0 + Math.floor(i / nx) * step;
    positions.push(x, y, heights.at(x, y));
    uv.push(x / SOIL_TILE_M, y / SOIL_TILE_M);
    colours.push(...base.clone().multiplyScalar(patch(x, y)).toArray());
  }
  return geometryOf(positions, { uv, color: colours, faces: gridFaces(nx, ny) });
}

/** Darker and paler patches of soil, about 1, so that nobody sees the texture repeat. */
function patch(x: number, y: number): number {
  const shares = PATCHES.map(({ size_m, depth }, k) => depth * (noise3(x / size_m + 100, y / size_m + 100, 0, 61 + k) - 0.5));
  return shares.reduce((sum, share) => sum + share, 1);
}

/**
 * Lines every metre, or at wider steps on wide ground; distances are written along two sides of
 * `labelled`, a part of the ground.
 */
export function makeGrid(heights: GroundHeights, extent: Extent, labelled: Extent, palette: Palette): Group {
  const { xMin, xMax, yMin, yMax } = extent;
  const length = Math.max(xMax - xMin, yMax - yMin);
  const step = Math.max(1, niceStep(length, 40));
  const piece = Math.max(0.1, length / 400);
  const points: number[] = [];
  const line = (x0: number, y0: number, x1: number, y1: number): void => {
    const count = heights.empty ? 1 : Math.max(1, Math.ceil(Math.hypot(x1 - x0, y1 - y0) / piece));
    const at = (i: number): number[] => {
      const x = x0 + ((x1 - x0) * i) / count;
      const y = y0 + ((y1 - y0) * i) / count;
      return [x, y, heights.at(x, y) + GRID_LIFT_M];
    };
    for (let i = 0; i < count; ++i) points.push(...at(i), ...at(i + 1));
  };
  for (let x = Math.ceil(xMin / step) * step; x <= xMax; x += step) line(x, yMin, x, yMax);
  for (let y = Math.ceil(yMin / step) * step; y <= yMax; y += step) line(xMin, y, xMax, y);
  const material = new LineBasicMaterial({ color: palette.grid, transparent: true, opacity: 0.55 });
  return new Group().add(new LineSegments(geometryOf(points), material), ...gridLabels(heights, labelled, palette));
}

function gridLabels(heights: GroundHeights, { xMin, xMax, yMin, yMax }: Extent, palette: Palette): Sprite[] {
  const length = Math.max(xMax - xMin, yMax - yMin);
  const every = Math.max(1, niceStep(length, 12));
  const labels: Sprite[] = [];
  const put = (text: string, x: number, y: number): void => {
    labels.push(makeLabel(text, x, y, heights.at(x, y), { colour: palette.label, reach_m: LABEL_REACH * every }));
  };
  for (let x = Math.ceil(xMin / every) * every; x <= xMax; x += every) put(`${x} m`, x, yMin);
  for (let y = Math.ceil(yMin / every) * every; y <= yMax; y += every) put(`${y} m`, xMin, y);
  return labels;
}

/** Walls as boards, as long as the ground is; from outside one sees through them. */
export function makeWalls(course: Course, heights: GroundHeights, palette: Palette): Group {
  const group = new Group();
  const extent = extentOf(course);
  const inside = new MeshLambertMaterial({ color: new Color(palette.wall).lerp(new Color(palette.sky), 0.5) });
  const outside = new MeshBasicMaterial({ color: palette.wall, transparent: true, opacity: 0.28, side: BackSide, depthWrite: false });
  for (const wall of course.walls) {
    const ends = wallWithin(wall, extent);
    if (!ends) continue;
    const { nx, ny } = wall;
    const { foot } = ends;
    const plane = new PlaneGeometry(ends.to - ends.from, WALL_HEIGHT_M).rotateX(Math.PI / 2);
    const along = (ends.from + ends.to) / 2;
    for (const material of [inside, outside]) {
      const mesh = new Mesh(plane, material);
      mesh.position.set(foot.x - ny * along, foot.y + nx * along, heights.at(foot.x, foot.y) + WALL_HEIGHT_M / 2);
      // The plane looks along -y of its own, and the normal of a wall out of the arena.
      mesh.rotation.z = Math.atan2(-nx, ny);
      mesh.receiveShadow = true;
      group.add(mesh);
    }
  }
  return group;
}
