// What any picture of the trial can do: the scene in three dimensions, and the plan where WebGL is
// missing.
import type { Moment, Quaternion } from "./motion";
import type { Scan, Step } from "./payload";

export type CameraMode = "follow" | "top" | "orbit" | "rover";
export type MapKind = "goodness" | "certainty" | "elevation" | "off";

export interface Layers {
  believed: boolean;
  wholePath: boolean;
  scan: boolean;
  map: MapKind;
  /** Whether map and votes lie where the rover truly is instead of where it believes to be. */
  mapAtTruth: boolean;
  votes: boolean;
  /** Of hazards, scrapes and stalls so far. */
  marks: boolean;
  grid: boolean;
}

/** All that a picture shows of one moment. */
export interface Shown {
  moment: Moment;
  scan: Scan | null;
  step: Step | null;
}

/** The pose that is drawn. */
export interface DrawnPose {
  x: number;
  y: number;
  z: number;
  heading: number;
}

/** Where the pivot of a link is drawn, in W, and how the link is turned. */
export interface DrawnLink {
  name: string;
  x: number;
  y: number;
  z: number;
  attitude: Quaternion;
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
}
