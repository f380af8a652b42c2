// The trial as a plan in two dimensions, for browsers without WebGL.

import { el } from "../shared/dom";
import type { Course as Drive, Moment } from "./motion";
import { gridPicture, lineNames, overlayStyle, placingOf } from "./overlays";
import { type Palette, rampCss, readPalette } from "./palette";
import type { Course, Overlay, Place, ReplayPayload, Rock, RockMove, Scan, Shape, Splines, Step, TrialEvent } from "./payload";
import { arcPoint, drawingOrder, type Frame, frameOf, PIECES, placed, splinePath, turnPoint } from "./scene/arcs";
import { toldElsewhere, WAYPOINT_RADIUS_M } from "./scene/course";
import { type Extent, extentOf } from "./scene/ground";
import { worldKind } from "./scene/world";
import type { CameraMode, DrawnLink, DrawnPose, Layers, Shown, View } from "./view";

const MARGIN_PX = 16;
const OVERLAY_PX = 2.5;

export class PlanView implements View {
  readonly element = el("canvas", { class: "plan" });
  readonly modes = ["top"] as const;
  readonly mode: CameraMode = "top";
  private shown: Shown | null = null;
  private layers: Layers | null = null;
  private readonly context = this.element.getContext("2d")!;
  private palette = readPalette(worldKind(this.payload.world));
  private readonly body = bodyOf(this.payload);
  private readonly names = lineNames(this.payload.overlays);

  constructor(private readonly payload: ReplayPayload, private readonly drive: Drive, private readonly extent: Extent) {
  }

  setMode(): void {}

  approach(): void {}

  turn(): void {}

  onMoved(): void {}

  show(shown: Shown, layers: Layers): void {
    this.shown = shown;
    this.layers = layers;
  }

  recolour(): void { this.palette = readPalette(worldKind(this.payload.world)); }

  resize(): void {
    const { clientWidth, clientHeight } = this.element.parentElement!;
    this.element.width = Math.max(1, clientWidth * window.devicePixelRatio);
    this.element.height = Math.max(1, clientHeight * window.devicePixelRatio);
  }

  drawn(): DrawnPose {
    const { x, y, z, heading } = this.shown?.moment ?? this.drive.at(this.drive.start);
    return { x, y, z, heading };
  }

  drawnLinks(): DrawnLink[] { return []; }

  drawing(): null { return null; }

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
    const overlay = layers.overlay ? shown.overlay : null;
    if (overlay) drawOverlayGrids(brush, overlay, layers);
    drawRocks(brush, rocks, moves, shown.moment.t);
    if (overlay) drawOverlayLines(brush, overlay, layers, this.names);
    drawMirrorLines(brush, course);
    this.drawCourse(brush);
    this.drawPaths(brush, shown.moment, layers.believed);
    if (shown.scan && layers.scan) drawScan(brush, shown.scan);
    if (layers.marks) drawMarks(brush, events, shown.moment.t);
    const { moment } = shown;
    if (layers.believed) this.drawRover(brush, moment.believed, palette["believed-path"], [4, 3]);
    this.drawRover(brush, moment, palette["true-path"], []);
  }

  private drawCourse(brush: Brush): void {
    const { palette } = brush;
    const { course } = this.payload;
    const { start, goal, told_goal: told, waypoints } = course;
    const ring = (x: number, y: number, radius: number, colour: string, dash: number[] = []): void =>
      stroke(brush, colour, 2, () => brush.context.arc(x, y, radius, 0, 2 * Math.PI), dash);
    ring(start.x, start.y, 0.12, palette.label);
    for (const { x, y } of waypoints) ring(x, y, WAYPOINT_RADIUS_M, palette.goal);
    ring(goal.x, goal.y, goal.radius, palette.goal);
    if (toldElsewhere(course)) ring(told.x, told.y, goal.radius, palette["told-goal"], [5, 4]);
  }

  private drawPaths(brush: Brush, moment: Moment, believed: boolean): void {
    const { motion } = this.drive;
    const { context, palette } = brush;
    const path = (xs: number[], ys: number[], { x, y }: { x: number; y: number }): void => {
      for (let i = 0; i <= moment.index; ++i) {
        if (i === 0 || this.drive.brokenBefore(i)) context.moveTo(xs[i]!, ys[i]!);
        else context.lineTo(xs[i]!, ys[i]!);
      }
      context.lineTo(x, y);
    };
    stroke(brush, palette["true-path"], 2.5, () => path(motion.x, motion.y, moment));
    if (believed) stroke(brush, palette["believed-path"], 2.5, () => path(motion.believed_x, motion.believed_y, moment.believed), [6, 4]);
  }

  private drawRover(brush: Brush, pose: Place, colour: string, dash: number[]): void {
    const { xMin, xMax, yMin, yMax } = this.body;
    const corners = [[xMin, yMin], [xMax, yMin], [xMax + 0.12, 0], [xMax, yMax], [xMin, yMax]] as const;
    stroke(brush, colour, 2, () => {
      for (const [u, v] of corners) brush.context.lineTo(...placed(pose, u, v));
      brush.context.closePath();
    }, dash);
  }
}

