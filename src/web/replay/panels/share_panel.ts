// Buttons that save the picture or a film of the overview.

import { button, el } from "../../shared/dom";
import { causeWords } from "../../shared/outcomes";
import { clock } from "../format";
import type { Overview } from "../overview";
import type { ReplayPayload } from "../payload";
import type { Player } from "../player";
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

// ---- What of the page can be handed on: the picture as PNG, the overview as a film. Both are made here, from
// what is drawn; nothing leaves the page but by the browser's own saving of files.

// Of the picture's height.
const BAND = 0.075;
const TEXT = 0.5;
const FRAMES_PER_S = 30;
const BITS_PER_S = 6_000_000;
const FILM_TYPES = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm"];

/** "nominal-seed1-trial3-12m04s.png": of the letters that every file system takes. */
function fileName({ scenario, seed, trial }: ReplayPayload, time: number, ending: string): string {
  const at = clock(time).replace(/\..*$/, "").replaceAll(":", "-");
  return `${scenario}-seed${seed}-trial${trial}-${at}.${ending}`.replace(/[^\w.+-]+/g, "_");
}

export function save(blob: Blob, name: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  // Once the browser has taken it.
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

/** The picture with a band of text below it, on a canvas of its own. */
class Sheet {
  readonly canvas = document.createElement("canvas");
  private readonly context = this.canvas.getContext("2d")!;

  constructor(private readonly picture: HTMLCanvasElement) {
    const band = Math.round(picture.height * BAND);
    // Encoders of films want even sizes.
    this.canvas.width = picture.width - (picture.width % 2);
    this.canvas.height = picture.height + band + ((picture.height + band) % 2);
  }

  draw(left: string, right: string): void {
    const { context, canvas, picture } = this;
    const band = canvas.height - picture.height;
    context.fillStyle = "#14181c";
    context.fillRect(0, 0, canvas.width, canvas.height);
    context.drawImage(picture, 0, 0);
    context.fillStyle = "#e7eaec";
    context.font = `${Math.round(TEXT * band)}px system-ui, sans-serif`;
    context.textBaseline = "middle";
    const margin = band / 3;
    const width = context.measureText(right).width;
    context.fillText(left, margin, canvas.height - band / 2, canvas.width - width - 3 * margin);
    context.fillText(right, canvas.width - width - margin, canvas.height - band / 2);
  }

  png(): Promise<Blob | null> { return new Promise((done) => this.canvas.toBlob(done, "image/png")); }
}

/** Of what this browser can record; null where it can record none. */
function filmType(): string | null {
  if (typeof MediaRecorder === "undefined" || !("captureStream" in HTMLCanvasElement.prototype)) return null;
  return FILM_TYPES.find((type) => MediaRecorder.isTypeSupported(type)) ?? null;
}

/** Records a sheet from now until it is finished or given up. */
class Film {
  private readonly recorder: MediaRecorder;
  private readonly parts: Blob[] = [];

  constructor(readonly sheet: Sheet, private readonly type: string) {
    const stream = sheet.canvas.captureStream(FRAMES_PER_S);
    this.recorder = new MediaRecorder(stream, { mimeType: type, videoBitsPerSecond: BITS_PER_S });
    this.recorder.addEventListener("dataavailable", ({ data }) => this.parts.push(data));
    this.recorder.start();
  }

  finish(): Promise<Blob> {
    return new Promise((done) => {
      this.recorder.addEventListener("stop", () => done(new Blob(this.parts, { type: this.type.split(";")[0]! })));
      this.stop();
    });
  }

  stop(): void {
    this.recorder.stop();
    for (const track of this.recorder.stream.getTracks()) track.stop();
  }
}
