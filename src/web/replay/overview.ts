// Plays the overview over the picture: captions, a nearer camera as it goes on, and a way out.

import { button, el } from "../shared/dom";
import type { Player } from "./player";
import { type Beat, OVERVIEW_S, OverviewClock } from "./story";

// The camera begins so much further away than it follows the rover afterwards.
const FURTHER = 2.2;

type Ended = "whole" | "left" | "skipped";

export class Overview {
  /** Lies over the picture. */
  readonly element = el("div", { class: "overview", hidden: true });
  private readonly caption = el("p", { class: "caption-now", "aria-live": "polite" });
  private clock: OverviewClock | null = null;
  private seconds = 0;
  private distance = 1;
  private ended: (how: Ended) => void = () => undefined;

  constructor(
    private readonly player: Player,
    /** Brings the camera nearer by a factor. */
    private readonly approach: (factor: number) => void,
    private readonly beats: Beat[],
  ) {
    this.element.append(this.caption, button("Skip the overview", "To the start of the drive (Escape)", () => this.stop("skipped")));
    // Any other input goes where it was meant to, and ends the overview first.
    for (const kind of ["pointerdown", "wheel", "keydown"]) {
      document.addEventListener(kind, (event) => this.interrupt(event), { capture: true, passive: true });
    }
  }

  get running(): boolean { return this.clock !== null; }

  /** What is said now; "" where nothing runs. */
  get said(): string { return this.running ? (this.caption.textContent ?? "") : ""; }

  /** Viewer's time since it began, s. */
  get elapsed(): number { return this.seconds; }

  start(ended: (how: Ended) => void = () => undefined): void {
    this.player.pause();
    this.ended = ended;
    this.clock = new OverviewClock(this.beats, (t) => this.player.shareOf(t));
    this.seconds = 0;
    this.distance = 1;
    this.stepBack(FURTHER);
    this.element.hidden = false;
    this.show();
  }

  advance(seconds: number): void {
    if (!this.running) return;
    this.seconds += seconds;
    if (this.seconds >= OVERVIEW_S) this.stop("whole");
    else this.show();
  }

  stop(how: Ended): void {
    if (!this.running) return;
    this.clock = null;
    this.element.hidden = true;
    this.stepBack(1);
    if (how === "whole") this.player.seek(this.player.end);
    if (how === "skipped") this.player.seek(this.player.start);
    this.ended(how);
  }

  private show(): void {
    const { share, caption } = this.clock!.at(this.seconds);
    if (this.caption.textContent !== caption) this.caption.textContent = caption;
    this.stepBack(FURTHER + (1 - FURTHER) * (this.seconds / OVERVIEW_S));
    this.player.seek(this.player.timeOf(share));
  }

  private stepBack(distance: number): void {
    this.approach(this.distance / distance);
    this.distance = distance;
  }

  private interrupt(event: Event): void {
    // Its own button says what it does; those that save record it.
    if (!this.running || (event.target instanceof Element && event.target.closest(".overview, .share"))) return;
    this.stop(event instanceof KeyboardEvent && event.key === "Escape" ? "skipped" : "left");
  }
}
