// The trial as a plan in two dimensions, for browsers without WebGL.
import { el } from "../shared/dom";
import type { Course as Drive, Moment } from "./motion";
import { rampCss, readPalette, type Palette } from "./palette";
import type { ReplayPayload, Shape } from "./payload";
import { arcPoint, frameOf, turnPoint } from "./scene/arcs";
import { toldElsewhere } from "./scene/course";
import { extentOf, type Extent } from "./scene/ground";
import type { CameraMode, DrawnLink, DrawnPose, Layers, Shown, View } from "./view";

const MARGIN_PX = 16;

export class PlanView implements View {
  readonly element = el("canvas", { class: "plan" });
  readonly modes = ["top"] as const;
  readonly mode: CameraMode = "top";
  private palette: Palette = readPalette();
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
    this.palette = readPalette();
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
    if (layers.grid) this.drawGrid(pixel);
    this.drawStep(pixel);
    this.drawRocks(pixel);
    this.drawCourse(pixel);
    this.drawPaths(shown.moment, pixel);
    this.drawScan(pixel);
    if (layers.marks) this.drawMarks(shown.moment.t, pixel);
    const { moment } = shown;
    if (layers.believed) this.drawRover(moment.believed, palette["believed-path"], pixel, [4 * pixel, 3 * pixel]);
    this.drawRover(moment, palette["true-path"], pixel, []);
  }

  private drawGrid(pixel: number): void {
    const { context } = this;
    const extent = extentOf(this.payload.course);
    context.strokeStyle = this.palette.grid;
    context.lineWidth = pixel;
    context.beginPath();
    for (let x = Math.ceil(extent.xMin); x <= extent.xMax; ++x) this.move(x, extent.yMin, x, extent.yMax);
    for (let y = Math.ceil(extent.yMin); y <= extent.yMax; ++y) this.move(extent.xMin, y, extent.xMax, y);
    context.stroke();
  }

  private move(x0: number, y0: number, x1: number, y1: number): void {
    this.context.moveTo(x0, y0);
    this.context.lineTo(x1, y1);
  }

  // Octagons, as in the published figure.
  private drawRocks(pixel: number): void {
    const { context, payload } = this;
    const centers = payload.rocks.map(({ x, y }) => ({ x, y }));
    for (const { rock, t, x, y } of payload.rock_moves) {
      if (t <= this.shown!.moment.t) centers[rock] = { x, y };
    }
    context.fillStyle = this.palette.rock;
    context.strokeStyle = this.palette.label;
    context.lineWidth = 0.75 * pixel;
    payload.rocks.forEach(({ a, b, yaw }, i) => {
      context.beginPath();
      for (let k = 0; k < 8; ++k) {
        const angle = ((k + 0.5) * Math.PI) / 4;
        const [u, v] = [a * Math.cos(angle), b * Math.sin(angle)];
        const { x, y } = centers[i]!;
        context.lineTo(x + u * Math.cos(yaw) - v * Math.sin(yaw), y + u * Math.sin(yaw) + v * Math.cos(yaw));
      }
      context.closePath();
      context.fill();
      context.stroke();
    });
  }

  private drawCourse(pixel: number): void {
    const { context, palette, payload } = this;
    const { start, goal, told_goal: told } = payload.course;
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

  private drawScan(pixel: number): void {
    const { context, palette, shown, layers } = this;
    if (!shown!.scan || !layers!.scan) return;
    for (const { x, y, stripe } of shown!.scan.points) {
      const hazard = shown!.scan.hazards[stripe] === true;
      context.fillStyle = hazard ? palette.hazard : palette.clear;
      context.beginPath();
      context.arc(x, y, (hazard ? 4 : 2) * pixel, 0, 2 * Math.PI);
      context.fill();
    }
  }

  private drawMarks(t: number, pixel: number): void {
    const { context, palette } = this;
    for (const { t: at, kind, x, y } of this.payload.events) {
      if (at > t || (kind !== "hazard" && kind !== "scrape" && kind !== "stall")) continue;
      context.fillStyle = context.strokeStyle = palette[kind];
      context.lineWidth = 2 * pixel;
      const reach = 4 * pixel;
      context.beginPath();
      if (kind === "hazard") context.arc(x, y, reach, 0, 2 * Math.PI);
      else if (kind === "stall") context.rect(x - reach, y - reach, 2 * reach, 2 * reach);
      else {
        this.move(x - reach, y - reach, x + reach, y + reach);
        this.move(x - reach, y + reach, x + reach, y - reach);
      }
      if (kind === "scrape") context.stroke();
      else context.fill();
    }
  }

  private drawStep(pixel: number): void {
    const { context, shown, layers } = this;
    const step = shown!.step;
    if (!step) return;
    const frame = frameOf(step, layers!.mapAtTruth);
    const { map } = step;
    for (let i = 0; layers!.map !== "off" && i < map.nx * map.ny; ++i) {
      const value = (layers!.map === "certainty" ? map.certainty : map.goodness)[i] ?? -1;
      if (value < 0) continue;
      const u = map.x0 + (i % map.nx) * map.xstep;
      const v = map.y0 + Math.floor(i / map.nx) * map.ystep;
      context.fillStyle = rampCss(value / 255);
      context.beginPath();
      for (const [du, dv] of [[0, 0], [1, 0], [1, 1], [0, 1]] as const) {
        context.lineTo(...frame.place(u + du * map.xstep, v + dv * map.ystep));
      }
      context.fill();
    }
    for (const vote of layers!.votes ? step.votes : []) {
      context.strokeStyle = vote.chosen ? this.palette.chosen : rampCss(vote.merged / 255);
      context.lineWidth = (vote.chosen ? 4 : 1.5) * pixel;
      context.beginPath();
      for (let k = 0; k <= 20; ++k) {
        const point = vote.kind === "turn" ? turnPoint(vote, k / 20) : arcPoint(vote, k / 20);
        context.lineTo(...frame.ahead(point.x, point.y));
      }
      context.stroke();
    }
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
