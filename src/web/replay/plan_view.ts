// The trial as a plan in two dimensions, for browsers without WebGL.
import { el } from "../shared/dom";
import type { Course as Drive, Moment } from "./motion";
import { readPalette, type Palette } from "./palette";
import type { ReplayPayload, Shape } from "./payload";
import { drawGrid, drawMarks, drawMirrorLines, drawRocks, drawScan, drawStep } from "./plan_layers";
import { toldElsewhere, WAYPOINT_RADIUS_M } from "./scene/course";
import type { Extent } from "./scene/ground";
import { worldKind } from "./scene/world";
import type { CameraMode, DrawnLink, DrawnPose, Layers, Shown, View } from "./view";

const MARGIN_PX = 16;

export class PlanView implements View {
  readonly element = el("canvas", { class: "plan" });
  readonly modes = ["top"] as const;
  readonly mode: CameraMode = "top";
  private palette: Palette;
  private shown: Shown | null = null;
  private layers: Layers | null = null;
  private readonly context: CanvasRenderingContext2D;
  private readonly body: Extent;

  constructor(
    private readonly payload: ReplayPayload,
    private readonly drive: Drive,
    private readonly extent: Extent,
  ) {
    this.context = this.element.getContext("2d")!;
    this.palette = readPalette(worldKind(payload.world));
    this.body = bodyOf(payload);
  }

  setMode(): void {}

  approach(): void {}

  turn(): void {}

  onMoved(): void {}

  show(shown: Shown, layers: Layers): void {
    this.shown = shown;
    this.layers = layers;
  }

  recolour(): void {
    this.palette = readPalette(worldKind(this.payload.world));
  }

  resize(): void {
    const { clientWidth, clientHeight } = this.element.parentElement!;
    this.element.width = Math.max(1, clientWidth * window.devicePixelRatio);
    this.element.height = Math.max(1, clientHeight * window.devicePixelRatio);
  }

  drawn(): DrawnPose {
    const { x, y, z, heading } = this.shown?.moment ?? this.drive.at(this.drive.start);
    return { x, y, z, heading };
  }

  drawnLinks(): DrawnLink[] {
    return [];
  }

  drawing(): null {
    return null;
  }

  draw(): void {
    if (!this.shown || !this.layers) return;
    const { context, palette, shown, layers } = this;
    const { width, height } = this.element;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.fillStyle = palette.ground;
    context.fillRect(0, 0, width, height);
    const { xMin, xMax, yMin, yMax } = this.extent;
    const scale = Math.min((width - 2 * MARGIN_PX) / (xMax - xMin), (height - 2 * MARGIN_PX) / (yMax - yMin));
    // x to the right and y up, in metres.
    context.setTransform(scale, 0, 0, -scale, width / 2 - (scale * (xMin + xMax)) / 2, height / 2 + (scale * (yMin + yMax)) / 2);
    const pixel = window.devicePixelRatio / scale;
    const brush = { context, palette, pixel };
    const { course, rocks, rock_moves: moves, events } = this.payload;
    if (layers.grid) drawGrid(brush, course);
    if (shown.step) drawStep(brush, shown.step, layers);
    drawRocks(brush, rocks, moves, shown.moment.t);
    drawMirrorLines(brush, course);
    this.drawCourse(pixel);
    this.drawPaths(shown.moment, pixel);
    if (shown.scan && layers.scan) drawScan(brush, shown.scan);
    if (layers.marks) drawMarks(brush, events, shown.moment.t);
    const { moment } = shown;
    if (layers.believed) this.drawRover(moment.believed, palette["believed-path"], pixel, [4 * pixel, 3 * pixel]);
    this.drawRover(moment, palette["true-path"], pixel, []);
  }

  private drawCourse(pixel: number): void {
    const { context, palette, payload } = this;
    const { start, goal, told_goal: told, waypoints } = payload.course;
    const ring = (x: number, y: number, radius: number, colour: string, dash: number[]): void => {
      context.strokeStyle = colour;
      context.lineWidth = 2 * pixel;
      context.setLineDash(dash);
      context.beginPath();
      context.arc(x, y, radius, 0, 2 * Math.PI);
      context.stroke();
      context.setLineDash([]);
    };
    ring(start.x, start.y, 0.12, palette.label, []);
    for (const { x, y } of waypoints) ring(x, y, WAYPOINT_RADIUS_M, palette.goal, []);
    ring(goal.x, goal.y, goal.radius, palette.goal, []);
    if (toldElsewhere(payload.course)) ring(told.x, told.y, goal.radius, palette["told-goal"], [5 * pixel, 4 * pixel]);
  }

  private drawPaths(moment: Moment, pixel: number): void {
    const { motion } = this.drive;
    const { context, palette, layers } = this;
    const path = (xs: number[], ys: number[], x: number, y: number): void => {
      context.beginPath();
      for (let i = 0; i <= moment.index; ++i) {
        if (i === 0 || this.drive.brokenBefore(i)) context.moveTo(xs[i]!, ys[i]!);
        else context.lineTo(xs[i]!, ys[i]!);
      }
      context.lineTo(x, y);
      context.stroke();
    };
    context.lineWidth = 2.5 * pixel;
    context.strokeStyle = palette["true-path"];
    path(motion.x, motion.y, moment.x, moment.y);
    if (!layers!.believed) return;
    context.strokeStyle = palette["believed-path"];
    context.setLineDash([6 * pixel, 4 * pixel]);
    path(motion.believed_x, motion.believed_y, moment.believed.x, moment.believed.y);
    context.setLineDash([]);
  }

  private drawRover({ x, y, heading }: { x: number; y: number; heading: number }, colour: string, pixel: number, dash: number[]): void {
    const { context, body } = this;
    const at = (u: number, v: number): [number, number] => [
      x + u * Math.cos(heading) - v * Math.sin(heading),
      y + u * Math.sin(heading) + v * Math.cos(heading),
    ];
    context.strokeStyle = colour;
    context.lineWidth = 2 * pixel;
    context.setLineDash(dash);
    context.beginPath();
    context.moveTo(...at(body.xMin, body.yMin));
    context.lineTo(...at(body.xMax, body.yMin));
    context.lineTo(...at(body.xMax + 0.12, 0));
    context.lineTo(...at(body.xMax, body.yMax));
    context.lineTo(...at(body.xMin, body.yMax));
    context.closePath();
    context.stroke();
    context.setLineDash([]);
  }
}

/** What the boxes of the chassis cover, seen from above. */
function bodyOf({ rover }: ReplayPayload): Extent {
  const boxes = (rover.links[0]?.shapes ?? []).filter((shape): shape is Extract<Shape, { kind: "box" }> => shape.kind === "box");
  const half = (axis: 0 | 1): number => Math.max(0.1, ...boxes.map(({ center, size }) => Math.abs(center[axis]) + size[axis] / 2));
  return { xMin: -half(0), xMax: half(0), yMin: -half(1), yMax: half(1) };
}
