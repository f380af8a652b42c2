// What of the page can be handed on: the picture as PNG, the overview as a film. Both are made here, from
// what is drawn; nothing leaves the page but by the browser's own saving of files.
import { clock } from "./format";
import type { ReplayPayload } from "./payload";

// Of the picture's height.
const BAND = 0.075;
const TEXT = 0.5;
const FRAMES_PER_S = 30;
const BITS_PER_S = 6_000_000;
const FILM_TYPES = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm"];

/** "nominal-seed1-trial3-12m04s.png": of the letters that every file system takes. */
export function fileName({ scenario, seed, trial }: ReplayPayload, time: number, ending: string): string {
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
export class Sheet {
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

  png(): Promise<Blob | null> {
    return new Promise((done) => this.canvas.toBlob(done, "image/png"));
  }
}

/** Of what this browser can record; null where it can record none. */
export function filmType(): string | null {
  if (typeof MediaRecorder === "undefined" || !("captureStream" in HTMLCanvasElement.prototype)) return null;
  return FILM_TYPES.find((type) => MediaRecorder.isTypeSupported(type)) ?? null;
}

/** Records a sheet from now until it is finished or given up. */
export class Film {
  private readonly recorder: MediaRecorder;
  private readonly parts: Blob[] = [];

  constructor(
    readonly sheet: Sheet,
    private readonly type: string,
  ) {
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
