// The votes of the decision that is shown, arc by arc or spline by spline.

import { el, svg } from "../../shared/dom";
import { fixed } from "../../shared/format";
import { clock } from "../format";
import { rampCss } from "../palette";
import type { Splines, Step, Vote } from "../payload";

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

const side = (curvature: number): string =>
  curvature === 0 ? "straight" : `${curvature > 0 ? "left" : "right"} ${fixed(Math.abs(curvature), 2)}/m`;

const describe = ({ kind, curvature }: Vote): string => (kind === "turn" ? `turn ${curvature > 0 ? "left" : "right"}` : side(curvature));

const scores = (merged: number, hazard: number, certainty: number, waypoint: number): string =>
  `merged ${fixed(merged, 0)}, hazard ${fixed(hazard, 0)} (certainty ${fixed(certainty, 0)}), waypoint ${fixed(waypoint, 0)}`;

const numbers = (vote: Vote): string => `${describe(vote)}: ${scores(vote.merged, vote.hazard, vote.certainty, vote.waypoint)}`;

// ---- The votes on splines as cells: one row a first knot, left above, one column a second knot.

const GRID_TOP = 30;
const GRID_LEFT = 60;

const SPLINE_CAPTION =
  "Rows: curvature in the middle of a spline, left turns above; columns: at its end, left turns at the left. Colour: merged vote from 0 to 255; crossed out: the steering motors could not follow; the chosen one is outlined.";

function splineGrid(splines: Splines): SVGSVGElement {
  const rows = descending(splines.first);
  const chosen = splines.chosen;
  const says = chosen < 0 ? "none of these was chosen" : `chosen: ${curvatures(splines, chosen)}`;
  const most = Math.max(1, ...rows.map((row) => splines.first.filter((first) => first === row).length));
  const cell = Math.min(26, (WIDTH - GRID_LEFT) / most);
  const height = GRID_TOP + rows.length * cell + 4;
  const drawing = svg("svg", { viewBox: `0 0 ${WIDTH} ${height}`, role: "img", class: "splines", "aria-label": `Splines; ${says}` });
  drawing.append(svg("text", { x: 0, y: 10, class: "title" }, `Splines of ${fixed(splines.length[0] ?? 0, 1)} m: ${says}`));
  drawing.append(svg("text", { x: GRID_LEFT, y: GRID_TOP - 5 }, "left"),
    svg("text", { x: GRID_LEFT + most * cell, y: GRID_TOP - 5, "text-anchor": "end" }, "right at the end"));
  rows.forEach((row, r) => {
    const members = splines.first.map((_, i) => i).filter((i) => splines.first[i] === row);
    members.sort((a, b) => splines.second[b]! - splines.second[a]!);
    const y = GRID_TOP + r * cell;
    drawing.append(svg("text", { x: GRID_LEFT - 4, y: y + 0.5 * cell + 4, "text-anchor": "end" }, fixed(row, 2)));
    members.forEach((i, c) => drawing.append(cellOf(splines, i, GRID_LEFT + c * cell, y, cell)));
  });
  return drawing;
}

const descending = (values: number[]): number[] => [...new Set(values)].sort((a, b) => b - a);

function cellOf(splines: Splines, i: number, x: number, y: number, size: number): SVGGElement {
  const feasible = splines.feasible[i]!;
  const inner = size - 2;
  const group = svg("g", { class: `vote${i === splines.chosen ? " chosen" : ""}${feasible ? "" : " infeasible"}` }, svg("title", {}, splineNumbers(splines, i)));
  const style = feasible ? `fill: ${rampCss(splines.merged[i]! / FULL_VOTE)}` : "fill: none";
  group.append(svg("rect", { x: x + 1, y: y + 1, width: inner, height: inner, style }));
  if (!feasible) group.append(svg("path", { d: `M${x + 1} ${y + 1}l${inner} ${inner}m0 ${-inner}l${-inner} ${inner}`, class: "rule" }));
  return group;
}

const curvatures = ({ start, first, second }: Splines, i: number): string =>
  `from ${side(start[i]!)} over ${side(first[i]!)} to ${side(second[i]!)}`;

function splineNumbers(splines: Splines, i: number): string {
  const { merged, hazard, certainty, waypoint, feasible } = splines;
  const told = `${curvatures(splines, i)}: ${scores(merged[i]!, hazard[i]!, certainty[i]!, waypoint[i]!)}`;
  return feasible[i] ? told : `${told}; the steering motors could not follow`;
}
