// The way that the rover drove, and the way that it believes it drove.
import { Group } from "three";
import { lastAtOrBefore, type Course, type Moment } from "../motion";
import type { Palette } from "../palette";
import type { GroundHeights } from "./ground";
import { Lines, type Point } from "./lines";

const LIFT_M = 0.015;
// Closer samples are one point of the line.
const SPACING_M = 0.004;

class Path {
  readonly done: Lines;
  readonly whole: Lines;
  // Sample at which each piece ends, ascending.
  private readonly endsAt: number[] = [];
  private readonly tip: Lines;
  private readonly points: Point[] = [];

  constructor(course: Course, at: (index: number) => Point, dash?: [number, number]) {
    this.done = new Lines({ width_px: 3.5, dash });
    this.tip = new Lines({ width_px: 3.5 });
    this.whole = new Lines({ width_px: 1.5, dash, opacity: 0.5 });
    let from = at(0);
    for (let i = 1; i < course.length; ++i) {
      const to = at(i);
      if (course.brokenBefore(i)) {
        from = to;
        continue;
      }
      if (Math.hypot(to[0] - from[0], to[1] - from[1]) < SPACING_M) continue;
      this.points.push(from, to);
      this.endsAt.push(i);
      from = to;
    }
    this.done.set(this.points);
    this.whole.set(this.points);
  }

  get objects(): Lines[] { return [this.done, this.tip, this.whole]; }

  /** Up to where the rover is: whole pieces, and the piece that it is on. */
  show(index: number, here: Point, whole: boolean): void {
    const count = lastAtOrBefore(this.endsAt, index) + 1;
    this.done.showFirst(count);
    const start = count < this.endsAt.length ? this.points[2 * count] : this.points[this.points.length - 1];
    const near = start && Math.hypot(start[0] - here[0], start[1] - here[1]) < 0.5;
    this.tip.set(near ? [start, here] : []);
    this.whole.object.visible = whole && this.endsAt.length > 0;
  }
}

export class Paths {
  readonly group = new Group();
  private readonly true: Path;
  private readonly believed: Path;

  constructor(course: Course, private readonly heights: GroundHeights) {
    const { motion } = course;
    this.true = new Path(course, (i) => this.truePoint(motion.x[i]!, motion.y[i]!, motion.z[i]!));
    this.believed = new Path(course, (i) => this.onGround(motion.believed_x[i]!, motion.believed_y[i]!), [0.09, 0.06]);
    for (const lines of [...this.true.objects, ...this.believed.objects]) this.group.add(lines.object);
  }

  show(moment: Moment, whole: boolean, believed: boolean): void {
    const { index, x, y, z } = moment;
    this.true.show(index, this.truePoint(x, y, z), whole);
    this.believed.show(index, this.onGround(moment.believed.x, moment.believed.y), whole);
    if (!believed) for (const lines of this.believed.objects) lines.object.visible = false;
  }

  set onTop(on: boolean) {
    for (const lines of [...this.true.objects, ...this.believed.objects]) lines.onTop = on;
  }

  recolour(palette: Palette): void {
    for (const lines of this.true.objects) lines.recolour(palette["true-path"]);
    for (const lines of this.believed.objects) lines.recolour(palette["believed-path"]);
  }

  private truePoint(x: number, y: number, z: number): Point {
    return [x, y, Math.max(z, this.heights.at(x, y)) + LIFT_M];
  }

  private onGround(x: number, y: number): Point { return [x, y, this.heights.at(x, y) + LIFT_M]; }
}
