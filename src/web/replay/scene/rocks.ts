// Rocks where they lie at a time: rough, or in the shapes that the simulator uses. Those that look
// small get few faces.

import {
  BufferAttribute, BufferGeometry, type Camera, Color, Euler, Float32BufferAttribute, FrontSide, Frustum, Group,
  IcosahedronGeometry, InstancedMesh, LatheGeometry, Matrix4, MeshLambertMaterial, Quaternion, Sphere, type Texture,
  Vector2, Vector3,
} from "three";
import { mergeVertices } from "three/examples/jsm/utils/BufferGeometryUtils.js";

import type { Palette } from "../palette";
import type { ReplayPayload, Rock } from "../payload";
import { pixelsPerMetre } from "./labels";
import { MOST_ROCK_TRIANGLES, ROUGH_DEPTH } from "./limits";
import { noise3, randomNumbers } from "./noise";

const VARIANTS = 3;
// Caps of nearly the same growth share a geometry.
const GROWTH_STEP = 0.05;
// Diameters on the screen, px, from which on a rock has the faces of DETAILS[0], [1], [2]; below the
// last one it is left out.
const LEAST_PX = [70, 22, 7, 0.7] as const;
const CASTS_SHADOW = [true, true, true, false] as const;
// How much further from the eye the limits are moved where there are too many triangles.
const COARSER = 1.25;

/** Rocks of one shape, at every level of detail. */
interface Kind { rough: BufferGeometry[]; smooth: BufferGeometry[]; levels: InstancedMesh[] }

interface Placed { kind: Kind; matrix: Matrix4; colour: Color; sphere: Sphere }

export class Rocks {
  readonly group = new Group();
  private readonly kinds = new Map<string, Kind>();
  private readonly placed: Placed[];
  private readonly materials: { rough: MeshLambertMaterial; smooth: MeshLambertMaterial };
  private applied = 0;
  private smooth = false;

  constructor(private readonly payload: ReplayPayload, private readonly texture: Texture) {
    // Their far sides lie in the ground and would cast shadows around them.
    this.materials = {
      rough: new MeshLambertMaterial({ shadowSide: FrontSide, vertexColors: true, map: texture }),
      smooth: new MeshLambertMaterial({ shadowSide: FrontSide }),
    };
    const { rocks } = payload;
    const counts = new Map<string, number>();
    const nameOf = (rock: Rock, i: number): string => `${growthClass(rock)} ${i % VARIANTS}`;
    rocks.forEach((rock, i) => counts.set(nameOf(rock, i), (counts.get(nameOf(rock, i)) ?? 0) + 1));
    this.placed = rocks.map((rock, i) => {
      const name = nameOf(rock, i);
      const kind = this.kinds.get(name) ?? this.makeKind(growthClass(rock), i % VARIANTS, counts.get(name)!);
      this.kinds.set(name, kind);
      return { kind, matrix: new Matrix4(), colour: new Color(), sphere: new Sphere(new Vector3(), Math.max(rock.a, rock.b, rock.c)) };
    });
    rocks.forEach((rock, i) => this.place(i, rock));
  }

  recolour(palette: Palette): void {
    const base = new Color(palette.rock);
    const soil = new Color(palette.ground);
    const ratio = [soil.r / base.r, soil.g / base.g, soil.b / base.b] as const;
    for (const { rough } of this.kinds.values()) for (const geometry of rough) colourRock(geometry, ratio);
    this.placed.forEach(({ colour }, i) => {
      // A shade of its own each, always the same: neighbours are told apart.
      colour.copy(base).multiplyScalar(0.86 + 0.28 * ((i * 0.618034) % 1));
    });
  }

  /** Puts rocks where they had been pushed to by `t`. */
  show(t: number, { trueShapes, plain }: { trueShapes: boolean; plain: boolean }): void {
    this.setSmooth(trueShapes);
    this.setPlain(plain);
    const { rocks, rock_moves: moves } = this.payload;
    let due = 0;
    while (due < moves.length && moves[due]!.t <= t) ++due;
    if (due === this.applied) return;
    if (due < this.applied) {
      for (const { rock } of moves.slice(0, this.applied)) this.place(rock, rocks[rock]!);
      this.applied = 0;
    }
    for (const move of moves.slice(this.applied, due)) this.place(move.rock, move);
    this.applied = due;
  }

