// What the last scan of the light stripes returned.
import { Group, IcosahedronGeometry, InstancedMesh, Matrix4, MeshBasicMaterial, OctahedronGeometry, Quaternion, Vector3 } from "three";
import type { Palette } from "../palette";
import type { Scan } from "../payload";
import type { GroundHeights } from "./ground";
import { Lines, type Point } from "./lines";

const CLEAR_M = 0.014;
const HAZARD_M = 0.03;
const LIFT_M = 0.006;

/** Points of clear stripes are balls, points of stripes with a hazard larger diamonds on pins. */
export class ScanPoints {
  readonly group = new Group();
  private readonly clear = new MeshBasicMaterial();
  private readonly hazard = new MeshBasicMaterial();
  private readonly stripes = { clear: new Lines({ width_px: 2, opacity: 0.8 }), hazard: new Lines({ width_px: 3 }) };
  private meshes: InstancedMesh[] = [];
  private shown: Scan | null = null;

  constructor(private readonly heights: GroundHeights) {
    this.group.add(this.stripes.clear.object, this.stripes.hazard.object);
  }

  recolour(palette: Palette): void {
    this.clear.color.set(palette.clear);
    this.hazard.color.set(palette.hazard);
    this.stripes.clear.recolour(palette.clear);
    this.stripes.hazard.recolour(palette.hazard);
  }

  show(scan: Scan | null): void {
    this.group.visible = scan !== null;
    if (scan === null || scan === this.shown) return;
    this.shown = scan;
    for (const mesh of this.meshes) {
      this.group.remove(mesh);
      mesh.geometry.dispose();
      mesh.dispose();
    }
    const place = ({ x, y, z }: Scan["points"][number]): Point => [x, y, z + LIFT_M];
    const isHazard = (point: Scan["points"][number]): boolean => scan.hazards[point.stripe] === true;
    this.meshes = [
      this.balls(scan.points.filter((p) => !isHazard(p)).map(place)),
      this.diamonds(scan.points.filter(isHazard).map(place)),
    ];
    this.group.add(...this.meshes);
    this.drawStripes(scan, place);
  }

  private balls(points: Point[]): InstancedMesh {
    return instances(new IcosahedronGeometry(CLEAR_M, 1), this.clear, points);
  }

  private diamonds(points: Point[]): InstancedMesh {
    return instances(new OctahedronGeometry(HAZARD_M), this.hazard, points);
  }

  // Along each fan of light from near to far; hazards also get pins from the ground.
  private drawStripes(scan: Scan, place: (point: Scan["points"][number]) => Point): void {
    const clear: Point[] = [];
    const hazard: Point[] = [];
    for (const stripe of new Set(scan.points.map((point) => point.stripe))) {
      const points = scan.points.filter((point) => point.stripe === stripe);
      const away = (p: { x: number; y: number }): number => Math.hypot(p.x - scan.x, p.y - scan.y);
      points.sort((a, b) => away(a) - away(b));
      const target = scan.hazards[stripe] ? hazard : clear;
      for (let i = 1; i < points.length; ++i) target.push(place(points[i - 1]!), place(points[i]!));
      if (!scan.hazards[stripe]) continue;
      for (const { x, y, z } of points) hazard.push([x, y, this.heights.at(x, y)], [x, y, z + LIFT_M]);
    }
    this.stripes.clear.set(clear);
    this.stripes.hazard.set(hazard);
  }
}

function instances(geometry: IcosahedronGeometry | OctahedronGeometry, material: MeshBasicMaterial, points: Point[]): InstancedMesh {
  const mesh = new InstancedMesh(geometry, material, Math.max(1, points.length));
  mesh.count = points.length;
  mesh.frustumCulled = false;
  const upright = new Quaternion();
  const size = new Vector3(1, 1, 1);
  points.forEach((point, i) => mesh.setMatrixAt(i, new Matrix4().compose(new Vector3(...point), upright, size)));
  return mesh;
}
