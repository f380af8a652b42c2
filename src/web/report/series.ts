// How one series is told from another: colour, mark and dash together, never colour alone.

import { breakable, el, svg } from "../shared/dom";

interface SeriesStyle {
  colour: string;
  /** A symbol of Observable Plot. */
  symbol: "circle" | "square" | "triangle" | "diamond" | "star" | "times";
  dash: string;
}

const SYMBOLS = ["circle", "square", "triangle", "diamond", "star", "times"] as const;
const DASHES = ["none", "7 3", "2 3", "10 3 2 3", "5 2", "1 4"] as const;

export function seriesStyle(slot: number): SeriesStyle {
  const at = slot % SYMBOLS.length;
  return { colour: `var(--series-${at + 1})`, symbol: SYMBOLS[at]!, dash: DASHES[at]! };
}

// Outlines in a box from -5 to 5.
const OUTLINES: Record<SeriesStyle["symbol"], string> = {
  circle: "M4,0A4,4 0 1 1 -4,0A4,4 0 1 1 4,0Z",
  square: "M-3.5,-3.5H3.5V3.5H-3.5Z",
  triangle: "M0,-4.5L4.2,3.2H-4.2Z",
  diamond: "M0,-5L4,0L0,5L-4,0Z",
  star: "M0,-5L1.3,-1.6L4.8,-1.5L2,0.7L2.9,4.1L0,2.1L-2.9,4.1L-2,0.7L-4.8,-1.5L-1.3,-1.6Z",
  times: "M-4,-4L4,4M-4,4L4,-4",
};

/** A short piece of the series' line with its mark. */
export function swatch(slot: number, mark: "line" | "dot" = "line"): SVGSVGElement {
  const style = seriesStyle(slot);
  const drawing = svg("svg", { width: 34, height: 14, viewBox: "-17 -7 34 14", "aria-hidden": "true", class: "swatch" });
  const dash = style.dash === "none" ? null : style.dash;
  const line = { x1: -17, x2: 17, y1: 0, y2: 0, stroke: style.colour, "stroke-width": 2, "stroke-dasharray": dash };
  if (mark === "line") drawing.append(svg("line", line));
  if (mark === "dot") {
    const hollow = style.symbol === "times";
    drawing.append(
      svg("path", {
        d: OUTLINES[style.symbol],
        fill: hollow ? "none" : style.colour,
        stroke: style.colour,
        "stroke-width": hollow ? 2 : 1,
      }),
    );
  }
  return drawing;
}

/** The key of a chart: nothing where there is one series. */
export function legend(entries: { slot: number; label: string }[], mark: "line" | "dot" = "line"): HTMLElement | null {
  if (entries.length < 2) return null;
  return el("ul", { class: "legend", "aria-label": "Key" },
    ...entries.map(({ slot, label }) => el("li", {}, swatch(slot, mark), breakable(label))));
}

// ---- How one outcome is told from another on a map: colour, mark and dash together, never colour alone.

/** A mark of that size (1 in a key) as steps from its middle. */
type Mark = (size: number) => string;

interface OutcomeStyle { colour: string; mark: Mark; dash: string; hollow?: boolean }

const CIRCLE: Mark = (s) => `m${-3.4 * s},0a${3.4 * s},${3.4 * s} 0 1,0 ${6.8 * s},0a${3.4 * s},${3.4 * s} 0 1,0 ${-6.8 * s},0z`;
const DIAMOND: Mark = (s) => `m0,${-4.4 * s}l${3.6 * s},${4.4 * s}l${-3.6 * s},${4.4 * s}l${-3.6 * s},${-4.4 * s}z`;
const TRIANGLE: Mark = (s) => `m0,${-4.6 * s}l${4.3 * s},${7.6 * s}h${-8.6 * s}z`;
const SQUARE: Mark = (s) => `m${-3.4 * s},${-3.4 * s}h${6.8 * s}v${6.8 * s}h${-6.8 * s}z`;
const BAR: Mark = (s) => `m${-2 * s},${-4.4 * s}h${4 * s}v${8.8 * s}h${-4 * s}z`;
const CROSS: Mark = (s) => `m${-3.4 * s},${-3.4 * s}l${6.8 * s},${6.8 * s}m0,${-6.8 * s}l${-6.8 * s},${6.8 * s}`;
const PLUS: Mark = (s) => `m0,${-4.4 * s}v${8.8 * s}m${-4.4 * s},${-4.4 * s}h${8.8 * s}`;

export const STYLES: Record<string, OutcomeStyle> = {
  goal_reached: { colour: "var(--series-3)", mark: CIRCLE, dash: "none" },
  false_goal: { colour: "var(--series-5)", mark: DIAMOND, dash: "7 3" },
  no_path: { colour: "var(--series-2)", mark: TRIANGLE, dash: "none" },
  high_centred: { colour: "var(--series-1)", mark: SQUARE, dash: "none" },
  jammed: { colour: "var(--series-4)", mark: BAR, dash: "2 2" },
  tip_over: { colour: "var(--bad)", mark: CROSS, dash: "none", hollow: true },
  energy_depleted: { colour: "var(--muted)", mark: DIAMOND, dash: "2 3" },
  time_limit: { colour: "var(--muted)", mark: SQUARE, dash: "5 2" },
  left_arena: { colour: "var(--muted)", mark: CROSS, dash: "none", hollow: true },
  excessive_slip: { colour: "var(--muted)", mark: BAR, dash: "7 3" },
  navigator_fault: { colour: "var(--bad)", mark: TRIANGLE, dash: "2 3" },
};
const OTHER: OutcomeStyle = { colour: "var(--text)", mark: PLUS, dash: "1 3", hollow: true };

const styleOf = (outcome: string) => STYLES[outcome] ?? OTHER;

/** All marks of an outcome as one element: thousands of them are drawn at once. Places in pixels. */
export function outcomeMarks(outcome: string, places: [number, number][], size = 1): SVGPathElement {
  const { colour, mark, hollow } = styleOf(outcome);
  const steps = mark(size);
  return svg("path", {
    class: "map-marks",
    d: places.map(([x, y]) => `M${x.toFixed(1)},${y.toFixed(1)}${steps}`).join(""),
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
