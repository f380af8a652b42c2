// The votes on splines as cells: one row a first knot, left above, one column a second knot.
import { svg } from "../../shared/dom";
import { fixed } from "../../shared/format";
import { rampCss } from "../palette";
import type { Splines } from "../payload";

const WIDTH = 340;
const TOP = 30;
const LEFT = 60;
const FULL_VOTE = 255;

export const SPLINE_CAPTION =
  "Rows: curvature in the middle of a spline, left turns above; columns: at its end, left turns at the left. Colour: merged vote from 0 to 255; crossed out: the steering motors could not follow; the chosen one is outlined.";

export function splineGrid(splines: Splines): SVGSVGElement {
  const rows = descending(splines.first);
  const chosen = splines.chosen;
  const says = chosen < 0 ? "none of these was chosen" : `chosen: ${curvatures(splines, chosen)}`;
  const most = Math.max(1, ...rows.map((row) => splines.first.filter((first) => first === row).length));
  const cell = Math.min(26, (WIDTH - LEFT) / most);
  const height = TOP + rows.length * cell + 4;
  const drawing = svg("svg", { viewBox: `0 0 ${WIDTH} ${height}`, role: "img", class: "splines", "aria-label": `Splines; ${says}` });
  drawing.append(svg("text", { x: 0, y: 10, class: "title" }, `Splines of ${fixed(splines.length[0] ?? 0, 1)} m: ${says}`));
  drawing.append(svg("text", { x: LEFT, y: TOP - 5 }, "left"), svg("text", { x: LEFT + most * cell, y: TOP - 5, "text-anchor": "end" }, "right at the end"));
  rows.forEach((row, r) => {
    const members = splines.first.map((_, i) => i).filter((i) => splines.first[i] === row);
    members.sort((a, b) => splines.second[b]! - splines.second[a]!);
    const y = TOP + r * cell;
    drawing.append(svg("text", { x: LEFT - 4, y: y + 0.5 * cell + 4, "text-anchor": "end" }, fixed(row, 2)));
    members.forEach((i, c) => drawing.append(cellOf(splines, i, LEFT + c * cell, y, cell)));
  });
  return drawing;
}

const descending = (values: number[]): number[] => [...new Set(values)].sort((a, b) => b - a);

function cellOf(splines: Splines, i: number, x: number, y: number, size: number): SVGGElement {
  const feasible = splines.feasible[i]!;
  const inner = size - 2;
  const group = svg("g", { class: `vote${i === splines.chosen ? " chosen" : ""}${feasible ? "" : " infeasible"}` }, svg("title", {}, numbers(splines, i)));
  const style = feasible ? `fill: ${rampCss(splines.merged[i]! / FULL_VOTE)}` : "fill: none";
  group.append(svg("rect", { x: x + 1, y: y + 1, width: inner, height: inner, style }));
  if (!feasible) group.append(svg("path", { d: `M${x + 1} ${y + 1}l${inner} ${inner}m0 ${-inner}l${-inner} ${inner}`, class: "rule" }));
  return group;
}

const side = (curvature: number): string =>
  curvature === 0 ? "straight" : `${curvature > 0 ? "left" : "right"} ${fixed(Math.abs(curvature), 2)}/m`;

const curvatures = ({ start, first, second }: Splines, i: number): string =>
  `from ${side(start[i]!)} over ${side(first[i]!)} to ${side(second[i]!)}`;

function numbers(splines: Splines, i: number): string {
  const { merged, hazard, certainty, waypoint, feasible } = splines;
  return (
    `${curvatures(splines, i)}: merged ${fixed(merged[i]!, 0)}, hazard ${fixed(hazard[i]!, 0)} ` +
    `(certainty ${fixed(certainty[i]!, 0)}), waypoint ${fixed(waypoint[i]!, 0)}${feasible[i] ? "" : "; the steering motors could not follow"}`
  );
}
