// The viewer's place: behind the rover, above the plan, free, or on the rover's front.
import { OrthographicCamera, PerspectiveCamera, Vector3, type Camera, type Object3D } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import type { Extent } from "./scene/ground";
import type { CameraMode } from "./view";

// In lengths of the rover.
const FOLLOW_FROM = new Vector3(-2.3, -1.9, 1.6);
// In the rover's frame and lengths of it: as from a mast, over the front edge to the ground ahead.
const EYE_R = new Vector3(-0.1, 0, 1.05);
const LOOK_R = new Vector3(1.6, 0, 0);
const PLAN_MARGIN = 1.08;

export class CameraRig {
  mode: CameraMode = "follow";
  private readonly near = new PerspectiveCamera(45, 1, 0.02, 500);
  private readonly plan = new OrthographicCamera(-1, 1, 1, -1, 0.1, 500);
  private readonly orbit: OrbitControls;
  private readonly pan: OrbitControls;
  private readonly target = new Vector3();
  private width = 1;
  private height = 1;
  private planned: Extent | null = null;

  constructor(element: HTMLElement, private readonly extent: Extent, private readonly length_m: number) {
    for (const camera of [this.near, this.plan]) camera.up.set(0, 0, 1);
    // x to the right and y up.
    this.plan.up.set(0, 1, 0);
    this.orbit = new OrbitControls(this.near, element);
    this.orbit.maxPolarAngle = 0.495 * Math.PI;
    this.orbit.minDistance = 0.3;
    this.orbit.maxDistance = 150;
    this.pan = new OrbitControls(this.plan, element);
    this.pan.enableRotate = false;
    this.pan.screenSpacePanning = true;
    // One finger or the left button moves the plan.
    this.pan.mouseButtons.LEFT = this.pan.mouseButtons.RIGHT;
    this.pan.touches.ONE = 1;
    for (const controls of [this.orbit, this.pan]) controls.enableDamping = false;
    this.near.position.copy(FOLLOW_FROM).multiplyScalar(length_m);
    this.setMode("follow");
  }

  get camera(): Camera { return this.mode === "top" ? this.plan : this.near; }

  onMoved(listener: () => void): void {
    this.orbit.addEventListener("change", listener);
    this.pan.addEventListener("change", listener);
  }

  setMode(mode: CameraMode): void {
    const before = this.mode;
    this.mode = mode;
    this.orbit.enabled = mode === "follow" || mode === "orbit";
    this.pan.enabled = mode === "top";
    if (mode === "top") this.fitPlan(this.planned ?? this.extent);
    if (mode === "follow" || (mode === "orbit" && before === "rover")) this.near.position.copy(this.target).addScaledVector(FOLLOW_FROM, this.length_m);
    if (this.orbit.enabled) {
      this.orbit.target.copy(this.target);
      this.orbit.update();
    }
  }

  /** Nearer by a factor, or further away below 1. */
  approach(factor: number): void {
    if (this.mode === "top") {
      this.plan.zoom *= factor;
      this.plan.updateProjectionMatrix();
    } else if (this.orbit.enabled) {
      this.near.position.sub(this.orbit.target).divideScalar(factor).add(this.orbit.target);
      this.orbit.update();
    }
  }

  /** Around what is looked at, rad, counter-clockwise from above. */
  turn(angle: number): void {
    if (!this.orbit.enabled) return;
    const { target } = this.orbit;
    this.near.position.sub(target).applyAxisAngle(this.near.up, angle).add(target);
    this.orbit.update();
  }

  /** What the plan shows when it is opened. */
  setPlanExtent(extent: Extent): void {
    this.planned = extent;
    if (this.mode === "top") this.fitPlan(extent);
  }

  resize(width: number, height: number): void {
    this.width = width;
    this.height = height;
    this.near.aspect = width / height;
    this.near.updateProjectionMatrix();
    this.fitPlan(this.planned ?? this.extent);
  }

  /** Goes with the rover where the mode says so. */
  update(rover: Object3D): void {
    const moved = rover.position.clone().sub(this.target);
    this.target.copy(rover.position);
    if (this.mode === "follow" && moved.lengthSq() > 0) {
      this.near.position.add(moved);
      this.orbit.target.copy(this.target);
      this.orbit.update();
    }
    if (this.mode === "rover") {
      rover.updateMatrixWorld();
      this.near.position.copy(rover.localToWorld(EYE_R.clone().multiplyScalar(this.length_m)));
      this.near.lookAt(rover.localToWorld(LOOK_R.clone().multiplyScalar(this.length_m)));
    }
  }

  private fitPlan({ xMin, xMax, yMin, yMax }: Extent): void {
    const aspect = this.width / this.height;
    const half = (PLAN_MARGIN / 2) * Math.max(yMax - yMin, (xMax - xMin) / aspect, 0.5);
    this.plan.left = -half * aspect;
    this.plan.right = half * aspect;
    this.plan.top = half;
    this.plan.bottom = -half;
    this.plan.zoom = 1;
    this.plan.position.set((xMin + xMax) / 2, (yMin + yMax) / 2, 100);
    this.pan.target.set((xMin + xMax) / 2, (yMin + yMax) / 2, 0);
    this.plan.updateProjectionMatrix();
    this.pan.update();
  }
}
