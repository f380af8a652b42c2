// What the rover saw: the last look of its stereo cameras.
import { el } from "../../shared/dom";
import { clock } from "../format";
import { lastAtOrBefore } from "../motion";
import type { Eyes, StereoLook } from "../payload";

const ends = (look: StereoLook): string => (look.behind ? "rear" : "front");

function picture(name: string): { figure: HTMLElement; image: HTMLImageElement; caption: HTMLElement } {
  const image = el("img", { alt: "", class: name });
  const caption = el("figcaption", {});
  return { figure: el("figure", {}, image, caption), image, caption };
}

export class EyesPanel {
  readonly element = el("section", { class: "panel eyes", "aria-label": "What the rover saw" });
  private readonly caption = el("p", { class: "caption" });
  private readonly left = picture("left");
  private readonly disparity = picture("disparity");
  private readonly pictures = el("div", { class: "pictures" }, this.left.figure, this.disparity.figure);
  private shown: StereoLook | null | undefined;
  private readonly times = this.eyes.looks.map((look) => look.t);

  constructor(private readonly eyes: Eyes) {
    this.element.append(el("h2", {}, "What the rover saw"), this.caption, this.pictures);
    if (eyes.every > 1) {
      this.element.append(el("p", { class: "caption" }, `To keep the page small, it has one look out of ${eyes.every}.`));
    }
    this.left.caption.textContent = "Left image";
  }

  /** The last look at or before `t`. */
  show(t: number): void {
    const look = this.eyes.looks[lastAtOrBefore(this.times, t)] ?? null;
    if (look === this.shown) return;
    this.shown = look;
    this.pictures.hidden = look === null;
    this.caption.textContent = look
      ? `Look ${look.number} of the ${ends(look)} cameras at ${clock(look.t)}: ${look.points} points.`
      : "No look yet.";
    if (look) this.fill(look);
  }

  private fill(look: StereoLook): void {
    this.left.image.src = `data:image/png;base64,${look.left}`;
    this.left.image.alt = `Left image of the ${ends(look)} cameras at ${clock(look.t)}, as it was matched`;
    this.disparity.image.src = `data:image/png;base64,${look.disparity}`;
    this.disparity.image.alt = `Disparities of that image in colours; ${look.points} points came of it`;
    this.disparity.caption.textContent = `Disparity: violet ${look.least} px, far, to yellow ${look.most} px, near; black: none`;
  }
}
