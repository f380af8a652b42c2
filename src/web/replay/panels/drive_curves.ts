// The curves of a drive below its events: how it leaned, how wrong its belief was, how far the goal
// was (figure 7 of Howard 2012) and how its wheels were steered (figure 8 there).
import { el, svg } from "../../shared/dom";
import { fixed, words } from "../../shared/format";
import { degrees } from "../format";
import type { ReplayPayload } from "../payload";
import { greatest, type Curve } from "./curves";

export interface DriveCurve extends Curve {
  title: string;
  /** The largest amount, as text. */
  most(): string;
}

const KNUCKLE = "_knuckle";

/** Links that steer a wheel. */
export const knuckles = ({ motion }: ReplayPayload): string[] => Object.keys(motion.joints).filter((name) => name.endsWith(KNUCKLE));

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
