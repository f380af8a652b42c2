// What tests and the console of the browser can ask of the page.
import type { Moment } from "./motion";
import type { CameraMode, Drawing, DrawnLink, DrawnPose } from "./view";

/** What is shown, and the player; nothing of the trial can be changed. */
export interface Handle {
  readonly duration: number;
  readonly time: number;
  readonly playing: boolean;
  readonly mode: CameraMode;
  /** How many pictures the page has drawn by itself, frame by frame. */
  readonly frames: number;
  /** Whether the overview runs. */
  readonly overview: boolean;
  seek(t: number): void;
  play(): void;
  playOverview(): void;
  /** As drawn now. */
  pose(): DrawnPose;
  /** The links' pivots as drawn now. */
  links(): DrawnLink[];
  /** What else is drawn now; null where the picture is a plan. */
  drawing(): Drawing | null;
  /** The moment of sample i. */
  sample(i: number): Moment;
}
