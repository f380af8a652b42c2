// Where the viewer stands, as buttons over the picture.

import { button, el } from "../../shared/dom";
import type { CameraMode } from "../view";

const MODE_NAMES: Record<CameraMode, string> = { follow: "Follow", top: "Top", orbit: "Free", rover: "From the rover" };

export class CameraBar {
  readonly element = el("div", { class: "cameras", role: "group", "aria-label": "Camera" });
  private readonly buttons = new Map<CameraMode, HTMLButtonElement>();

  constructor(modes: readonly CameraMode[], actions: { mode(mode: CameraMode): void; overview(): void; planOfPaths(): void }) {
    for (const mode of modes) {
      const item = button(MODE_NAMES[mode], `Camera: ${MODE_NAMES[mode]}`, () => actions.mode(mode));
      this.buttons.set(mode, item);
      this.element.append(item);
    }
    const plan = "From above with the whole paths, as figure 16 of Matthies 1995 shows a drive (6)";
    this.element.append(
      button("Overview", "The whole drive in ten seconds (v)", actions.overview),
      button("Plan of the paths", plan, actions.planOfPaths),
    );
  }

  show(mode: CameraMode): void {
    for (const [name, item] of this.buttons) item.setAttribute("aria-pressed", String(name === mode));
  }
}
