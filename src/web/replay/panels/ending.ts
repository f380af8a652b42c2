// How the drive ended, over its last picture: in words, where it stood, what led there, and what one
// could try.

import { button, el } from "../../shared/dom";
import { fixed } from "../../shared/format";
import { causeWords } from "../../shared/outcomes";
import { inWords } from "../events";
import { clock } from "../format";
import type { ReplayPayload, TrialEvent } from "../payload";
import type { Player } from "../player";

const LED_THERE = ["hazard", "felt", "scrape", "stall", "reflection"];
const MOST_LINKS = 3;

export const TRY: Record<string, string> = {
  false_goal:
    "Compare the two paths: where they part, the odometer or the gyro was wrong. A run with perfect localization shows the most that better ones can buy.",
  tip_over: "Look at the last metre from the side: which wheel climbed what, and whether the rover had seen it.",
  high_centred: "Look at the rock under the belly: was it lower than the hazard threshold, or did no scan show it?",
  jammed: "Look at the wheels that turn in vain: a rock before them that no scan showed, soil that gives way, or motors that are too weak.",
  no_path: "Watch the last turns: does it turn between the same rocks? A longer patience, or another navigator among the same rocks, tells more.",
  energy_depleted: "Scans and detours cost most: the energy of each is in the record.",
  time_limit: "Most time goes where it stands: scans and computing are on the time line.",
  excessive_slip: "Look at the ground under it: a slope, or wheels that have dug in. The slip that was seen is in the record.",
  navigator_fault: "Its navigator failed: what it said stands in the detail of the record.",
  left_arena: "Its course, or its belief, leads out of the terrain: a wider arena shows which.",
};

function metres(payload: ReplayPayload, name: string): string {
  const value = payload.record.find((column) => column.name === name)?.value;
  return value === null || value === undefined ? "" : `${fixed(value, 2)} m`;
}

/** Where it stood, as far as the record says. */
function whereItStood(payload: ReplayPayload, end: number): string {
  const truth = metres(payload, "true_goal_distance_m");
  const belief = metres(payload, "believed_goal_distance_m");
  const driven = metres(payload, "true_distance_m");
  if (!truth || !driven) return "";
  const believed = belief ? ` and believed it was ${belief} away` : "";
  return `It stood ${truth} from the goal${believed}, after ${driven} of driving in ${clock(end)}.`;
}

export class Ending {
  readonly element: HTMLElement;
  private dismissed = false;

  constructor(
    payload: ReplayPayload,
    events: TrialEvent[],
    private readonly player: Player,
    private readonly end: number,
    replay: () => void,
  ) {
    const good = payload.outcome === "goal_reached";
    const sentence = `It ${causeWords(payload.outcome, payload.detail)}.`;
    const advice = TRY[payload.outcome] ?? "";
    const setting = payload.cause_setting ? el("p", {}, "The rule behind it: ", el("code", {}, payload.cause_setting)) : null;
    this.element = el("section", { class: "ending", "aria-label": "How it ended", hidden: true },
      el("h2", { class: good ? "good" : "bad" }, `${good ? "✓" : "✗"} ${sentence}`),
      el("p", {}, whereItStood(payload, end)),
      good ? null : setting,
      advice ? el("p", {}, advice) : null,
      good ? null : this.links(events),
      el("div", { class: "buttons" },
        button("From the start", "Play the drive from its start", () => {
          player.seek(player.start);
          player.play();
        }),
        button("Overview", "The whole drive in ten seconds (v)", replay),
        button("Close", "See the picture alone", () => this.dismiss())));
    player.onChange(() => this.show());
    this.show();
  }

  private links(events: TrialEvent[]): HTMLElement | null {
    const last = events.filter(({ kind }) => LED_THERE.includes(kind)).slice(-MOST_LINKS);
    if (last.length === 0) return null;
    const list = el("ul", { class: "led-there" });
    for (const event of last) {
      const go = button(`${clock(event.t)} ${inWords(event)}`, "Go to this moment", () => this.player.seek(event.t), { class: "link" });
      list.append(el("li", {}, go));
    }
    return el("div", {}, el("p", {}, "What led there:"), list);
  }

  private dismiss(): void {
    this.dismissed = true;
    this.show();
  }

  private show(): void {
    const atEnd = this.player.time >= this.end;
    if (!atEnd) this.dismissed = false;
    this.element.hidden = !atEnd || this.dismissed;
  }
}
