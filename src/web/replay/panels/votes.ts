// The votes of the decision that is shown, arc by arc or spline by spline.
import { el, svg } from "../../shared/dom";
import { fixed } from "../../shared/format";
import { clock } from "../format";
import { rampCss } from "../palette";
import type { Step, Vote } from "../payload";
import { SPLINE_CAPTION, splineGrid } from "./spline_grid";

const WIDTH = 340;
const HEIGHT = 84;
const LEFT = 28;
const BASE = HEIGHT - 22;
const FULL_VOTE = 255;

const ROWS = [
  { kind: "forward", title: "Forward arcs" },
  { kind: "backward", title: "Backward arcs" },
  { kind: "turn", title: "Turns in place" },
] as const;

const ARC_CAPTION =
  "Left arcs stand left, as the rover sees them. Bars: merged vote from 0 to 255; circle: safety (hazard vote), cross: waypoint vote; the chosen one is outlined.";

export class VotesPanel {
  readonly element = el("section", { class: "panel votes", "aria-label": "Votes" });
  private readonly body = el("div", {});
  private readonly caption = el("p", { class: "caption" });
  private readonly meaning = el("p", { class: "caption" }, ARC_CAPTION);
  private shown: Step | null | undefined;

  constructor() {
    this.element.append(el("h2", {}, "Votes"), this.caption, this.body);
    this.element.append(this.meaning);
  }

  show(step: Step | null): void {
    if (step === this.shown) return;
    this.shown = step;
    this.body.replaceChildren();
    this.caption.textContent = step ? captionOf(step) : "No decision yet.";
    this.meaning.textContent = step?.splines ? SPLINE_CAPTION : ARC_CAPTION;
    if (step?.splines) this.body.append(splineGrid(step.splines));
    for (const { kind, title } of ROWS) {
      const votes = (step?.votes ?? []).filter((vote) => vote.kind === kind);
      if (votes.length > 0) this.body.append(chart(title, votes));
    }
  }
}

/** With the latency of what it was decided by. */
const captionOf = ({ step, t, look, behind }: Step): string =>
  `Decision ${step} at ${clock(t)}, ${fixed(t - look.t, 2)} s after the look ${behind ? "behind" : "ahead"} that it goes by.`;

function chart(title: string, votes: Vote[]): SVGSVGElement {
  const sorted = [...votes].sort((a, b) => b.curvature - a.curvature);
  const chosen = sorted.find((vote) => vote.chosen);
  const says = chosen ? `; chosen: ${describe(chosen)}` : "; none of these was chosen";
  const drawing = svg("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "img", "aria-label": `${title}${says}` });
  const slot = Math.min(40, (WIDTH - LEFT - 4) / sorted.length);
  const y = (vote: number): number => BASE - (vote / FULL_VOTE) * (BASE - 16);
  drawing.append(svg("text", { x: 0, y: 10, class: "title" }, `${title}${chosen ? `: ${describe(chosen)}` : ""}`));
  for (const value of [0, 128, 255]) {
    drawing.append(svg("line", { class: "rule", x1: LEFT, x2: WIDTH, y1: y(value), y2: y(value) }));
    drawing.append(svg("text", { x: LEFT - 4, y: y(value) + 4, "text-anchor": "end" }, `${value}`));
  }
  sorted.forEach((vote, i) => drawing.append(bar(vote, LEFT + (i + 0.5) * slot, slot, y)));
  const last = LEFT + (sorted.length - 0.5) * slot;
  const end = (x: number, text: string, anchor: string): SVGTextElement =>
    svg("text", { x, y: HEIGHT - 8, "text-anchor": anchor }, text);
  const turn = votes[0]!.kind === "turn";
  drawing.append(end(LEFT, turn ? "left" : `left ${fixed(sorted[0]!.curvature, 1)}/m`, "start"));
  drawing.append(end(last + slot / 2, turn ? "right" : `right ${fixed(-sorted[sorted.length - 1]!.curvature, 1)}/m`, "end"));
  return drawing;
}

function bar(vote: Vote, x: number, slot: number, y: (vote: number) => number): SVGGElement {
  const width = Math.max(2, 0.7 * slot);
  const top = y(vote.merged);
  const group = svg("g", { class: vote.chosen ? "vote chosen" : "vote" }, svg("title", {}, numbers(vote)));
  group.append(
    svg("rect", { x: x - width / 2, y: top, width, height: Math.max(1, BASE - top), style: `fill: ${rampCss(vote.merged / FULL_VOTE)}` }),
  );
  const cross = y(vote.waypoint);
  group.append(svg("circle", { cx: x, cy: y(vote.hazard), r: 2.2, class: "hazard" }));
  group.append(svg("path", { d: `M${x - 2.5} ${cross - 2.5}l5 5m0-5l-5 5`, class: "waypoint" }));
  return group;
}

function describe(vote: Vote): string {
  const side = vote.curvature > 0 ? "left" : "right";
  if (vote.kind === "turn") return `turn ${side}`;
  return vote.curvature === 0 ? "straight" : `${side} ${fixed(Math.abs(vote.curvature), 2)}/m`;
}

const numbers = (vote: Vote): string =>
  `${describe(vote)}: merged ${fixed(vote.merged, 0)}, hazard ${fixed(vote.hazard, 0)} ` +
  `(certainty ${fixed(vote.certainty, 0)}), waypoint ${fixed(vote.waypoint, 0)}`;
