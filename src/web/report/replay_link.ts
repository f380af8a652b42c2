// Links from the data, which may be anybody's.

import { el } from "../shared/dom";
import type { Run } from "./payload";

/** The replay page of a trial; "" where there is none. Only places beside the page: nothing with a scheme of its own. */
export function replayLink(run: Run, trial: number): string {
  const link = run.replays?.[String(trial)];
  return link !== undefined && !/^[a-z][a-z0-9+.-]*:/i.test(link.trim()) && !link.startsWith("//") ? link : "";
}

/** The link as an element that tells by its name which trial it is of; null where there is no replay. */
export function replayAnchor(run: Run, trial: number, of: string): HTMLElement | null {
  const link = replayLink(run, trial);
  return link === "" ? null : el("a", { href: link }, "Replay", el("span", { class: "visually-hidden" }, ` of trial ${trial}${of}`));
}
