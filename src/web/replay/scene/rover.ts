// The articulated rover: its links as groups that turn about their pivots; solid, or as an outline.
import {
  Box3, BoxGeometry, BufferGeometry, CapsuleGeometry, Color, CylinderGeometry, EdgesGeometry, Float32BufferAttribute,
  Group, LineBasicMaterial, LineSegments, Mesh, MeshLambertMaterial, Object3D, Quaternion, SphereGeometry, Vector3,
} from "three";
import { mergeGeometries } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import type { Palette } from "../palette";
import type { RoverShape, Shape } from "../payload";
import type { DrawnLink } from "../view";

type Vec = [number, number, number];

const GROUSERS = 16;
const EDGE_ANGLE_DEG = 35;

interface Link { name: string; axis: Vector3; group: Group }

abstract class Rover {
  /** Frame R. */
  readonly body = new Group();
  private readonly links: Link[] = [];

  protected build(shape: RoverShape): void {
    for (const { name, parent, pivot, axis, shapes } of shape.links) {
      const group = new Group();
      if (this.links.length > 0) {
        group.position.set(...pivot);
        (this.links[parent]?.group ?? this.body).add(group);
      } else {
        this.body.add(group);
      }
      for (const part of shapes) this.add(group, part);
      this.links.push({ name, axis: new Vector3(...axis).normalize(), group });
    }
  }

  protected abstract add(group: Group, shape: Shape): void;

  /** From front to rear while all angles are 0, m. */
  length(): number {
    const box = new Box3().setFromObject(this.body);
    return Math.max(0.1, box.max.x - box.min.x);
  }

  /** In the frame of the scene. */
  pivots(): DrawnLink[] {
    this.body.updateMatrixWorld();
    return this.links.map(({ name, group }) => {
      const { x, y, z } = group.getWorldPosition(new Vector3());
      const turn = group.getWorldQuaternion(new Quaternion());
      return { name, x, y, z, attitude: { w: turn.w, x: turn.x, y: turn.y, z: turn.z } };
    });
  }

  setJoints(joints: Record<string, number>): void {
    for (const { name, axis, group } of this.links.slice(1)) group.quaternion.setFromAxisAngle(axis, joints[name] ?? 0);
  }
}

interface Painted { geometry: BufferGeometry; of: keyof Palette; shade: number }

/** The rover as it is: one mesh for each link, painted corner by corner. */
export class SolidRover extends Rover {
  private readonly painted = new Map<Object3D, Painted[]>();
  private readonly meshes: { mesh: Mesh; parts: Painted[] }[];

  constructor(shape: RoverShape) {
    super();
    this.build(shape);
    const material = new MeshLambertMaterial({ vertexColors: true });
    this.meshes = [...this.painted].map(([group, parts]) => {
      const mesh = new Mesh(mergeGeometries(parts.map(({ geometry }) => geometry)), material);
      mesh.castShadow = mesh.receiveShadow = true;
      group.add(mesh);
      return { mesh, parts };
    });
  }

  recolour(palette: Palette): void {
    for (const { mesh, parts } of this.meshes) {
      const colours = parts.flatMap(({ geometry, of, shade }) => {
        const colour = new Color(palette[of]).multiplyScalar(shade).toArray();
        return Array.from({ length: geometry.getAttribute("position").count }, () => colour).flat();
      });
      mesh.geometry.setAttribute("color", new Float32BufferAttribute(colours, 3));
    }
  }

  protected add(group: Group, shape: Shape): void {
    if (shape.kind === "wheel") {
      this.addWheel(group, shape);
      return;
    }
    const panel = shape.part.includes("panel");
    const of: keyof Palette = shape.kind === "box" ? (panel ? "panel" : "body") : "arm";
    this.paint(group, geometryOf(shape), of);
    if (shape.kind === "box" && panel) this.addCells(group, shape.center, shape.size);
  }

  // Rim, grousers and spokes: with a plain cylinder nobody sees it roll.
  private addWheel(group: Group, { center, radius, width }: Extract<Shape, { kind: "wheel" }>): void {
    const put = (geometry: BufferGeometry, of: keyof Palette, shade = 1): void =>
      this.paint(group, geometry.translate(...center), of, shade);
    put(new CylinderGeometry(0.94 * radius, 0.94 * radius, width, 32), "wheel");
    for (let i = 0; i < GROUSERS; ++i) {
      const angle = (2 * Math.PI * i) / GROUSERS;
      const grouser = new BoxGeometry(0.16 * radius, width, 0.08 * radius).rotateY(angle);
      put(grouser.translate(0.92 * radius * Math.cos(angle), 0, -0.92 * radius * Math.sin(angle)), "wheel", 1.5);
    }
    for (const angle of [0, Math.PI / 3, (2 * Math.PI) / 3]) {
      put(new BoxGeometry(1.5 * radius, 1.02 * width, 0.14 * radius).rotateY(angle), "arm", 0.9);
    }
  }

  // Rows of solar cells, and a bright edge that says where the front is.
  private addCells(group: Group, [x, y, z]: Vec, [length, width, height]: Vec): void {
    const put = (geometry: BufferGeometry, of: keyof Palette, px: number, py: number): void =>
      this.paint(group, geometry.translate(px, py, z + height / 2), of);
    for (let i = 1; i < 6; ++i) put(new BoxGeometry(0.006, 0.96 * width, 0.002), "arm", x + (i / 6 - 0.5) * length, y);
    for (let i = 1; i < 4; ++i) put(new BoxGeometry(0.96 * length, 0.006, 0.002), "arm", x, y + (i / 4 - 0.5) * width);
    put(new BoxGeometry(0.03, 0.98 * width, 0.004), "chosen", x + length / 2 - 0.02, y);
  }

  private paint(group: Object3D, geometry: BufferGeometry, of: keyof Palette, shade = 1): void {
    this.painted.set(group, [...(this.painted.get(group) ?? []), { geometry, of, shade }]);
  }
}

/** The rover where it believes to be: edges only. */
export class GhostRover extends Rover {
  private readonly material = new LineBasicMaterial({ transparent: true, opacity: 0.9 });

  constructor(shape: RoverShape) {
    super();
    this.build(shape);
  }

  recolour(palette: Palette): void { this.material.color.set(palette["believed-path"]); }

  protected add(group: Group, shape: Shape): void {
    if (shape.kind === "sphere" || shape.kind === "capsule") return;
    group.add(new LineSegments(new EdgesGeometry(geometryOf(shape), EDGE_ANGLE_DEG), this.material));
  }
}

/** In the frame of the link. */
function geometryOf(shape: Shape): BufferGeometry {
  switch (shape.kind) {
    case "box":
      return new BoxGeometry(...shape.size).translate(...shape.center);
    case "wheel":
      return new CylinderGeometry(shape.radius, shape.radius, shape.width, 24).translate(...shape.center);
    case "sphere":
      return new SphereGeometry(shape.radius, 16, 12).translate(...shape.center);
    case "capsule": {
      const from = new Vector3(...shape.from);
      const to = new Vector3(...shape.to);
      const along = to.clone().sub(from);
      const turn = new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), along.clone().normalize());
      const middle = from.add(to).multiplyScalar(0.5);
      return new CapsuleGeometry(shape.radius, along.length(), 4, 10)
        .applyQuaternion(turn)
        .translate(middle.x, middle.y, middle.z);
    }
  }
}
