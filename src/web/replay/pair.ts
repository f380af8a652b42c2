// Two trials side by side on one clock: the simulated time of each.
import { el } from "../shared/dom";
import { App, stretchesOf, type Shared } from "./app";
import { timelineEvents } from "./events";
import { Course as Drive } from "./motion";
import type { ReplayPayload } from "./payload";
import { common, Player, type Stretch } from "./player";
import { beatsOf, type Beat } from "./story";

// Of each trial, so that ten seconds are enough for both.
const BEATS_OF_EACH = 3;

/** A drive that has ended stands from then on. */
function standing(drive: Drive, end: number): Stretch[] {
  const stretches = stretchesOf(drive);
  return drive.end < end ? [...stretches, { from: drive.end, to: end }] : stretches;
}

function beats(first: ReplayPayload, second: ReplayPayload): Beat[] {
  const named = (payload: ReplayPayload, name: string): Beat[] =>
    beatsOf(payload, timelineEvents(payload)).slice(0, BEATS_OF_EACH).map(({ t, caption }) => ({ t, caption: `${name}: ${caption}` }));
  return [...named(first, "First"), ...named(second, "Second")].sort((a, b) => a.t - b.t);
}

const sameRocks = (a: ReplayPayload, b: ReplayPayload): boolean =>
  JSON.stringify([a.rocks, a.ground, a.course.goal]) === JSON.stringify([b.rocks, b.ground, b.course.goal]);

/** The page of both; keys, player and overview are those of the first. */
export function makePair(first: ReplayPayload, second: ReplayPayload, root: HTMLElement): App {
  const drives = [new Drive(first.motion), new Drive(second.motion)] as const;
  const start = Math.min(...drives.map((drive) => drive.start));
  const end = Math.max(...drives.map((drive) => drive.end));
  const transport = el("div", { class: "pair-transport" });
  const tools = el("div", { class: "tools" });
  const shared: Omit<Shared, "first"> = {
    player: new Player(start, end, common(standing(drives[0], end), standing(drives[1], end))),
    beats: beats(first, second),
    transport,
    tools,
    others: [],
  };
  const places = [el("section", { "aria-label": "First trial" }), el("section", { "aria-label": "Second trial" })] as const;
  const note = sameRocks(first, second)
    ? "Both drive among the same rocks to the same goal, on one clock."
    : "Their rocks or goals differ: one clock, but not one course.";
  root.classList.add("pair");
  root.replaceChildren(el("header", { class: "pair-head" }, el("p", {}, note), tools), el("div", { class: "pair-columns" }, ...places), transport);
  const follower = new App(second, places[1], { ...shared, first: false });
  return new App(first, places[0], { ...shared, first: true, others: [follower] });
}
