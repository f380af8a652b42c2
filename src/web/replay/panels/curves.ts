// Small curves over time.
import { svg } from "../../shared/dom";

/** One line, or several on one scale. */
export interface Curve {
  lines: Line[];
  /** The scale reaches this far at least, so that noise does not look like a mountain. */
  least: number;
  class: string;
  /** Whether values are negative too: then 0 is in the middle. */
  signed?: boolean;
}

export interface Line {
  name: string;
  values: number[];
  /** Of its own within the curve; "" where there is one only. */
  class: string;
}

export interface Box {
  left: number;
  right: number;
  top: number;
  bottom: number;
}

/** The largest amount of any value, of either sign. */
export const greatest = ({ lines }: Curve): number =>
  lines.reduce((most, { values }) => values.reduce((least, value) => Math.max(least, Math.abs(value)), most), 0);

export function curve(drawn: Curve, t: number[], x: (t: number) => number, box: Box): SVGGElement {
  const scale = Math.max(drawn.least, greatest(drawn));
  const zero = drawn.signed ? (box.top + box.bottom) / 2 : box.bottom;
  const y = (value: number): number => zero - (value / scale) * (zero - box.top);
  const group = svg("g", { class: `curve ${drawn.class}` });
  group.append(svg("line", { class: "rule", x1: box.left, x2: box.right, y1: zero, y2: zero }));
  for (const { name, values, class: own } of drawn.lines) {
    group.append(svg("path", { class: own, d: outline(values, t, x, y) }, svg("title", {}, name)));
  }
  return group;
}

// Of the samples that share a pixel the least and the greatest are drawn: spikes stay.
function outline(values: number[], t: number[], x: (t: number) => number, y: (value: number) => number): string {
  let path = "";
  let column = NaN;
  let low = 0;
  let high = 0;
  const flush = (): void => {
    if (Number.isNaN(column)) return;
    path += `${path ? "L" : "M"}${column} ${y(low).toFixed(1)}`;
    if (high > low) path += `L${column} ${y(high).toFixed(1)}`;
  };
  values.forEach((value, i) => {
    const at = Math.round(x(t[i]!));
    if (at === column) {
      low = Math.min(low, value);
      high = Math.max(high, value);
      return;
    }
    flush();
    column = at;
    low = high = value;
  });
  flush();
  return path;
}