/** What the boxes of the chassis cover, seen from above. */
function bodyOf({ rover }: ReplayPayload): Extent {
  const boxes = (rover.links[0]?.shapes ?? []).filter((shape): shape is Extract<Shape, { kind: "box" }> => shape.kind === "box");
  const half = (axis: 0 | 1): number => Math.max(0.1, ...boxes.map(({ center, size }) => Math.abs(center[axis]) + size[axis] / 2));
  return { xMin: -half(0), xMax: half(0), yMin: -half(1), yMax: half(1) };
}

// ---- What lies on the ground of the plan in two dimensions.

/** Draws in metres; `pixel` is the length of one on the screen, m. */
interface Brush { context: CanvasRenderingContext2D; palette: Palette; pixel: number }

/** Strokes what `trace` draws; widths and dashes in pixels. */
export function stroke({ context, pixel }: Brush, colour: string, width: number, trace: () => void, dash: number[] = []): void {
  context.strokeStyle = colour;
  context.lineWidth = width * pixel;
  context.setLineDash(dash.map((length) => length * pixel));
  context.beginPath();
  trace();
  context.stroke();
  context.setLineDash([]);
}

function line(context: CanvasRenderingContext2D, x0: number, y0: number, x1: number, y1: number): void {
  context.moveTo(x0, y0);
  context.lineTo(x1, y1);
}

function drawGrid(brush: Brush, course: Course): void {
  const { xMin, xMax, yMin, yMax } = extentOf(course);
  stroke(brush, brush.palette.grid, 1, () => {
    for (let x = Math.ceil(xMin); x <= xMax; ++x) line(brush.context, x, yMin, x, yMax);
    for (let y = Math.ceil(yMin); y <= yMax; ++y) line(brush.context, xMin, y, xMax, y);
  });
}

function drawMirrorLines(brush: Brush, course: Course): void {
  const { xMin, xMax } = extentOf(course);
  stroke(brush, brush.palette.mirror, 2, () => {
    for (const y of course.mirror_lines) line(brush.context, xMin, y, xMax, y);
  }, [10, 3, 2, 3]);
}

