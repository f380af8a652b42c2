// Rocks where they lie at a time: rough, or in the shapes that the simulator uses. Those that look
// small get few faces.
import {
  type BufferGeometry,
  type Camera,
  Color,
  Euler,
  FrontSide,
  Frustum,
  Group,
  InstancedMesh,
  Matrix4,
  MeshLambertMaterial,
  Quaternion,
  Sphere,
  type Texture,
  Vector3,
} from "three";
import type { Palette } from "../palette";
import type { ReplayPayload, Rock } from "../payload";
import { pixelsPerMetre } from "./labels";
import { MOST_ROCK_TRIANGLES } from "./limits";
import { colourRock, DETAILS, rockGeometry } from "./rock_shapes";

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
interface Kind {
  rough: BufferGeometry[];
  smooth: BufferGeometry[];
  levels: InstancedMesh[];
}

interface Placed {
  kind: Kind;
  matrix: Matrix4;
  colour: Color;
  sphere: Sphere;
}

export class Rocks {
  readonly group = new Group();
  private readonly kinds = new Map<string, Kind>();
  private readonly placed: Placed[];
  private readonly materials: { rough: MeshLambertMaterial; smooth: MeshLambertMaterial };
  private applied = 0;
  private smooth = false;

  constructor(
    private readonly payload: ReplayPayload,
    private readonly texture: Texture,
  ) {
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
