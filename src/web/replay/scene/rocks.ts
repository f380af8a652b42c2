// Rocks as ellipsoids, where they lie at a time.
import { Color, Euler, FrontSide, IcosahedronGeometry, InstancedMesh, Matrix4, MeshLambertMaterial, Quaternion, Vector3 } from "three";
import type { Palette } from "../palette";
import type { ReplayPayload } from "../payload";

// Beyond this many rocks each is drawn with fewer faces, so that a phone keeps up.
const MANY_ROCKS = 500;

export class Rocks {
  readonly mesh: InstancedMesh;
  private applied = 0;

  constructor(private readonly payload: ReplayPayload) {
    const { rocks } = payload;
    const geometry = new IcosahedronGeometry(1, rocks.length > MANY_ROCKS ? 2 : 3);
    // Their far sides lie in the ground and would cast shadows around them.
    const material = new MeshLambertMaterial({ shadowSide: FrontSide });
    this.mesh = new InstancedMesh(geometry, material, Math.max(1, rocks.length));
    this.mesh.count = rocks.length;
    this.mesh.castShadow = true;
    this.mesh.receiveShadow = true;
    // Its bounding sphere would have to follow rocks that are pushed.
    this.mesh.frustumCulled = false;
    rocks.forEach((rock, i) => this.place(i, rock));
  }

  recolour(palette: Palette): void {
    const base = new Color(palette.rock);
    this.payload.rocks.forEach((_, i) => {
      // A shade of its own each, always the same: neighbours are told apart.
      const shade = 0.86 + 0.28 * ((i * 0.618034) % 1);
      this.mesh.setColorAt(i, base.clone().multiplyScalar(shade));
    });
    if (this.mesh.instanceColor) this.mesh.instanceColor.needsUpdate = true;
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
    if (!rock) return;
    const matrix = new Matrix4().compose(
      new Vector3(center.x, center.y, center.z),
      new Quaternion().setFromEuler(new Euler(0, 0, rock.yaw)),
      new Vector3(rock.a, rock.b, rock.c),
    );
    this.mesh.setMatrixAt(index, matrix);
    this.mesh.instanceMatrix.needsUpdate = true;
  }
}
