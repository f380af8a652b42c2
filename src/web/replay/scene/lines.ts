// Lines of a width in pixels, as sets of straight pieces.
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";

export type Point = [number, number, number];

interface LineStyle {
  width_px: number;
  /** Lengths of dash and gap, m. */
  dash?: [number, number];
  opacity?: number;
  /** A wider line below another one at the same place, which it keeps apart from the ground. */
  edge?: boolean;
}

export class Lines {
  readonly object: LineSegments2;
  private readonly material: LineMaterial;
  private count = 0;

  constructor(private readonly style: LineStyle) {
    this.material = new LineMaterial({
      linewidth: style.width_px,
      dashed: style.dash !== undefined,
      dashSize: style.dash?.[0] ?? 1,
      gapSize: style.dash?.[1] ?? 1,
      transparent: true,
      opacity: style.opacity ?? 1,
      depthWrite: !style.edge,
    });
    this.object = new LineSegments2(new LineSegmentsGeometry(), this.material);
    this.object.visible = false;
    this.object.frustumCulled = false;
  }

  /** Pieces as pairs of points: from, to, from, to, ... */
  set(points: Point[]): void {
    this.count = points.length >> 1;
    this.object.visible = this.count > 0;
    if (this.count === 0) return;
    // A new geometry, because the old one keeps buffers of the old size.
    this.object.geometry.dispose();
    this.object.geometry = new LineSegmentsGeometry();
    this.object.geometry.setPositions(points.flat());
    this.object.computeLineDistances();
  }

  /** A line through all points. */
  setPath(points: Point[]): void { this.set(points.slice(1).flatMap((point, i) => [points[i]!, point])); }

  /** Shows the first `count` pieces only. */
  showFirst(count: number): void {
    this.object.geometry.instanceCount = Math.min(this.count, Math.max(0, count));
    this.object.visible = this.count > 0 && count > 0;
  }

  recolour(colour: string): void { this.material.color.set(colour); }

  /** In front of everything where the picture is a plan. */
  set onTop(on: boolean) {
    this.material.depthTest = !on;
    this.object.renderOrder = (on ? 10 : 1) - (this.style.edge ? 0.5 : 0);
  }
}
