// Marks on the ground where something happened to the rover: filled circles where it believed in a
// hazard, as in figure 16 of Matthies 1995, crosses where it scraped a rock, squares where it got
// stuck.
import { BufferGeometry, CircleGeometry, DoubleSide, Group, InstancedMesh, Matrix4, MeshBasicMaterial, PlaneGeometry } from "three";
import { mergeGeometries } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import { lastAtOrBefore } from "../motion";
import type { Palette } from "../palette";
import type { TrialEvent } from "../payload";
import type { GroundHeights } from "./ground";

const SIZE_M = 0.045;
// One above the other where they share a place.
const LIFT_M = { stall: 0.018, hazard: 0.02, scrape: 0.024 };

// In the order of drawing.
const MARKED = ["stall", "hazard", "scrape"] as const;
type Marked = (typeof MARKED)[number];

function shapeOf(kind: Marked): BufferGeometry {
  switch (kind) {
    case "hazard":
      return new CircleGeometry(SIZE_M, 24);
    case "scrape": {
      const bar = (angle: number): BufferGeometry => new PlaneGeometry(3 * SIZE_M, 0.6 * SIZE_M).rotateZ(angle);
      return mergeGeometries([bar(Math.PI / 4), bar(-Math.PI / 4)]);
    }
    case "stall":
      return new PlaneGeometry(2.4 * SIZE_M, 2.4 * SIZE_M);
  }
}

export class EventMarks {
  readonly group = new Group();
  private readonly sets: { kind: Marked; times: number[]; mesh: InstancedMesh; material: MeshBasicMaterial }[] = [];

  constructor(events: TrialEvent[], heights: GroundHeights) {
    for (const kind of MARKED) {
      const own = events.filter((event) => event.kind === kind);
      if (own.length === 0) continue;
      const material = new MeshBasicMaterial({ side: DoubleSide, transparent: true });
      const mesh = new InstancedMesh(shapeOf(kind), material, own.length);
      mesh.frustumCulled = false;
      own.forEach(({ x, y }, i) => mesh.setMatrixAt(i, new Matrix4().makeTranslation(x, y, heights.at(x, y) + LIFT_M[kind])));
      this.sets.push({ kind, times: own.map((event) => event.t), mesh, material });
      this.group.add(mesh);
    }
  }

  recolour(palette: Palette): void {
    for (const { kind, material } of this.sets) material.color.set(palette[kind]);
  }

  show(t: number, visible: boolean): void {
    this.group.visible = visible;
    for (const { mesh, times } of this.sets) mesh.count = lastAtOrBefore(times, t) + 1;
  }

  /** In front of everything where the picture is a plan. */
  set onTop(on: boolean) {
    for (const { kind, mesh, material } of this.sets) {
      material.depthTest = !on;
      mesh.renderOrder = on ? 11 + MARKED.indexOf(kind) : 0;
    }
  }
}