  /** Chooses levels of detail for what this camera sees, on a picture of `height_px`, and what casts shadows into it. */
  fit(camera: Camera, height_px: number, lit: Frustum): void {
    const seen = new Frustum().setFromProjectionMatrix(new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse));
    const eye = camera.getWorldPosition(new Vector3());
    const wanted = this.placed.filter(({ sphere }) => seen.intersectsSphere(sphere) || lit.intersectsSphere(sphere));
    const sizes = wanted.map(({ sphere }) => 2 * sphere.radius * pixelsPerMetre(camera, eye.distanceTo(sphere.center), height_px));
    let scale = 1;
    while (this.triangles(wanted, sizes, scale) > MOST_ROCK_TRIANGLES) scale *= COARSER;
    for (const { levels } of this.kinds.values()) for (const mesh of levels) mesh.count = 0;
    wanted.forEach(({ kind, matrix, colour }, i) => {
      const mesh = kind.levels[levelOf(sizes[i]! / scale)];
      if (!mesh) return;
      mesh.setMatrixAt(mesh.count, matrix);
      mesh.setColorAt(mesh.count++, colour);
    });
    for (const { levels } of this.kinds.values()) {
      for (const mesh of levels) {
        mesh.visible = mesh.count > 0;
        if (!mesh.visible) continue;
        mesh.instanceMatrix.needsUpdate = true;
        mesh.instanceColor!.needsUpdate = true;
      }
    }
  }

  private triangles(wanted: Placed[], sizes: number[], scale: number): number {
    let sum = 0;
    wanted.forEach(({ kind }, i) => {
      const level = levelOf(sizes[i]! / scale);
      if (level < DETAILS.length) sum += trianglesOf(kind.rough[level]!);
    });
    return sum;
  }

  /** Of all drawn surfaces: see Drawing in view.ts. */
  depths(): { deepest: number; outermost: number } {
    let [deepest, outermost] = [0, 0];
    for (const { smooth, levels } of this.kinds.values()) {
      levels.forEach((mesh, level) => {
        const depths = depthsBelow(mesh.geometry, smooth[level]!);
        deepest = Math.max(deepest, ...depths);
        outermost = Math.max(outermost, ...depths.map((depth) => -depth));
      });
    }
    return { deepest, outermost };
  }

  private setPlain(plain: boolean): void {
    const map = plain ? null : this.texture;
    if (this.materials.rough.map === map) return;
    this.materials.rough.map = map;
    this.materials.rough.needsUpdate = true;
  }

  private setSmooth(smooth: boolean): void {
    if (smooth === this.smooth) return;
    this.smooth = smooth;
    for (const { rough, smooth: trueShapes, levels } of this.kinds.values()) {
      levels.forEach((mesh, level) => {
        mesh.geometry = (smooth ? trueShapes : rough)[level]!;
        mesh.material = smooth ? this.materials.smooth : this.materials.rough;
      });
    }
  }

  private makeKind(growth: number, variant: number, most: number): Kind {
    const all = DETAILS.map((_, level) => level);
    const rough = all.map((level) => rockGeometry({ growth, variant }, level));
    const smooth = all.map((level) => rockGeometry({ growth, variant: null }, level));
    const levels = rough.map((geometry, level) => {
      const mesh = new InstancedMesh(geometry, this.materials.rough, most);
      mesh.castShadow = CASTS_SHADOW[level]!;
      mesh.receiveShadow = true;
      // What is out of sight is left out one by one.
      mesh.frustumCulled = false;
      this.group.add(mesh);
      return mesh;
    });
    return { rough, smooth, levels };
  }

  private place(index: number, center: { x: number; y: number; z: number }): void {
    const rock = this.payload.rocks[index];
    const placed = this.placed[index];
    if (!rock || !placed) return;
    placed.sphere.center.set(center.x, center.y, center.z);
    placed.matrix.compose(
      placed.sphere.center,
      new Quaternion().setFromEuler(new Euler(0, 0, rock.yaw)),
      new Vector3(rock.a, rock.b, rock.c),
    );
  }
}

/** How far corners lie within the same corners of another surface, as shares of the latter's distance from the centre. */
function depthsBelow(surface: BufferGeometry, outer: BufferGeometry): number[] {
  const [inner, whole] = [surface.getAttribute("position"), outer.getAttribute("position")];
  const away = (position: typeof inner, i: number): number => Math.hypot(position.getX(i), position.getY(i), position.getZ(i));
  return Array.from({ length: inner.count }, (_, i) => 1 - away(inner, i) / Math.max(1e-9, away(whole, i)));
}

/** Index into DETAILS; their number where a rock of this size on the screen is left out. */
function levelOf(size_px: number): number {
  const level = LEAST_PX.findIndex((least) => size_px >= least);
  return level < 0 ? DETAILS.length : level;
}

const trianglesOf = (geometry: BufferGeometry): number => (geometry.getIndex() ?? geometry.getAttribute("position")).count / 3;

/** The growth that a rock is drawn with, 0 for an ellipsoid. */
function growthClass({ growth }: Rock): number {
  return growth ? Math.max(0.5, Math.round(growth / GROWTH_STEP)) * GROWTH_STEP : 0;
}

// ---- Surfaces of rocks with semi-axes of 1: the true ones, which the simulator uses, and rough ones, which
// are drawn only. A rough surface lies within the true one, nowhere deeper than ROUGH_DEPTH of the
// distance from the rock's centre.

/** From the most faces to the fewest: how often the icosahedron of an ellipsoid is cut, rings and sides of a cap. */
const DETAILS = [
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
const BUMPS = [{ per_axis: 2.3, depth: 0.035 }, { per_axis: 6.1, depth: 0.03 }] as const;
// Of a rock's size, for one repetition of the texture.
const TEXTURE_SIZE = 1.3;

interface RockForm {
  /** 0 for an ellipsoid, else A of a cap (payload.ts). */
  growth: number;
  /** Which of the rough ones; null for the true surface. */
  variant: number | null;
}

/** With normals, and with shade and dust per corner in `userData`, from which colours are made. */
function rockGeometry({ growth, variant }: RockForm, detail: number): BufferGeometry {
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

interface Paint {
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
function colourRock(geometry: BufferGeometry, soil: readonly [number, number, number]): void {
  const { shade, dust } = geometry.userData as Paint;
  const colours = new Float32Array(3 * shade.length);
  for (let i = 0; i < shade.length; ++i) {
    soil.forEach((ratio, k) => (colours[3 * i + k] = shade[i]! * (1 + dust[i]! * (ratio - 1))));
  }
  geometry.setAttribute("color", new BufferAttribute(colours, 3));
}
