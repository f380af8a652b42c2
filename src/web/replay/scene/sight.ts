// What the terrain sensor lights and sees: light planes while a scan runs, and the views of cameras as
// pyramids that end on the ground.

import { BufferGeometry, DoubleSide, DynamicDrawUsage, Float32BufferAttribute, Group, Mesh, MeshBasicMaterial, type Object3D, Vector3 } from "three";

import type { Palette } from "../palette";
import type { ReplayPayload, Rock, Sensor } from "../payload";
import type { DrawnPlane } from "../view";
import type { GroundHeights } from "./ground";
import { Lines, type Point } from "./lines";

const RAYS_OF_A_PLANE = 24;
const LIFT_M = 0.004;
// Neighbouring points of a stripe further apart are no one line: it goes on on another surface.
const JUMP_M = 0.12;

interface Ray { end: Vector3; hits: boolean }

interface Bundle { eye: Vector3; rays: Vector3[] }

export class Sight {
  readonly group = new Group();
  private readonly planes = new Picture({ opacity: 0.2, width_px: 2.5 });
  private readonly views = new Picture({ opacity: 0.07, width_px: 1.5 });
  private readonly lasers = this.payload.sensor.lasers.map(planeRays);
  private readonly cameras = this.payload.sensor.cameras.map(({ eye, rim }): Bundle =>
    ({ eye: new Vector3(...eye), rays: rim.map((ray) => new Vector3(...ray)) }));
  private readonly corners = Math.max(1, (this.cameras[0]?.rays.length ?? 4) / 4);
  private drawn: DrawnPlane[] = [];

  constructor(private readonly payload: ReplayPayload, private readonly heights: GroundHeights) {
    this.group.add(...this.planes.objects, ...this.views.objects);
  }

  recolour(palette: Palette): void {
    this.planes.recolour(palette.laser);
    this.views.recolour(palette.camera);
  }

  /** `rover` is the drawn chassis, whose frame is R; rocks lie where they had been pushed to by `t`. */
  show(rover: Object3D, t: number, light: boolean, cameras: boolean): void {
    rover.updateMatrixWorld();
    this.planes.visible = light;
    this.views.visible = cameras;
    this.drawn = [];
    if (!light && !cameras) return;
    const rocks = this.rocksNear(rover.position, t);
    if (light) this.showPlanes(this.lasers.map((laser) => this.cast(laser, rover, rocks)));
    if (cameras) this.showViews(this.cameras.map((camera) => this.cast(camera, rover, rocks)));
  }

  /** The light planes that are drawn now. */
  drawnPlanes(): DrawnPlane[] { return this.drawn; }

  /** How many cameras' views are drawn now. */
  get drawnViews(): number { return this.views.visible ? this.cameras.length : 0; }

  private showPlanes(fans: { eye: Vector3; rays: Ray[] }[]): void {
    const stripes: Point[] = [];
    for (const { rays } of fans) {
      rays.slice(1).forEach((to, i) => {
        const from = rays[i]!;
        if (from.hits && to.hits && from.end.distanceTo(to.end) < JUMP_M) stripes.push(lifted(from.end), lifted(to.end));
      });
    }
    this.planes.set(fans.flatMap(({ eye, rays }) => fan(eye, rays)), stripes);
    this.drawn = fans.map(({ eye, rays }) => ({ emitter: plain(eye), ends: rays.map(({ end }) => plain(end)) }));
  }

  private showViews(fans: { eye: Vector3; rays: Ray[] }[]): void {
    const edges: Point[] = [];
    for (const { eye, rays } of fans) {
      const closed = [...rays, rays[0]!];
      closed.slice(1).forEach((to, i) => edges.push(lifted(closed[i]!.end), lifted(to.end)));
      rays.forEach(({ end }, i) => {
        if (i % this.corners === 0) edges.push(eye.toArray(), end.toArray());
      });
    }
    this.views.set(fans.flatMap(({ eye, rays }) => fan(eye, [...rays, rays[0]!])), edges);
  }

  private cast({ eye, rays }: Bundle, rover: Object3D, rocks: PlacedRock[]): { eye: Vector3; rays: Ray[] } {
    const { reach } = this.payload.sensor;
    const from = rover.localToWorld(eye.clone());
    const ends = rays.map((ray) => {
      const along = ray.clone().applyQuaternion(rover.quaternion);
      const hit = firstHit(from, along, reach, this.heights, rocks);
      return { end: from.clone().addScaledVector(along, hit ?? reach), hits: hit !== null };
    });
    return { eye: from, rays: ends };
  }

  private rocksNear({ x, y }: Vector3, t: number): PlacedRock[] {
    const { rocks, rock_moves: moves, sensor } = this.payload;
    const placed = rocks.map((rock) => ({ rock, x: rock.x, y: rock.y, z: rock.z }));
    for (const { rock, t: at, x: px, y: py, z } of moves) if (at <= t) Object.assign(placed[rock]!, { x: px, y: py, z });
    return placed.filter(({ rock, x: px, y: py }) => Math.hypot(px - x, py - y) < sensor.reach + 1 + Math.max(rock.a, rock.b));
  }
}

