// Which picture this browser gets, and what its plan covers.
import type { Course as Drive } from "./motion";
import type { ReplayPayload } from "./payload";
import { PlanView } from "./plan_view";
import type { Extent } from "./scene/ground";
import { SceneView } from "./scene/scene_view";
import type { View } from "./view";

// About the whole drive in the plan, m.
const PLAN_MARGIN_M = 0.8;

export function makeView(payload: ReplayPayload, drive: Drive): View {
  const View = hasWebGl() ? SceneView : PlanView;
  return new View(payload, drive, planExtent(payload));
}

// Asked of a canvas of its own, because three.js writes errors to the console.
function hasWebGl(): boolean { return document.createElement("canvas").getContext("webgl2") !== null; }

/** What the plan shows: the drive with start and goal, within the ground. */
function planExtent({ motion, course }: ReplayPayload): Extent {
  const { start, goal, told_goal: told, waypoints } = course;
  const extent = { xMin: start.x, xMax: start.x, yMin: start.y, yMax: start.y };
  const hold = (x: number, y: number, reach: number): void => {
    extent.xMin = Math.min(extent.xMin, x - reach);
    extent.xMax = Math.max(extent.xMax, x + reach);
    extent.yMin = Math.min(extent.yMin, y - reach);
    extent.yMax = Math.max(extent.yMax, y + reach);
  };
  hold(start.x, start.y, PLAN_MARGIN_M);
  for (const { x, y } of waypoints) hold(x, y, PLAN_MARGIN_M);
  hold(goal.x, goal.y, goal.radius + PLAN_MARGIN_M);
  hold(told.x, told.y, goal.radius + PLAN_MARGIN_M);
  motion.t.forEach((_, i) => {
    hold(motion.x[i]!, motion.y[i]!, PLAN_MARGIN_M);
    hold(motion.believed_x[i]!, motion.believed_y[i]!, PLAN_MARGIN_M);
  });
  return extent;
}
