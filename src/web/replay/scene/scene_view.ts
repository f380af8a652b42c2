// The trial in three dimensions.
import { Color, Group, Mesh, PCFShadowMap, Scene, WebGLRenderer, type Object3D } from "three";
import { CameraRig } from "../camera";
import { headingOf, type Course as Drive } from "../motion";
import { readPalette } from "../palette";
import type { ReplayPayload } from "../payload";
import type { CameraMode, Drawing, DrawnLink, DrawnPose, Layers, Shown, View } from "../view";
import { makeCourse } from "./course";
import { extentOf, GroundHeights, type Extent } from "./ground";
import { fitLabels } from "./labels";
import { StepPicture } from "./maps";
import { EventMarks } from "./marks";
import { OverlayPicture } from "./overlays";
import { Paths } from "./paths";
import { Rocks } from "./rocks";
import { GhostRover, SolidRover } from "./rover";
import { ScanPoints } from "./scans";
import { Sight } from "./sight";
import { Sunlight } from "./sunlight";
import { makeSurroundings } from "./surroundings";
import { makeGrid, makeGround, makeWalls } from "./terrain";
import { rockTexture, soilTexture } from "./textures";
import { Tracks } from "./tracks";
import { worldKind } from "./world";

const SCANNING = "scan";

export class SceneView implements View {
  readonly modes = ["follow", "top", "orbit", "rover"] as const;
  private readonly renderer = new WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
  readonly element = this.renderer.domElement;
  private readonly scene = new Scene();
  private readonly world = worldKind(this.payload.world);
  private readonly sunlight = new Sunlight(this.payload.world);
  private readonly soil = soilTexture(this.sunlight.toward);
  private readonly extent = extentOf(this.payload.course);
  private readonly heights = new GroundHeights(this.payload.ground);
  private readonly rover = new SolidRover(this.payload.rover);
  private readonly ghost = new GhostRover(this.payload.rover);
  private readonly rocks = new Rocks(this.payload, rockTexture());
  private readonly paths = new Paths(this.drive, this.heights);
  private readonly tracks = new Tracks(this.drive, this.payload.rover, this.heights);
  private readonly scan = new ScanPoints(this.heights);
  private readonly sight = new Sight(this.payload, this.heights);
  private readonly step = new StepPicture(this.heights);
  private readonly overlays = new OverlayPicture(this.payload.overlays, this.heights);
  private readonly marks = new EventMarks(this.payload.events, this.heights);
  private readonly rig = new CameraRig(this.element, this.extent, this.rover.length());
  // Ground, walls, course and surroundings are made anew with the colours.
  private readonly fixed = new Group();
  private grid: Object3D = new Group();
  private sky: Object3D = new Group();
  private plain = false;
  private trueShapes = false;

  constructor(private readonly payload: ReplayPayload, private readonly drive: Drive, private readonly plan: Extent) {
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    // Shadows are drawn first; they count as well.
    this.renderer.info.autoReset = false;
    this.rig.setPlanExtent(plan);
    this.scene.add(this.fixed, this.sunlight.group, this.rocks.group, this.rover.body, this.ghost.body);
    for (const { group } of [this.paths, this.tracks, this.scan, this.sight, this.step, this.overlays, this.marks]) this.scene.add(group);
    this.recolour();
  }

  get mode(): CameraMode { return this.rig.mode; }

  setMode(mode: CameraMode): void {
    this.rig.setMode(mode);
    this.rig.update(this.rover.body);
    this.paths.onTop = this.marks.onTop = this.overlays.onTop = mode === "top";
  }

  approach(factor: number): void { this.rig.approach(factor); }

  turn(angle: number): void { this.rig.turn(angle); }

  onMoved(listener: () => void): void {
    this.rig.onMoved(listener);
  }

  show({ moment, scan, step, overlay }: Shown, layers: Layers): void {
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
    this.setPlain(layers.plain);
    this.trueShapes = layers.trueShapes;
    this.rocks.show(moment.t, layers);
    this.paths.show(moment, layers.wholePath, layers.believed);
    this.scan.show(layers.scan ? scan : null);
    this.sight.show(this.rover.body, moment.t, layers.light && moment.activity === SCANNING, layers.cameras);
    this.tracks.show(moment, layers.tracks);
    this.step.show(step, layers);
    this.overlays.show(overlay, layers);
    this.marks.show(moment.t, layers.marks);
    this.rig.update(this.rover.body);
  }

  recolour(): void {
    const palette = readPalette(this.world);
    const { course, ground } = this.payload;
    const soil = this.plain ? null : this.soil;
    const around = makeSurroundings(this.world, this.extent, this.heights, { toward: this.sunlight.toward, soil }, palette);
    this.scene.background = new Color(palette.sky);
    this.scene.fog = around.haze;
    this.sunlight.recolour(palette.sky, palette.ground);
    disposeOf(this.fixed);
    this.fixed.clear();
    this.grid = makeGrid(this.heights, this.extent, this.plan, palette);
    this.sky = around.sky;
    this.fixed.add(
      makeGround(ground, this.extent, soil, palette),
      makeWalls(course, this.heights, palette),
      makeCourse(this.payload, this.heights, palette),
      this.grid,
      around.fixed,
      around.sky,
    );
    const parts = [this.rover, this.ghost, this.rocks, this.paths, this.tracks, this.scan, this.sight, this.step, this.overlays, this.marks];
    for (const part of parts) part.recolour(palette);
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
    const { camera } = this.rig;
    const height = this.element.clientHeight;
    camera.updateMatrixWorld();
    this.sky.visible = this.mode !== "top";
    this.sky.position.setFromMatrixPosition(camera.matrixWorld);
    this.sunlight.fit(camera, this.rover.body.position);
    this.rocks.fit(camera, height, this.sunlight.lit);
    fitLabels(this.fixed, camera, height);
    this.renderer.info.reset();
    this.renderer.render(this.scene, camera);
  }

  /** Read back from what was placed in the scene. */
  drawn(): DrawnPose {
    const { position, quaternion } = this.rover.body;
    return { x: position.x, y: position.y, z: position.z, heading: headingOf(quaternion) };
  }

  drawnLinks(): DrawnLink[] { return this.rover.pivots(); }

  drawing(): Drawing {
    const { x, y, z } = this.sunlight.toward;
    const { triangles, calls } = this.renderer.info.render;
    return {
      world: this.world,
      sun: { x, y, z },
      triangles,
      calls,
      trueShapes: this.trueShapes,
      rockDepths: this.rocks.depths(),
      tracks: this.tracks.drawn(),
      planes: this.sight.drawnPlanes(),
      views: this.sight.drawnViews,
      overlay: this.overlays.drawn(),
      shadow: { toLight: this.sunlight.toLight().toArray(), texel: this.sunlight.texel_m },
    };
  }

  private setPlain(plain: boolean): void {
    if (plain === this.plain) return;
    this.plain = plain;
    this.sunlight.setPlain(plain);
    this.recolour();
  }
}

/** Frees what the graphics hold of meshes below `root`. */
function disposeOf(root: Object3D): void {
  root.traverse((object) => {
    if (object instanceof Mesh) object.geometry.dispose();
  });
}
