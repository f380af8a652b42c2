// Surfaces of rocks with semi-axes of 1: the true ones, which the simulator uses, and rough ones, which
// are drawn only. A rough surface lies within the true one, nowhere deeper than ROUGH_DEPTH of the
// distance from the rock's centre.
import { BufferAttribute, BufferGeometry, Float32BufferAttribute, IcosahedronGeometry, LatheGeometry, Vector2, Vector3 } from "three";
import { mergeVertices } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import { ROUGH_DEPTH } from "./limits";
import { noise3, randomNumbers } from "./noise";

/** From the most faces to the fewest: how often the icosahedron of an ellipsoid is cut, rings and sides of a cap. */
export const DETAILS = [
  { cuts: 5, rings: 11, sides: 26, textured: true },
  { cuts: 2, rings: 6, sides: 18, textured: true },
  { cuts: 1, rings: 4, sides: 14, textured: false },
  { cuts: 0, rings: 2, sides: 6, textured: false },
] as const;

// Of a cap's height.
const FOOT = 0.2;
const FACETS = 10;
const SHALLOWEST_FACET = 0.99;
const DEEPEST_FACET = 0.89;
const BUMPS = [
  { per_axis: 2.3, depth: 0.035 },
  { per_axis: 6.1, depth: 0.03 },
] as const;
// Of a rock's size, for one repetition of the texture.
const TEXTURE_SIZE = 1.3;

export interface RockForm {
  /** 0 for an ellipsoid, else A of a cap (payload.ts). */
  growth: number;
  /** Which of the rough ones; null for the true surface. */
  variant: number | null;
}

/** With normals, and with shade and dust per corner in `userData`, from which colours are made. */
export function rockGeometry({ growth, variant }: RockForm, detail: number): BufferGeometry {
  const geometry = trueSurface(growth, detail);
  if (variant !== null) roughen(geometry, variant + 1, growth);
  geometry.computeVertexNormals();
  const drawn = DETAILS[detail]!.textured ? geometry.toNonIndexed() : geometry;
  addTextureCoordinates(drawn);
  drawn.userData = paintOf(drawn, growth, variant);
  return drawn;
}

function trueSurface(growth: number, detail: number): BufferGeometry {
  const { cuts } = DETAILS[detail]!;
  const surface = growth === 0 ? new IcosahedronGeometry(1, cuts) : capSurface(growth, detail);
  for (const name of ["normal", "uv"]) surface.deleteAttribute(name);
  return mergeVertices(surface, 1e-5);
}

function capSurface(growth: number, detail: number): BufferGeometry {
  const { rings, sides } = DETAILS[detail]!;
  const profile = Array.from({ length: rings + 1 }, (_, i) => {
    // From the base up, denser towards the top, where it bends.
    const s = (1 - i / rings) ** 2;
    return new Vector2(Math.sqrt((growth + (1 - growth) * s) * s), 1 - s);
  });
  // A lathe turns about y.
  return new LatheGeometry(profile, sides).rotateX(Math.PI / 2);
}

// The foot of a cap stays as wide as it is, since that is what one sees from above.
function roughen(geometry: BufferGeometry, seed: number, growth: number): void {
  const position = geometry.getAttribute("position");
  const facets = facetsOf(geometry, seed);
  const point = new Vector3();
  for (let i = 0; i < position.count; ++i) {
    point.fromBufferAttribute(position, i);
    let share = 1;
    for (const { normal, offset } of facets) {
      const out = normal.dot(point);
      if (out > offset) share = Math.min(share, offset / out);
    }
    BUMPS.forEach(({ per_axis: f, depth }, k) => {
      share -= depth * noise3(f * point.x + 40, f * point.y + 40, f * point.z + 40, 97 * seed + k);
    });
    const above = growth === 0 ? 1 : Math.min(1, point.z / FOOT);
    point.multiplyScalar(1 - above * Math.min(ROUGH_DEPTH, 1 - share));
    position.setXYZ(i, point.x, point.y, point.z);
  }
}

