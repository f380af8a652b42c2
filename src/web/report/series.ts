// How one series is told from another: colour, mark and dash together, never colour alone.

import { breakable, el, svg } from "../shared/dom";

export interface SeriesStyle {
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
  return el(
    "ul",
    { class: "legend", "aria-label": "Key" },
    ...entries.map(({ slot, label }) => el("li", {}, swatch(slot, mark), breakable(label))),
  );
}
