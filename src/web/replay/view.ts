// What any picture of the trial can do: the scene in three dimensions, and the plan where WebGL is
// missing.
import type { Moment, Quaternion } from "./motion";
import type { Overlay, Scan, Step } from "./payload";
import type { WorldKind } from "./scene/world";

export type CameraMode = "follow" | "top" | "orbit" | "rover";
export type MapKind = "goodness" | "certainty" | "elevation" | "off";

export interface Layers {
  believed: boolean; wholePath: boolean; scan: boolean;
  map: MapKind;
  /** Whether map, votes and what the navigator shows lie where the rover truly is instead of where it believes to be. */
  mapAtTruth: boolean;
  votes: boolean;
  /** What the navigator shows; and which of its grids, by name; null for none. */
  overlay: boolean; overlayGrid: string | null;
  /** Of hazards, scrapes and stalls so far. */
  marks: boolean;
  grid: boolean; tracks: boolean;
  /** Light planes while a scan runs. */
  light: boolean;
  /** What the cameras of the terrain sensor see. */
  cameras: boolean;
  /** Rocks as the simulator has them, not roughened. */
  trueShapes: boolean;
  /** Without textures and with coarser shadows: for slow machines. */
  plain: boolean;
}

/** All that a picture shows of one moment. */
export interface Shown { moment: Moment; scan: Scan | null; step: Step | null; overlay: Overlay | null }

/** The pose that is drawn. */
export interface DrawnPose { x: number; y: number; z: number; heading: number }

/** Where the pivot of a link is drawn, in W, and how the link is turned. */
export interface DrawnLink { name: string; x: number; y: number; z: number; attitude: Quaternion }

interface Place { x: number; y: number; z: number }

export interface DrawnPlane { emitter: Place; ends: Place[] }

/** What else is drawn in three dimensions, as it is drawn now. */
export interface Drawing {
  world: WorldKind;
  /** Unit vector towards the sun. */
  sun: Place;
  /** Of the last picture, its shadows included. */
  triangles: number;
  calls: number;
  trueShapes: boolean;
  /** Of all corners of drawn rocks, how far within the true surface the deepest one lies, and how far outside the outermost one, as shares of the distance from the rock's centre. */
  rockDepths: { deepest: number; outermost: number };
  /** Middles of the wheels' prints. */
  tracks: { x: number; y: number; width: number }[];
  planes: DrawnPlane[];
  /** How many cameras' views. */
  views: number;
  /** What the navigator shows: its lines, as long as they are drawn, and the names of its grids. */
  overlay: { lines: { name: string; points: Place[] }[]; grids: string[] };
  /** From W to the picture of the shadows, -1 to 1 within it, column by column; and the length of one of its pixels, m. */
  shadow: { toLight: number[]; texel: number };
}

export interface View {
  readonly element: HTMLElement;
  /** The modes that this picture has. */
  readonly modes: readonly CameraMode[];
  mode: CameraMode;
  setMode(mode: CameraMode): void;
  /** As CameraRig says; nothing where the picture has one camera only. */
  approach(factor: number): void;
  turn(angle: number): void;
  /** Called when somebody turns or moves the picture by hand. */
  onMoved(listener: () => void): void;
  show(shown: Shown, layers: Layers): void;
  /** Reads the colours of the page again. */
  recolour(): void;
  resize(): void;
  draw(): void;
  drawn(): DrawnPose;
  /** None where the picture has no links. */
  drawnLinks(): DrawnLink[];
  /** Null where the picture has two dimensions. */
  drawing(): Drawing | null;
}
