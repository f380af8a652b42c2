// Buttons that save the picture or a film of the overview.
import { causeWords } from "../../shared/causes";
import { el } from "../../shared/dom";
import { button } from "../controls";
import { clock } from "../format";
import type { Overview } from "../overview";
import type { ReplayPayload } from "../payload";
import type { Player } from "../player";
import { Film, fileName, filmType, save, Sheet } from "../share";
import { OVERVIEW_S } from "../story";

// How long the film stands at its end, s.
const LAST_S = 1.5;

export class SharePanel {
  readonly element = el("div", { class: "share", role: "group", "aria-label": "Save" });
  private readonly said = el("span", { class: "said", role: "status" });
  private readonly filmButton: HTMLButtonElement;
  private film: Film | null = null;
  private endsAt = 0;

  constructor(
    private readonly payload: ReplayPayload,
    private readonly player: Player,
    private readonly overview: Overview,
    private readonly picture: Element,
    private readonly redraw: () => void,
  ) {
    const png = button("Save picture", "The picture as a PNG file (i)", () => void this.savePicture());
    this.filmButton = button("Save film", "The overview as a film of ten seconds (WebM)", () => this.toggleFilm());
    if (!(picture instanceof HTMLCanvasElement)) {
      for (const item of [png, this.filmButton]) item.disabled = true;
      this.said.textContent = "Without WebGL there is no picture to save.";
    } else if (filmType() === null) {
      this.filmButton.disabled = true;
      this.filmButton.title = "This browser cannot record films.";
    }
    this.element.append(png, this.filmButton, this.said);
  }

  async savePicture(): Promise<void> {
    if (!(this.picture instanceof HTMLCanvasElement)) return;
    const sheet = new Sheet(this.picture);
    this.drawSheet(sheet);
    const blob = await sheet.png();
    const name = fileName(this.payload, this.player.time, "png");
    if (blob) save(blob, name);
    this.said.textContent = blob ? `Saved as ${name}.` : "The browser could not make the picture.";
  }

  /** Called after each picture that is drawn. */
  drawn(now: number): void {
    const { film } = this;
    if (!film) return;
    this.drawSheet(film.sheet);
    if (this.overview.running) {
      this.said.textContent = `Recording: ${Math.floor(this.overview.elapsed)} of ${OVERVIEW_S} s.`;
    } else if (this.endsAt === 0) {
      this.endsAt = now + LAST_S * 1000;
    } else if (now >= this.endsAt) {
      void this.finish(film);
      return;
    }
    this.redraw();
  }

  private drawSheet(sheet: Sheet): void {
    const { payload, player } = this;
    const ended = player.time >= player.end ? `It ${causeWords(payload.outcome, payload.detail)}.` : payload.title;
    sheet.draw(this.overview.said || ended, clock(player.time));
  }

  private toggleFilm(): void {
    if (this.film) return this.giveUp();
    this.film = new Film(new Sheet(this.picture as HTMLCanvasElement), filmType()!);
    this.endsAt = 0;
    this.filmButton.textContent = "Stop recording";
    this.overview.start((how) => {
      if (how !== "whole") this.giveUp();
    });
    this.redraw();
  }

  private giveUp(): void {
    if (!this.film) return;
    this.film.stop();
    this.film = null;
    this.overview.stop("left");
    this.filmButton.textContent = "Save film";
    this.said.textContent = "The recording was given up.";
  }

  private async finish(film: Film): Promise<void> {
    this.film = null;
    const blob = await film.finish();
    const name = fileName(this.payload, this.player.end, "webm");
    save(blob, name);
    this.filmButton.textContent = "Save film";
    this.said.textContent = `Saved as ${name}.`;
  }
}
