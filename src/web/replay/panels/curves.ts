// A small curve over time.
import { svg } from "../../shared/dom";

export interface Curve {
  values: number[];
  /** The scale reaches this far at least, so that noise does not look like a mountain. */
  least: number;
  class: string;
}

export interface Box {
  left: number;
  right: number;
  top: number;
  bottom: number;
}

/** Of values that are not negative. */
export const greatest = (values: number[]): number => values.reduce((most, value) => Math.max(most, value), 0);

export function curve({ values, least, class: name }: Curve, t: number[], x: (t: number) => number, box: Box): SVGGElement {
  const scale = Math.max(least, greatest(values));
  const y = (value: number): number => box.bottom - (value / scale) * (box.bottom - box.top);
  const group = svg("g", { class: `curve ${name}` });
  group.append(svg("line", { class: "rule", x1: box.left, x2: box.right, y1: box.bottom, y2: box.bottom }));
  group.append(svg("path", { d: outline(values, t, x, y) }));
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
