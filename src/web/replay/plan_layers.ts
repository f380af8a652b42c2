// What lies on the ground of the plan in two dimensions.
import { rampCss, type Palette } from "./palette";
import type { Course, Rock, RockMove, Scan, Splines, Step, TrialEvent } from "./payload";
import { arcPoint, frameOf, PIECES, turnPoint, type ArcPoint, type Frame } from "./scene/arcs";
import { extentOf } from "./scene/ground";
import { drawingOrder, splinePath } from "./scene/splines";
import type { Layers } from "./view";

/** Draws in metres; `pixel` is the length of one on the screen, m. */
export interface Brush {
  context: CanvasRenderingContext2D;
  palette: Palette;
  pixel: number;
}

function line(context: CanvasRenderingContext2D, x0: number, y0: number, x1: number, y1: number): void {
  context.moveTo(x0, y0);
  context.lineTo(x1, y1);
}

export function drawGrid({ context, palette, pixel }: Brush, course: Course): void {
  const { xMin, xMax, yMin, yMax } = extentOf(course);
  context.strokeStyle = palette.grid;
  context.lineWidth = pixel;
  context.beginPath();
  for (let x = Math.ceil(xMin); x <= xMax; ++x) line(context, x, yMin, x, yMax);
  for (let y = Math.ceil(yMin); y <= yMax; ++y) line(context, xMin, y, xMax, y);
  context.stroke();
}

export function drawMirrorLines({ context, palette, pixel }: Brush, course: Course): void {
  const { xMin, xMax } = extentOf(course);
  context.strokeStyle = palette.mirror;
  context.lineWidth = 2 * pixel;
  context.setLineDash([10 * pixel, 3 * pixel, 2 * pixel, 3 * pixel]);
  context.beginPath();
  for (const y of course.mirror_lines) line(context, xMin, y, xMax, y);
  context.stroke();
  context.setLineDash([]);
}

/** Octagons, as in the published figure, where they lie at time t. */
export function drawRocks({ context, palette, pixel }: Brush, rocks: Rock[], moves: RockMove[], t: number): void {
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

export function drawScan({ context, palette, pixel }: Brush, scan: Scan): void {
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
export function drawStep(brush: Brush, step: Step, layers: Layers): void {
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
    const at = (share: number): ArcPoint => (vote.kind === "turn" ? turnPoint(vote, share) : arcPoint(vote, share));
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

function drawPath({ context, palette, pixel }: Brush, at: (share: number) => ArcPoint, frame: Frame["ahead"], chosen: boolean, colour: string): void {
  context.strokeStyle = chosen ? palette.chosen : colour;
  context.lineWidth = (chosen ? 4 : 1.5) * pixel;
  context.beginPath();
  for (let k = 0; k <= PIECES; ++k) {
    const { x, y } = at(k / PIECES);
    context.lineTo(...frame(x, y));
  }
  context.stroke();
}
