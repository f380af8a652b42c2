// Small curves over time.

import { el, svg } from "../../shared/dom";
import { fixed, words } from "../../shared/format";
import { degrees } from "../format";
import type { ReplayPayload } from "../payload";

/** One line, or several on one scale. */
export interface Curve {
  lines: Line[];
  /** The scale reaches this far at least, so that noise does not look like a mountain. */
  least: number;
  class: string;
  /** Whether values are negative too: then 0 is in the middle. */
  signed?: boolean;
}

interface Line {
  name: string;
  values: number[];
  /** Of its own within the curve; "" where there is one only. */
  class: string;
}

export interface Box { left: number; right: number; top: number; bottom: number }

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

// ---- The curves of a drive below its events: how it leaned, how wrong its belief was, how far the goal
// was (figure 7 of Howard 2012) and how its wheels were steered (figure 8 there).

interface DriveCurve extends Curve {
  title: string;
  /** The largest amount, as text. */
  most(): string;
}

const KNUCKLE = "_knuckle";

/** Links that steer a wheel. */
const knuckles = ({ motion }: ReplayPayload): string[] => Object.keys(motion.joints).filter((name) => name.endsWith(KNUCKLE));

const wheelName = (knuckle: string): string => words(knuckle.slice(0, -KNUCKLE.length));

export function driveCurves(payload: ReplayPayload): DriveCurve[] {
  const curves = [tilt(payload), positionError(payload), toGoal(payload)];
  return knuckles(payload).length > 0 ? [...curves, steering(payload)] : curves;
}

function tilt({ motion }: ReplayPayload): DriveCurve {
  const curve: Curve = { lines: [{ name: "tilt", values: motion.tilt.map(degrees), class: "" }], least: 5, class: "tilt" };
  return { ...curve, title: "tilt", most: () => `≤ ${fixed(greatest(curve), 1)}°` };
}

function positionError({ motion }: ReplayPayload): DriveCurve {
  const values = motion.t.map((_, i) => Math.hypot(motion.believed_x[i]! - motion.x[i]!, motion.believed_y[i]! - motion.y[i]!));
  const curve: Curve = { lines: [{ name: "position error", values, class: "" }], least: 0.05, class: "error" };
  return { ...curve, title: "position error", most: () => `≤ ${fixed(greatest(curve), 2)} m` };
}

function toGoal({ motion, course: { goal, told_goal: told } }: ReplayPayload): DriveCurve {
  const curve: Curve = {
    lines: [
      { name: "from the true position to the goal", values: motion.t.map((_, i) => Math.hypot(goal.x - motion.x[i]!, goal.y - motion.y[i]!)), class: "true" },
      {
        name: "from the believed position to the goal as told",
        values: motion.t.map((_, i) => Math.hypot(told.x - motion.believed_x[i]!, told.y - motion.believed_y[i]!)),
        class: "believed",
      },
    ],
    least: 0.05,
    class: "to-goal",
  };
  return { ...curve, title: "to the goal", most: () => `≤ ${fixed(greatest(curve), 2)} m` };
}

/** Positive to the left, one line a steered wheel. */
function steering(payload: ReplayPayload): DriveCurve {
  const lines = knuckles(payload).map((name) => ({ name: wheelName(name), values: payload.motion.joints[name]!.map(degrees), class: name.slice(0, -KNUCKLE.length) }));
  const curve: Curve = { lines, least: 5, class: "steering", signed: true };
  return { ...curve, title: "steering", most: () => `± ${fixed(greatest(curve), 1)}°` };
}

/** Which line is which wheel's. */
export function steeringKey(payload: ReplayPayload): HTMLElement | null {
  const names = knuckles(payload);
  if (names.length === 0) return null;
  const key = el("p", { class: "steering-key" }, "Steering, to the left above: ");
  for (const name of names) {
    const line = svg("path", { class: name.slice(0, -KNUCKLE.length), d: "M0 8H20" });
    const swatch = svg("svg", { viewBox: "0 0 20 16", width: 20, height: 16, "aria-hidden": "true" }, svg("g", { class: "curve steering" }, line));
    key.append(el("span", {}, swatch, wheelName(name)));
  }
  return key;
}
