// Where the rover is, where it believes to be, and what happened last.
import { el } from "../../shared/dom";
import { inWords } from "../events";
import { fixed, words } from "../../shared/format";
import { clock, degrees, headingText } from "../format";
import { lastAtOrBefore, type Moment } from "../motion";
import type { ReplayPayload, TrialEvent } from "../payload";

export class Readout {
  readonly element = el("section", { class: "panel readout", "aria-label": "Now" });
  private readonly rows = new Map<string, HTMLElement>();
  private readonly events: TrialEvent[];
  private readonly times: number[];

  constructor(private readonly payload: ReplayPayload, events: TrialEvent[]) {
    // Scans and looks come so often that nothing else would ever stand here.
    this.events = events.filter(({ kind }) => kind !== "scan" && kind !== "look");
    this.times = this.events.map((event) => event.t);
    const list = el("dl", {});
    for (const name of ["Time", "Activity", "True pose", "Believed pose", "Position error", "To the goal", "Tilt", "Last event"]) this.add(list, name);
    const joints = el("dl", {});
    for (const name of this.jointNames()) this.add(joints, name);
    const angles = el("details", {}, el("summary", {}, "Joint angles"), joints);
    this.element.append(el("h2", {}, "Now"), list, angles);
  }

  show(moment: Moment): void {
    const { goal } = this.payload.course;
    const { believed } = moment;
    const last = this.events[lastAtOrBefore(this.times, moment.t)];
    const toGoal = Math.hypot(goal.x - moment.x, goal.y - moment.y);
    this.set("Time", clock(moment.t));
    this.set("Activity", moment.activity);
    this.set("Last event", last ? `${clock(last.t)} ${inWords(last)}` : "none yet");
    this.set("True pose", poseText(moment.x, moment.y, moment.heading));
    this.set("Believed pose", poseText(believed.x, believed.y, believed.heading));
    this.set("Position error", `${fixed(moment.error, 3)} m`);
    this.set("To the goal", `${fixed(toGoal, 2)} m from its centre${toGoal <= goal.radius ? ", within its radius" : ""}`);
    this.set("Tilt", `${fixed(degrees(moment.tilt), 1)}°`);
    for (const name of this.jointNames()) this.set(name, `${fixed(degrees(moment.joints[name] ?? 0), 1)}°`);
  }

  // Angles of wheels grow without end and say little.
  private jointNames(): string[] {
    return Object.keys(this.payload.motion.joints).filter((name) => !name.endsWith("_wheel"));
  }

  private add(list: HTMLElement, name: string): void {
    const value = el("dd", {});
    this.rows.set(name, value);
    list.append(el("dt", {}, words(name)), value);
  }

  private set(name: string, text: string): void {
    const row = this.rows.get(name)!;
    if (row.textContent !== text) row.textContent = text;
  }
}

const poseText = (x: number, y: number, heading: number): string => `x ${fixed(x, 2)} m, y ${fixed(y, 2)} m, ${headingText(heading)}`;
