// What the rover did, as a band along the time line: each activity has a colour and a height.
import { el, svg } from "../../shared/dom";
import type { Run } from "../events";
import { clock } from "../format";
import { bandOf } from "./marks";

/** The key of the band. */
export function activityKey(runs: Run[]): HTMLElement {
  const key = el("p", { class: "activity-key" }, "Activity: ");
  for (const name of new Set(runs.map((run) => run.activity))) {
    const { colour, height } = bandOf(name);
    const band = svg("rect", { x: 0, y: 16 - height, width: 12, height, style: `fill: var(${colour})` });
    key.append(el("span", {}, svg("svg", { viewBox: "0 0 12 16", width: 12, height: 16, "aria-hidden": "true" }, band), name));
  }
  return key;
}

/** The band itself: it stands on `bottom`; `place` is where a time is drawn. */
export function activityBand(runs: Run[], place: (t: number) => number, bottom: number): SVGRectElement[] {
  return runs.map(({ from, to, activity }) => {
    const { colour, height } = bandOf(activity);
    const x = place(from);
    return svg(
      "rect",
      { x, y: bottom - height, width: Math.max(0.75, place(to) - x), height, style: `fill: var(${colour})` },
      svg("title", {}, `${activity}, ${clock(from)} to ${clock(to)}`),
    );
  });
}
