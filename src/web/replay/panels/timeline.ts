// Events over time by kind, what the rover did, and curves of the drive; a click anywhere goes there.

import { el, svg } from "../../shared/dom";
import { activityRuns, inWords, kindName, kindsOf, kindTitle } from "../events";
import { clock } from "../format";
import type { ReplayPayload, TrialEvent } from "../payload";
import type { Player } from "../player";
import { niceStep } from "../scene/ground";
import { curve, driveCurves, steeringKey } from "./curves";
import { activityBand, activityKey, type Mark, markOf, startWalk, walk } from "./marks";

const ROW = 24;
const STRIP = 24;
const CURVE = 46;
const AXIS = 20;
const PAD = 8;
// Between times on the axis, px.
const TICK_SPACING = 72;
// So near to a mark a click means the mark, px.
const SNAP = 6;

export class Timeline {
  readonly element = el("div", { class: "timeline" });
  private readonly hidden = new Set<string>();
  private readonly labels = el("div", { class: "timeline-labels" });
  private readonly drawing = svg("svg", { class: "timeline-drawing" });
  private readonly cursor = svg("line", { class: "cursor" });
  private marks: Mark[] = [];
  private readonly axisLabel = el("div", { class: "axis" });
  private width = 0;
  private shortened = false;
  private readonly kinds = kindsOf(this.events);
  private readonly runs = activityRuns(this.payload);
  private readonly curves = driveCurves(this.payload);

  constructor(
    private readonly payload: ReplayPayload,
    private readonly events: TrialEvent[],
    private readonly player: Player,
    private readonly filtered: () => void,
  ) {
    this.element.append(this.labels, this.drawing);
    this.drawing.addEventListener("pointerdown", (event) => this.drag(event));
    this.drawing.addEventListener("keydown", (key) => {
      if (!walk(this.marks, key.key, (event) => player.seek(event.t))) return;
      key.preventDefault();
      key.stopPropagation();
    });
    this.makeLabels();
    this.element.append(activityKey(this.runs));
    const steering = steeringKey(payload);
    if (steering) this.element.append(steering);
    new ResizeObserver(() => this.resize()).observe(this.drawing);
    player.onChange(() => this.changed());
  }

  /** Ascending times of the events whose kinds are shown. */
  get shownTimes(): number[] {
    return this.events.filter((event) => !this.hidden.has(event.kind)).map((event) => event.t);
  }

  private get height(): number { return this.kinds.length * ROW + STRIP + this.curves.length * CURVE + AXIS; }

  private makeLabels(): void {
    for (const kind of this.kinds) {
      const count = this.events.filter((event) => event.kind === kind).length;
      const input = el("input", { type: "checkbox", checked: true });
      input.addEventListener("change", () => {
        if (input.checked) this.hidden.delete(kind);
        else this.hidden.add(kind);
        this.draw();
        this.filtered();
      });
      const look = markOf(kind);
      const mark = svg("svg", { class: "mark", viewBox: "-7 -7 14 14", "aria-hidden": "true" },
        svg("path", { d: look.path, style: `fill: var(${look.colour})` }));
      const name = el("span", { class: "kind" }, kindName(kind));
      this.labels.append(
        el("label", { class: "row", title: `${count}: ${kindTitle(kind)}` }, input, mark, name, el("span", { class: "count" }, `${count}`)),
      );
    }
    this.labels.append(el("div", { class: "strip" }, "activity"));
    for (const { title, most } of this.curves) {
      this.labels.append(el("div", { class: "curve" }, el("div", {}, title), el("div", { class: "count" }, most())));
    }
    this.labels.append(this.axisLabel);
  }

  private resize(): void {
    const width = Math.round(this.drawing.getBoundingClientRect().width);
    if (width === this.width || width === 0) return;
    this.width = width;
    this.draw();
  }

  // As played: where standing is shortened it is narrow here too, else a rover that was stuck for
  // hours would leave no room for its drive.
  private x(t: number): number { return PAD + (this.width - 2 * PAD) * this.player.shareOf(t); }

  private time(x: number): number { return this.player.timeOf((x - PAD) / Math.max(1, this.width - 2 * PAD)); }