/** Translucent triangles with lines. */
class Picture {
  private readonly material: MeshBasicMaterial;
  private readonly mesh: Mesh;
  private readonly lines: Lines;

  constructor({ opacity, width_px }: { opacity: number; width_px: number }) {
    this.material = new MeshBasicMaterial({ transparent: true, opacity, side: DoubleSide, depthWrite: false });
    this.mesh = new Mesh(new BufferGeometry(), this.material);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = 3;
    this.lines = new Lines({ width_px });
  }

  get objects(): Object3D[] { return [this.mesh, this.lines.object]; }

  get visible(): boolean { return this.mesh.visible; }

  set visible(on: boolean) { this.mesh.visible = this.lines.object.visible = on; }

  recolour(colour: string): void {
    this.material.color.set(colour);
    this.lines.recolour(colour);
  }

  set(corners: number[], lines: Point[]): void {
    this.mesh.geometry.dispose();
    this.mesh.geometry = new BufferGeometry();
    this.mesh.geometry.setAttribute("position", new Float32BufferAttribute(corners, 3).setUsage(DynamicDrawUsage));
    this.lines.set(lines);
  }
}

/** Directions within half a fan of the axis, in the light plane. */
function planeRays({ emitter, normal, axis, half_fan: half }: Sensor["lasers"][number]): Bundle {
  const rays = Array.from({ length: RAYS_OF_A_PLANE + 1 }, (_, i) =>
    new Vector3(...axis).applyAxisAngle(new Vector3(...normal).normalize(), half * ((2 * i) / RAYS_OF_A_PLANE - 1)),
  );
  return { eye: new Vector3(...emitter), rays };
}

function fan(eye: Vector3, rays: Ray[]): number[] {
  return rays.slice(1).flatMap(({ end }, i) => [...eye.toArray(), ...rays[i]!.end.toArray(), ...end.toArray()]);
}

const lifted = ({ x, y, z }: Vector3): Point => [x, y, z + LIFT_M];

const plain = ({ x, y, z }: Vector3): { x: number; y: number; z: number } => ({ x, y, z });

// ---- Where rays of light meet ground and rocks, in their true shapes.

const STEP_M = 0.04;
const HALVINGS = 8;

interface PlacedRock { rock: Rock; x: number; y: number; z: number }

/** Distance to the first surface along a unit ray; null where there is none within `reach`. */
function firstHit(from: Vector3, ray: Vector3, reach: number, heights: GroundHeights, rocks: PlacedRock[]): number | null {
  let nearest = groundHit(from, ray, reach, heights);
  for (const rock of rocks) {
    const hit = rockHit(from, ray, rock);
    if (hit !== null && hit < (nearest ?? reach)) nearest = hit;
  }
  return nearest;
}

function groundHit(from: Vector3, ray: Vector3, reach: number, heights: GroundHeights): number | null {
  const above = (s: number): number => from.z + s * ray.z - heights.at(from.x + s * ray.x, from.y + s * ray.y);
  for (let s = 0; s < reach; s += STEP_M) {
    if (above(s + STEP_M) > 0) continue;
    let [low, high] = [s, s + STEP_M];
    for (let i = 0; i < HALVINGS; ++i) {
      const middle = (low + high) / 2;
      if (above(middle) > 0) low = middle;
      else high = middle;
    }
    return high;
  }
  return null;
}

/** Every rock is a quadric in its own unit coordinates: rho^2 = A s + B s^2, see payload.ts; ellipsoids have z^2 + rho^2 = 1. */
function rockHit(from: Vector3, ray: Vector3, { rock, x, y, z }: PlacedRock): number | null {
  const [c, s] = [Math.cos(rock.yaw), Math.sin(rock.yaw)];
  const own = (dx: number, dy: number, dz: number): Vector3 =>
    new Vector3((c * dx + s * dy) / rock.a, (c * dy - s * dx) / rock.b, dz / rock.c);
  const p = own(from.x - x, from.y - y, from.z - z);
  const d = own(ray.x, ray.y, ray.z);
  const { growth } = rock;
  const [u, v] = growth ? [1 - p.z, -d.z] : [p.z, d.z];
  const [linear, square] = growth ? [growth, 1 - growth] : [0, -1];
  // F(t) = rho^2 - linear w - square w^2 - constant with w = u + v t.
  const constant = growth ? 0 : 1;
  const a = d.x * d.x + d.y * d.y - square * v * v;
  const b = 2 * (p.x * d.x + p.y * d.y) - linear * v - 2 * square * u * v;
  const f = p.x * p.x + p.y * p.y - linear * u - square * u * u - constant;
  const root = b * b - 4 * a * f;
  if (root < 0 || Math.abs(a) < 1e-12) return null;
  const ends = [(-b - Math.sqrt(root)) / (2 * a), (-b + Math.sqrt(root)) / (2 * a)].sort((one, other) => one - other);
  // A cap ends at its base, and its quadric goes on above its top.
  const on = (t: number): boolean => t > 0 && (!growth || (u + v * t >= 0 && u + v * t <= 1));
  return ends.find(on) ?? null;
}
