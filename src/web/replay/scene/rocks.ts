// Rocks as ellipsoids and caps, where they lie at a time.
import {
  type BufferGeometry,
  Color,
  Euler,
  FrontSide,
  Group,
  IcosahedronGeometry,
  InstancedMesh,
  LatheGeometry,
  Matrix4,
  MeshLambertMaterial,
  Quaternion,
  Vector2,
  Vector3,
} from "three";
import type { Palette } from "../palette";
import type { ReplayPayload, Rock } from "../payload";

// Beyond this many rocks small ones get few faces and no shadows, so that a phone keeps up.
const MANY_ROCKS = 500;
const SMALL_M = 0.12;
const FACES = { fine: 3, coarse: 1 };
// Points of a cap's profile, and sides around it.
const CAP_RINGS = { fine: 16, coarse: 6 };
const CAP_SIDES = { fine: 40, coarse: 12 };
// Caps of nearly the same growth share a geometry.
const GROWTH_STEP = 0.05;

type Detail = keyof typeof FACES;

interface Place {
  mesh: InstancedMesh;
  slot: number;
}

export class Rocks {
  readonly group = new Group();
  private readonly places: Place[] = [];
  private applied = 0;

  constructor(private readonly payload: ReplayPayload) {
    const { rocks } = payload;
    const coarse = (rock: Rock): boolean => rocks.length > MANY_ROCKS && Math.max(rock.a, rock.b, rock.c) < SMALL_M;
    const kindOf = (rock: Rock): string => `${coarse(rock) ? "coarse" : "fine"} ${growthClass(rock)}`;
    const counts = new Map<string, number>();
    for (const rock of rocks) counts.set(kindOf(rock), (counts.get(kindOf(rock)) ?? 0) + 1);
    const meshes = new Map<string, InstancedMesh>();
    rocks.forEach((rock, i) => {
      const kind = kindOf(rock);
      const detail = coarse(rock) ? "coarse" : "fine";
      const mesh = meshes.get(kind) ?? makeMesh(geometryOf(growthClass(rock), detail), counts.get(kind)!, detail === "fine");
      meshes.set(kind, mesh);
      this.places.push({ mesh, slot: mesh.count++ });
      this.place(i, rock);
    });
    for (const mesh of meshes.values()) this.group.add(mesh);
  }

  recolour(palette: Palette): void {
    const base = new Color(palette.rock);
    this.places.forEach(({ mesh, slot }, i) => {
      // A shade of its own each, always the same: neighbours are told apart.
      const shade = 0.86 + 0.28 * ((i * 0.618034) % 1);
      mesh.setColorAt(slot, base.clone().multiplyScalar(shade));
      mesh.instanceColor!.needsUpdate = true;
    });
  }

  /** Puts rocks where they had been pushed to by `t`. */
  show(t: number): void {
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

  private place(index: number, center: { x: number; y: number; z: number }): void {
    const rock = this.payload.rocks[index];
    const place = this.places[index];
    if (!rock || !place) return;
    const matrix = new Matrix4().compose(
      new Vector3(center.x, center.y, center.z),
      new Quaternion().setFromEuler(new Euler(0, 0, rock.yaw)),
      new Vector3(rock.a, rock.b, rock.c),
    );
    place.mesh.setMatrixAt(place.slot, matrix);
    place.mesh.instanceMatrix.needsUpdate = true;
  }
}

/** The growth that a rock is drawn with, 0 for an ellipsoid. */
function growthClass({ growth }: Rock): number {
  return growth ? Math.max(0.5, Math.round(growth / GROWTH_STEP)) * GROWTH_STEP : 0;
}

/** A rock whose semi-axes are 1. */
function geometryOf(growth: number, detail: Detail): BufferGeometry {
  if (growth === 0) return new IcosahedronGeometry(1, FACES[detail]);
  const rings = CAP_RINGS[detail];
  const profile = Array.from({ length: rings + 1 }, (_, i) => {
    // From the base up, denser towards the top, where it bends.
    const s = (1 - i / rings) ** 2;
    return new Vector2(Math.sqrt((growth + (1 - growth) * s) * s), 1 - s);
  });
  // A lathe turns about y.
  return new LatheGeometry(profile, CAP_SIDES[detail]).rotateX(Math.PI / 2);
}

function makeMesh(geometry: BufferGeometry, most: number, shadow: boolean): InstancedMesh {
  // Their far sides lie in the ground and would cast shadows around them.
  const material = new MeshLambertMaterial({ shadowSide: FrontSide });
  const mesh = new InstancedMesh(geometry, material, most);
  mesh.count = 0;
  mesh.castShadow = shadow;
  mesh.receiveShadow = true;
  // Its bounding sphere would have to follow rocks that are pushed.
  mesh.frustumCulled = false;
  return mesh;
}
