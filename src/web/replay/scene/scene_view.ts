// The trial in three dimensions.
import {
  AmbientLight,
  Color,
  DirectionalLight,
  Group,
  HemisphereLight,
  PCFShadowMap,
  Scene,
  WebGLRenderer,
  type Object3D,
} from "three";
import { CameraRig } from "../camera";
import { headingOf, type Course as Drive } from "../motion";
import { readPalette } from "../palette";
import type { ReplayPayload } from "../payload";
import type { CameraMode, DrawnLink, DrawnPose, Layers, Shown, View } from "../view";
import { makeCourse } from "./course";
import { extentOf, GroundHeights, type Extent } from "./ground";
import { fitLabels } from "./labels";
import { StepPicture } from "./maps";
import { EventMarks } from "./marks";
import { Paths } from "./paths";
import { Rocks } from "./rocks";
import { GhostRover, SolidRover } from "./rover";
import { ScanPoints } from "./scans";
import { makeGrid, makeGround, makeWalls } from "./terrain";

// In lengths of the rover.
const SHADOW_REACH = 4;
const SUN_FROM = [-2, -3, 6] as const;

export class SceneView implements View {
  readonly element: HTMLCanvasElement;
  readonly modes = ["follow", "top", "orbit", "rover"] as const;
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly sun = new DirectionalLight(0xffffff, 2.2);
  private readonly rig: CameraRig;
  private readonly extent: Extent;
  private readonly heights: GroundHeights;
  private readonly rover: SolidRover;
  private readonly ghost: GhostRover;
  private readonly rocks: Rocks;
  private readonly paths: Paths;
  private readonly scan: ScanPoints;
  private readonly step: StepPicture;
  private readonly marks: EventMarks;
  // Ground, walls and course are made anew with the colours.
  private readonly fixed = new Group();
  private grid: Object3D = new Group();

  constructor(
    private readonly payload: ReplayPayload,
    drive: Drive,
    private readonly plan: Extent,
  ) {
    this.renderer = new WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.element = this.renderer.domElement;
    this.extent = extentOf(payload.course);
    this.heights = new GroundHeights(payload.ground);
    this.rover = new SolidRover(payload.rover);
    this.ghost = new GhostRover(payload.rover);
    this.rocks = new Rocks(payload);
    this.paths = new Paths(drive, this.heights);
    this.scan = new ScanPoints(this.heights);
    this.step = new StepPicture(this.heights);
    this.marks = new EventMarks(payload.events, this.heights);
    this.rig = new CameraRig(this.element, this.extent, this.rover.length());
    this.rig.setPlanExtent(plan);
    this.light();
    this.scene.add(this.fixed, this.rocks.group, this.rover.body, this.ghost.body);
    this.scene.add(this.paths.group, this.scan.group, this.step.group, this.marks.group);
    this.recolour();
  }

  get mode(): CameraMode {
    return this.rig.mode;
  }

  setMode(mode: CameraMode): void {
    this.rig.setMode(mode);
    this.rig.update(this.rover.body);
    this.paths.onTop = this.marks.onTop = mode === "top";
  }

  approach(factor: number): void {
    this.rig.approach(factor);
  }

  turn(angle: number): void {
    this.rig.turn(angle);
  }

  onMoved(listener: () => void): void {
    this.rig.onMoved(listener);
  }

  show({ moment, scan, step }: Shown, layers: Layers): void {
    const { attitude, believed } = moment;
    this.rover.body.position.set(moment.x, moment.y, moment.z);
    // The data's digits are few.
    this.rover.body.quaternion.set(attitude.x, attitude.y, attitude.z, attitude.w).normalize();
    this.rover.setJoints(moment.joints);
    this.ghost.body.visible = layers.believed && this.mode !== "rover";
    this.ghost.body.position.set(believed.x, believed.y, this.heights.at(believed.x, believed.y));
    this.ghost.body.rotation.set(0, 0, believed.heading);
    this.ghost.setJoints(moment.joints);
    this.grid.visible = layers.grid;
    this.rocks.show(moment.t);
    this.paths.show(moment, layers.wholePath, layers.believed);
    this.scan.show(layers.scan ? scan : null);
    this.step.show(step, layers);
    this.marks.show(moment.t, layers.marks);
    this.sun.position.set(moment.x + SUN_FROM[0], moment.y + SUN_FROM[1], moment.z + SUN_FROM[2]);
    this.sun.target.position.set(moment.x, moment.y, moment.z);
    this.sun.target.updateMatrixWorld();
    this.rig.update(this.rover.body);
  }

  recolour(): void {
    const palette = readPalette();
    this.scene.background = new Color(palette.sky);
    this.fixed.clear();
    this.grid = makeGrid(this.heights, this.extent, this.plan, palette);
    this.fixed.add(
      makeGround(this.payload.ground, this.extent, palette),
      makeWalls(this.payload.course, this.heights, palette),
      makeCourse(this.payload.course, this.heights, palette),
      this.grid,
    );
    for (const part of [this.rover, this.ghost, this.rocks, this.paths, this.scan, this.step, this.marks]) part.recolour(palette);
  }

  resize(): void {
    const { clientWidth, clientHeight } = this.element.parentElement!;
    const width = Math.max(1, clientWidth);
    const height = Math.max(1, clientHeight);
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
    this.renderer.setSize(width, height);
    this.rig.resize(width, height);
  }

  draw(): void {
    fitLabels(this.fixed, this.rig.camera, this.element.clientHeight);
    this.renderer.render(this.scene, this.rig.camera);
  }

  /** Read back from what was placed in the scene. */
  drawn(): DrawnPose {
    const { position, quaternion } = this.rover.body;
    return { x: position.x, y: position.y, z: position.z, heading: headingOf(quaternion) };
  }

  drawnLinks(): DrawnLink[] {
    return this.rover.pivots();
  }

  private light(): void {
    const reach = SHADOW_REACH * this.rover.length();
    this.scene.add(new AmbientLight(0xffffff, 0.5), new HemisphereLight(0xffffff, 0x8a7a6a, 1.1));
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(1024, 1024);
    const frustum = this.sun.shadow.camera;
    frustum.left = frustum.bottom = -reach;
    frustum.right = frustum.top = reach;
    frustum.near = 1;
    frustum.far = 12;
    this.sun.shadow.bias = -0.001;
    this.sun.shadow.normalBias = 0.01;
    this.scene.add(this.sun, this.sun.target);
  }
}
