// The ground with a grid in metres, and the walls of an arena.
import {
  BufferGeometry,
  DoubleSide,
  Float32BufferAttribute,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  PlaneGeometry,
  type Sprite,
} from "three";
import type { Palette } from "../palette";
import type { Course, Ground } from "../payload";
import { extentOf, GroundHeights, niceStep, WALL_HEIGHT_M, wallWithin, type Extent } from "./ground";
import { makeLabel } from "./labels";

const GRID_LIFT_M = 0.004;
// In steps between labels: further away they would lie on each other.
const LABEL_REACH = 9;

export function makeGround(ground: Ground, extent: Extent, palette: Palette): Mesh {
  const material = new MeshLambertMaterial({ color: palette.ground, side: DoubleSide });
  const heights = new GroundHeights(ground);
  const geometry = heights.empty ? flat(extent, heights.at(0, 0)) : relief(ground);
  const mesh = new Mesh(geometry, material);
  mesh.receiveShadow = true;
  return mesh;
}

function flat({ xMin, xMax, yMin, yMax }: Extent, z: number): BufferGeometry {
  return new PlaneGeometry(xMax - xMin, yMax - yMin).translate((xMin + xMax) / 2, (yMin + yMax) / 2, z);
}

function relief({ x0, y0, step, nx, ny, z }: Ground): BufferGeometry {
  const positions = new Float32Array(3 * nx * ny);
  for (let i = 0; i < nx * ny; ++i) {
    positions[3 * i] = x0 + (i % nx) * step;
    positions[3 * i + 1] = y0 + Math.floor(i / nx) * step;
    positions[3 * i + 2] = z[i]!;
  }
  const corners: number[] = [];
  for (let iy = 0; iy + 1 < ny; ++iy) {
    for (let ix = 0; ix + 1 < nx; ++ix) {
      const a = iy * nx + ix;
      corners.push(a, a + 1, a + nx + 1, a, a + nx + 1, a + nx);
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(positions, 3));
  geometry.setIndex(corners);
  geometry.computeVertexNormals();
  return geometry;
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
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(points, 3));
  const material = new LineBasicMaterial({ color: palette.grid, transparent: true, opacity: 0.55 });
  const group = new Group();
  group.add(new LineSegments(geometry, material), ...gridLabels(heights, labelled, palette));
  return group;
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

/** Walls as translucent upright planes, as long as the ground is. */
export function makeWalls(course: Course, heights: GroundHeights, palette: Palette): Group {
  const group = new Group();
  const extent = extentOf(course);
  const material = new MeshBasicMaterial({
    color: palette.wall,
    transparent: true,
    opacity: 0.28,
    side: DoubleSide,
    depthWrite: false,
  });
  for (const wall of course.walls) {
    const ends = wallWithin(wall, extent);
    if (!ends) continue;
    const { nx, ny } = wall;
    const { foot } = ends;
    const plane = new PlaneGeometry(ends.to - ends.from, WALL_HEIGHT_M).rotateX(Math.PI / 2);
    const mesh = new Mesh(plane, material);
    const along = (ends.from + ends.to) / 2;
    mesh.position.set(foot.x - ny * along, foot.y + nx * along, heights.at(foot.x, foot.y) + WALL_HEIGHT_M / 2);
    mesh.rotation.z = Math.atan2(nx, -ny);
    group.add(mesh);
  }
  return group;
}