  private draw(): void {
    this.drawing.replaceChildren();
    this.shortened = this.player.skipStanding;
    this.axisLabel.textContent = this.shortened ? "time as played" : "time";
    this.drawing.setAttribute("viewBox", `0 0 ${this.width} ${this.height}`);
    this.drawing.setAttribute("height", `${this.height}`);
    this.drawAxis();
    this.kinds.forEach((_, i) => {
      const y = (i + 1) * ROW;
      this.drawing.append(svg("line", { class: "rule", x1: PAD, x2: this.width - PAD, y1: y, y2: y }));
    });
    this.drawing.append(...activityBand(this.runs, (t) => this.x(t), this.kinds.length * ROW + STRIP - 2));
    this.drawCurves(this.kinds.length * ROW + STRIP);
    this.drawing.append(this.cursor);
    this.drawMarks();
    this.moveCursor();
  }

  private drawMarks(): void {
    const group = svg("g", { role: "toolbar", "aria-label": "Events: arrow keys walk along them, Enter goes there" });
    this.marks = [];
    this.kinds.forEach((kind, row) => {
      if (this.hidden.has(kind)) return;
      const look = markOf(kind);
      for (const event of this.events) {
        if (event.kind !== kind) continue;
        const label = `${clock(event.t)} ${inWords(event)}`;
        const element = svg(
          "g",
          { class: "event", role: "button", tabindex: -1, "aria-label": label, transform: `translate(${this.x(event.t)} ${(row + 0.5) * ROW})` },
          svg("title", {}, label),
          svg("path", { d: look.path, style: `fill: var(${look.colour})` }),
        );
        group.append(element);
        this.marks.push({ event, element });
      }
    });
    startWalk(this.marks);
    this.drawing.append(group);
  }

  private drawCurves(top: number): void {
    const { motion } = this.payload;
    this.curves.forEach((entry, i) => {
      const box = { left: PAD, right: this.width - PAD, top: top + i * CURVE + 6, bottom: top + (i + 1) * CURVE - 4 };
      this.drawing.append(curve(entry, motion.t, (t) => this.x(t), box));
    });
  }

  private drawAxis(): void {
    const { start, end } = this.player;
    const step = niceTime((this.player.timeOf(0.1) - start) / 2);
    let last = -Infinity;
    for (let t = Math.ceil(start / step) * step; t <= end; t += step) {
      const x = this.x(t);
      if (x - last < TICK_SPACING) continue;
      last = x;
      const y = this.height - AXIS;
      this.drawing.append(svg("line", { class: "tick", x1: x, x2: x, y1: 0, y2: y + 3 }));
      const anchor = x < 20 ? "start" : x > this.width - 24 ? "end" : "middle";
      this.drawing.append(svg("text", { x, y: y + 15, "text-anchor": anchor }, clock(t).replace(/\.0$/, "")));
    }
  }

  private changed(): void {
    if (this.player.skipStanding !== this.shortened) this.draw();
    else this.moveCursor();
  }

  private moveCursor(): void {
    const x = String(this.x(this.player.time));
    for (const name of ["x1", "x2"]) this.cursor.setAttribute(name, x);
    this.cursor.setAttribute("y1", "0");
    this.cursor.setAttribute("y2", String(this.height - AXIS));
  }

  private drag(event: PointerEvent): void {
    if (event.button !== 0) return;
    const box = this.drawing.getBoundingClientRect();
    const go = (at: PointerEvent): void => this.player.seek(this.time(at.clientX - box.left));
    const hit = this.markAt(event.clientX - box.left, event.clientY - box.top);
    if (hit) {
      this.player.seek(hit.t);
      return;
    }
    go(event);
    this.drawing.setPointerCapture(event.pointerId);
    this.drawing.addEventListener("pointermove", go);
    const stop = (): void => this.drawing.removeEventListener("pointermove", go);
    for (const name of ["pointerup", "pointercancel"] as const) this.drawing.addEventListener(name, stop, { once: true });
  }

  private markAt(x: number, y: number): TrialEvent | null {
    const kind = this.kinds[Math.floor(y / ROW)];
    let best: TrialEvent | null = null;
    let nearest = SNAP;
    for (const { event } of this.marks) {
      const away = Math.abs(this.x(event.t) - x);
      if (event.kind !== kind || away > nearest) continue;
      best = event;
      nearest = away;
    }
    return best;
  }
}

/** Seconds between ticks that read well as a clock. */
function niceTime(least: number): number {
  const steps = [1, 2, 5, 10, 20, 30, 60, 120, 300, 600, 1200, 1800, 3600, 7200, 14400];
  return steps.find((step) => step >= least) ?? niceStep(least, 1);
}
