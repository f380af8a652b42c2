// How one outcome is told from another on a map: colour, mark and dash together, never colour alone.

import { svg } from "../shared/dom";

interface OutcomeStyle {
  colour: string;
  /** The mark as steps from its middle. */
  mark: string;
  dash: string;
  hollow?: boolean;
}

const CIRCLE = "m-3.4,0a3.4,3.4 0 1,0 6.8,0a3.4,3.4 0 1,0 -6.8,0z";
const DIAMOND = "m0,-4.4l3.6,4.4l-3.6,4.4l-3.6,-4.4z";
const TRIANGLE = "m0,-4.6l4.3,7.6h-8.6z";
const SQUARE = "m-3.4,-3.4h6.8v6.8h-6.8z";
const BAR = "m-2,-4.4h4v8.8h-4z";
const CROSS = "m-3.4,-3.4l6.8,6.8m0,-6.8l-6.8,6.8";
const PLUS = "m0,-4.4v8.8m-4.4,-4.4h8.8";

const STYLES: Record<string, OutcomeStyle> = {
  goal_reached: { colour: "var(--series-3)", mark: CIRCLE, dash: "none" },
  false_goal: { colour: "var(--series-5)", mark: DIAMOND, dash: "7 3" },
  no_path: { colour: "var(--series-2)", mark: TRIANGLE, dash: "none" },
  high_centred: { colour: "var(--series-1)", mark: SQUARE, dash: "none" },
  jammed: { colour: "var(--series-4)", mark: BAR, dash: "2 2" },
  tip_over: { colour: "var(--bad)", mark: CROSS, dash: "none", hollow: true },
  energy_depleted: { colour: "var(--muted)", mark: DIAMOND, dash: "2 3" },
  time_limit: { colour: "var(--muted)", mark: SQUARE, dash: "5 2" },
  left_arena: { colour: "var(--muted)", mark: CROSS, dash: "none", hollow: true },
};
const OTHER: OutcomeStyle = { colour: "var(--text)", mark: PLUS, dash: "1 3", hollow: true };

const styleOf = (outcome: string) => STYLES[outcome] ?? OTHER;

/** All marks of an outcome as one element: thousands of them are drawn at once. Places in pixels. */
export function outcomeMarks(outcome: string, places: [number, number][]): SVGPathElement {
  const { colour, mark, hollow } = styleOf(outcome);
  return svg("path", {
    class: "map-marks",
    d: places.map(([x, y]) => `M${x.toFixed(1)},${y.toFixed(1)}${mark}`).join(""),
    fill: hollow ? "none" : colour,
    stroke: hollow ? colour : "var(--ground)",
    "stroke-width": hollow ? 1.8 : 0.8,
  });
}

/** All lines of an outcome as one element. */
export function outcomeLines(outcome: string, lines: [number, number][][], width = 1.4): SVGPathElement {
  const { colour, dash } = styleOf(outcome);
  return svg("path", {
    class: "map-lines",
    d: lines.map((line) => `M${line.map(([x, y]) => `${x.toFixed(1)},${y.toFixed(1)}`).join("L")}`).join(""),
    fill: "none",
    stroke: colour,
    "stroke-width": width,
    "stroke-linejoin": "round",
    "stroke-dasharray": dash === "none" ? null : dash,
  });
}

/** A piece of line with a mark, for a key. */
export function outcomeSwatch(outcome: string): SVGSVGElement {
  return svg("svg", { class: "swatch", width: 34, height: 14, viewBox: "0 0 34 14", "aria-hidden": "true" },
    outcomeLines(outcome, [[[1, 7], [33, 7]]], 2), outcomeMarks(outcome, [[17, 7]]));
}