/** Octagons, as in the published figure, where they lie at time t. */
function drawRocks({ context, palette, pixel }: Brush, rocks: Rock[], moves: RockMove[], t: number): void {
  const centers = rocks.map(({ x, y }) => ({ x, y }));
  for (const { rock, t: at, x, y } of moves) {
    if (at <= t) centers[rock] = { x, y };
  }
  context.fillStyle = palette.rock;
  context.strokeStyle = palette.label;
  context.lineWidth = 0.75 * pixel;
  rocks.forEach(({ a, b, yaw }, i) => {
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

function drawScan({ context, palette, pixel }: Brush, scan: Scan): void {
  for (const { x, y, stripe } of scan.points) {
    const hazard = scan.hazards[stripe] === true;
    context.fillStyle = hazard ? palette.hazard : palette.clear;
    context.beginPath();
    context.arc(x, y, (hazard ? 4 : 2) * pixel, 0, 2 * Math.PI);
    context.fill();
  }
}

/** Hazards, scrapes and stalls until time t. */
export function drawMarks({ context, palette, pixel }: Brush, events: TrialEvent[], t: number): void {
  for (const { t: at, kind, x, y } of events) {
    if (at > t || (kind !== "hazard" && kind !== "scrape" && kind !== "stall")) continue;
    context.fillStyle = context.strokeStyle = palette[kind];
    context.lineWidth = 2 * pixel;
    const reach = 4 * pixel;
    context.beginPath();
    if (kind === "hazard") context.arc(x, y, reach, 0, 2 * Math.PI);
    else if (kind === "stall") context.rect(x - reach, y - reach, 2 * reach, 2 * reach);
    else {
      line(context, x - reach, y - reach, x + reach, y + reach);
      line(context, x - reach, y + reach, x + reach, y - reach);
    }
    if (kind === "scrape") context.stroke();
    else context.fill();
  }
}

/** The map, and the arcs or splines, of a decision. */
function drawStep(brush: Brush, step: Step, layers: Layers): void {
  const { context } = brush;
  const frame = frameOf(step, layers.mapAtTruth);
  const { map } = step;
  for (let i = 0; layers.map !== "off" && i < map.nx * map.ny; ++i) {
    const value = (layers.map === "certainty" ? map.certainty : map.goodness)[i] ?? -1;
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
  if (!layers.votes) return;
  for (const vote of step.votes) {
    const at = (share: number): Place => (vote.kind === "turn" ? turnPoint(vote, share) : arcPoint(vote, share));
    drawPath(brush, at, frame.ahead, vote.chosen, rampCss(vote.merged / 255));
  }
  if (step.splines) drawSplines(brush, step.splines, frame);
}

function drawSplines(brush: Brush, splines: Splines, frame: Frame): void {
  for (const i of drawingOrder(splines)) {
    const colour = splines.feasible[i] ? rampCss(splines.merged[i]! / 255) : brush.palette.grid;
    drawPath(brush, splinePath(splines, i), frame.along, i === splines.chosen, colour);
  }
}

function drawPath(brush: Brush, at: (share: number) => Place, frame: Frame["ahead"], chosen: boolean, colour: string): void {
  stroke(brush, chosen ? brush.palette.chosen : colour, chosen ? 4 : 1.5, () => {
    for (let k = 0; k <= PIECES; ++k) {
      const { x, y } = at(k / PIECES);
      brush.context.lineTo(...frame(x, y));
    }
  });
}

// ---- What the navigator shows.

function drawOverlayGrids({ context }: Brush, overlay: Overlay, layers: Layers): void {
  const place = placingOf(overlay, layers.mapAtTruth);
  const [x0, y0] = place(0, 0);
  const [[xx, xy], [yx, yy]] = [place(1, 0), place(0, 1)];
  for (const grid of overlay.grids) {
    const picture = grid.name === layers.overlayGrid ? gridPicture(grid) : null;
    if (!picture) continue;
    context.save();
    context.transform(xx - x0, xy - y0, yx - x0, yy - y0, x0, y0);
    context.imageSmoothingEnabled = false;
    context.drawImage(picture.canvas, grid.x0, grid.y0, picture.width, picture.height);
    context.restore();
  }
}

function drawOverlayLines(brush: Brush, overlay: Overlay, layers: Layers, names: string[]): void {
  const place = placingOf(overlay, layers.mapAtTruth);
  for (const { name, points } of overlay.lines) {
    const { colour, dash } = overlayStyle(names.indexOf(name));
    const trace = (): void => points.forEach(([x, y]) => brush.context.lineTo(...place(x, y)));
    stroke(brush, brush.palette["overlay-edge"], OVERLAY_PX + 2, trace);
    stroke(brush, brush.palette[colour], OVERLAY_PX, trace, (dash ?? []).map((length) => length * OVERLAY_PX));
  }
}
