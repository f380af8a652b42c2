// What tests and the console of the browser can ask of the page.
import type { Course as Drive, Moment } from "./motion";
import type { Overview } from "./overview";
import type { Player } from "./player";
import type { CameraMode, Drawing, DrawnLink, DrawnPose, View } from "./view";

/** What is shown, and the player; nothing of the trial can be changed. */
export interface Handle {
  readonly duration: number; readonly time: number;
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

interface PageActions {
  frames(): number;
  /** Draws what is due now, of every picture. */
  update(): void;
  playOverview(): void;
}

export function makeHandle(player: Player, drive: Drive, view: View, overview: Overview, page: PageActions): Handle {
  const drawn = <T>(read: () => T): T => {
    page.update();
    return read();
  };
  // Like a key or a click: what is asked for ends the overview, which would go on elsewhere.
  const here = (act: () => void): void => {
    overview.stop("left");
    act();
  };
  return {
    get duration() { return player.end - player.start; },
    get time() { return player.time; },
    get playing() { return player.playing; },
    get mode() { return view.mode; },
    get frames() { return page.frames(); },
    get overview() { return overview.running; },
    seek: (t) => here(() => player.seek(t)),
    play: () => here(() => player.play()),
    playOverview: () => page.playOverview(),
    pose: () => drawn(() => view.drawn()),
    links: () => drawn(() => view.drawnLinks()),
    drawing: () => drawn(() => view.drawing()),
    sample: (i) => drive.at(drive.motion.t[i] ?? NaN),
  };
}
