// Rocks as ellipsoids, where they lie at a time.
import {
  Color,
  Euler,
  FrontSide,
  Group,
  IcosahedronGeometry,
  InstancedMesh,
  Matrix4,
  MeshLambertMaterial,
  Quaternion,
  Vector3,
} from "three";
import type { Palette } from "../palette";
import type { ReplayPayload, Rock } from "../payload";

// Beyond this many rocks small ones get few faces and no shadows, so that a phone keeps up.
const MANY_ROCKS = 500;
const SMALL_M = 0.12;
const FACES = { fine: 3, coarse: 1 };

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
    const small = rocks.filter(coarse).length;
    const meshes = { fine: makeMesh(FACES.fine, rocks.length - small, true), coarse: makeMesh(FACES.coarse, small, false) };
    this.group.add(meshes.fine, meshes.coarse);
    rocks.forEach((rock, i) => {
      const mesh = coarse(rock) ? meshes.coarse : meshes.fine;
      this.places.push({ mesh, slot: mesh.count++ });
      this.place(i, rock);
    });
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

function makeMesh(faces: number, most: number, shadow: boolean): InstancedMesh {
  // Their far sides lie in the ground and would cast shadows around them.
  const material = new MeshLambertMaterial({ shadowSide: FrontSide });
  const mesh = new InstancedMesh(new IcosahedronGeometry(1, faces), material, Math.max(1, most));
  mesh.count = 0;
  mesh.castShadow = shadow;
  mesh.receiveShadow = true;
  // Its bounding sphere would have to follow rocks that are pushed.
  mesh.frustumCulled = false;
  return mesh;
}
