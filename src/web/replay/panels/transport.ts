// Play, pause, speed and scrubbing.

import { button, checkbox, el, labelled, select } from "../../shared/dom";
import { clock } from "../format";
import { neighbour, type Player, SPEEDS, STANDING_S } from "../player";

const SLIDER_STEPS = 10_000;
const EVENT_GAP_S = 0.05;

export class Transport {
  readonly element = el("div", { class: "transport", role: "group", "aria-label": "Player" });
  private readonly slider = el("input", {
    type: "range", min: 0, max: SLIDER_STEPS, step: 1, value: 0, class: "scrub", "aria-label": "Time",
  });
  private readonly time = el("output", { class: "time" });
  private readonly speed = select(SPEEDS.map((speed) => [`${speed}`, `${speed}×`]));
  private readonly skip: HTMLInputElement;
  private readonly playButton = button("Play", "Play or pause (space)", () => this.player.toggle(), { class: "play" });

  constructor(private readonly player: Player, private readonly eventTimes: () => number[]) {
    const skip = checkbox(`Standing takes ${STANDING_S} s`, player.skipStanding, (on) => (player.skipStanding = on),
      `Where nothing moves for longer (scans, computing), it is played as if it were ${STANDING_S} s of the drive (s)`);
    this.skip = skip.querySelector("input")!;
    this.slider.addEventListener("input", () => player.seek(player.timeOf(Number(this.slider.value) / SLIDER_STEPS)));
    this.speed.addEventListener("change", () => player.setSpeed(Number(this.speed.value)));
    this.element.append(
      el("div", { class: "buttons" },
        button("Start", "To the start (Home)", () => player.seek(player.start)),
        button("◀ event", "Previous event (p)", () => this.step(-1)),
        this.playButton,
        button("event ▶", "Next event (n)", () => this.step(1)),
        button("End", "To the end (End)", () => player.seek(player.end)),
        labelled("Speed", this.speed),
        skip,
        this.time),
      this.slider,
    );
    player.onChange(() => this.show());
    this.show();
  }

  /** To the next (+1) or previous (-1) event whose kind is shown. */
  step(by: 1 | -1): void {
    const t = neighbour(this.eventTimes(), this.player.time, by, EVENT_GAP_S);
    this.player.pause();
    this.player.seek(t ?? (by > 0 ? this.player.end : this.player.start));
  }

  private show(): void {
    const { player } = this;
    this.playButton.textContent = player.playing ? "❚❚ Pause" : "▶ Play";
    this.slider.value = String(Math.round(player.shareOf(player.time) * SLIDER_STEPS));
    this.slider.setAttribute("aria-valuetext", `${clock(player.time)} of ${clock(player.end)}`);
    this.speed.value = String(player.speed);
    this.skip.checked = player.skipStanding;
    this.time.textContent = `${clock(player.time)} of ${clock(player.end)}`;
  }
}