/** Planes that cut pieces off, as breaks do. */
function facetsOf(geometry: BufferGeometry, seed: number): { normal: Vector3; offset: number }[] {
  const random = randomNumbers(1000 + seed);
  const position = geometry.getAttribute("position");
  return Array.from({ length: FACETS }, () => {
    const height = 2 * random() - 1;
    const turn = 2 * Math.PI * random();
    const flat = Math.sqrt(1 - height * height);
    const normal = new Vector3(flat * Math.cos(turn), flat * Math.sin(turn), height);
    let furthest = 0;
    const point = new Vector3();
    for (let i = 0; i < position.count; ++i) furthest = Math.max(furthest, normal.dot(point.fromBufferAttribute(position, i)));
    return { normal, offset: furthest * (DEEPEST_FACET + (SHALLOWEST_FACET - DEEPEST_FACET) * random()) };
  });
}

/** Each face takes the texture along the axis that it looks along most. */
function addTextureCoordinates(geometry: BufferGeometry): void {
  const position = geometry.getAttribute("position");
  const corner = geometry.getIndex() === null ? 3 : 1;
  const uv: number[] = [];
  const points = [new Vector3(), new Vector3(), new Vector3()];
  for (let i = 0; i < position.count; i += corner) {
    const face = points.slice(0, corner).map((point, k) => point.fromBufferAttribute(position, i + k));
    const middle = face.reduce((sum, point) => sum.add(point), new Vector3());
    const [ax, ay, az] = [Math.abs(middle.x), Math.abs(middle.y), Math.abs(middle.z)];
    for (const { x, y, z } of face) {
      const [u, v] = az >= ax && az >= ay ? [x, y] : ax >= ay ? [y, z] : [x, z];
      uv.push(u! / TEXTURE_SIZE, v! / TEXTURE_SIZE);
    }
  }
  geometry.setAttribute("uv", new Float32BufferAttribute(uv, 2));
}

export interface Paint {
  /** Of the rock's own colour. */
  shade: Float32Array;
  /** How much of the soil's colour lies on it, 0 to 1. */
  dust: Float32Array;
}

function paintOf(geometry: BufferGeometry, growth: number, variant: number | null): Paint {
  const position = geometry.getAttribute("position");
  const normal = geometry.getAttribute("normal");
  const shade = new Float32Array(position.count).fill(1);
  const dust = new Float32Array(position.count);
  if (variant === null) return { shade, dust };
  // Where the soil ends: ellipsoids lie a third in the ground on average, caps on it.
  const soil = growth === 0 ? -0.33 : 0;
  for (let i = 0; i < position.count; ++i) {
    const [x, y, z] = [position.getX(i), position.getY(i), position.getZ(i)];
    const mottle = noise3(3 * x + 20, 3 * y + 20, 3 * z + 20, 7 + variant);
    shade[i] = 0.8 + 0.36 * mottle;
    const skirt = 1 - Math.min(1, Math.max(0, (z - soil) / 0.12));
    const lying = Math.max(0, normal.getZ(i) - 0.55) * 0.9;
    dust[i] = Math.min(1, 0.5 * skirt + lying * mottle);
  }
  return { shade, dust };
}

/** Colours of corners, as shares of the rock's: `soil` is the soil's colour over the rock's, linear light. */
export function colourRock(geometry: BufferGeometry, soil: readonly [number, number, number]): void {
  const { shade, dust } = geometry.userData as Paint;
  const colours = new Float32Array(3 * shade.length);
  for (let i = 0; i < shade.length; ++i) {
    soil.forEach((ratio, k) => (colours[3 * i + k] = shade[i]! * (1 + dust[i]! * (ratio - 1))));
  }
  geometry.setAttribute("color", new BufferAttribute(colours, 3));
}
