// Keys of the page, and the help that lists them.

import { button, el } from "../../shared/dom";
import { type Player, STANDING_S } from "../player";
import type { CameraMode } from "../view";

export interface Key {
  /** As KeyboardEvent.key says, one or more. */
  keys: string[];
  shown: string; does: string;
  act: () => void;
}

/** Keys act anywhere but in fields that take text, and where a control uses the key itself. */
export function bindKeys(keys: Key[]): void {
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented) return;
    if (document.querySelector("dialog[open]")) return;
    const entry = keys.find((key) => key.keys.includes(event.key));
    if (!entry || usesKey(event.target, event.key)) return;
    event.preventDefault();
    entry.act();
  });
}

function usesKey(target: EventTarget | null, key: string): boolean {
  if (!(target instanceof Element)) return false;
  if (target.matches("input[type=search], textarea")) return true;
  if (target.matches("input[type=range]")) return key.startsWith("Arrow") || key === "Home" || key === "End";
  if (target.matches("select")) return true;
  return key === " " && target.matches("button, summary, input, a");
}

export function helpDialog(keys: Key[]): HTMLDialogElement {
  const list = el("dl", { class: "keys" });
  for (const { shown, does } of keys) list.append(el("dt", {}, el("kbd", {}, shown)), el("dd", {}, does));
  const dialog = el("dialog", { "aria-label": "Keys" },
    el("h2", {}, "Keys"),
    list,
    el("p", {}, "Drag turns the picture, the right button or two fingers move it, the wheel or a pinch comes nearer. A click on the time line goes there."));
  dialog.append(button("Close", "Close (Escape)", () => dialog.close()));
  document.body.append(dialog);
  return dialog;
}

// ---- The keys of the page.

interface Actions {
  player: Player;
  step(by: 1 | -1): void;
  camera(mode: CameraMode): void;
  approach(factor: number): void;
  turn(angle: number): void;
  planOfPaths(): void;
  overview(): void;
  savePicture(): void;
  toggleBelieved(): void;
  toggleTrueShapes(): void;
  toggleCameras(): void;
  nextMap(): void;
}

// Of one press.
const SCRUB = 0.01;
const NEARER = 1.2;
const TURN_RAD = 0.15;

const key = (name: string, does: string, act: () => void, shown = name): Key => ({ keys: [name], shown, does, act });

export function pageKeys(actions: Actions): Key[] {
  return [...playerKeys(actions), ...pictureKeys(actions), key("?", "this help", openHelp)];
}

function playerKeys({ player, step }: Actions): Key[] {
  const scrub = (by: number): void => player.seek(player.timeOf(player.shareOf(player.time) + by));
  return [
    key(" ", "play or pause", () => player.toggle(), "space"),
    key("ArrowRight", "on by 1 % of what is played", () => scrub(SCRUB), "→"),
    key("ArrowLeft", "back by 1 % of what is played", () => scrub(-SCRUB), "←"),
    key("n", "next event", () => step(1)),
    key("p", "previous event", () => step(-1)),
    key("Home", "to the start", () => player.seek(player.start)),
    key("End", "to the end", () => player.seek(player.end)),
    { keys: ["+", "="], shown: "+", does: "faster", act: () => player.changeSpeed(1) },
    key("-", "slower", () => player.changeSpeed(-1), "−"),
    key("s", `shorten standing to ${STANDING_S} s, or not`, () => (player.skipStanding = !player.skipStanding)),
  ];
}

function pictureKeys(actions: Actions): Key[] {
  return [
    key("f", "camera that follows the rover", () => actions.camera("follow")),
    key("t", "plan from above, x to the right", () => actions.camera("top")),
    key("o", "free camera", () => actions.camera("orbit")),
    key("r", "from a mast on the rover", () => actions.camera("rover")),
    key("]", "nearer", () => actions.approach(NEARER)),
    key("[", "further away", () => actions.approach(1 / NEARER)),
    key(",", "camera to the left", () => actions.turn(-TURN_RAD)),
    key(".", "camera to the right", () => actions.turn(TURN_RAD)),
    key("6", "plan of both paths (figure 16)", actions.planOfPaths),
    key("v", "overview of ten seconds", actions.overview),
    key("i", "save the picture as an image", actions.savePicture),
    key("b", "believed path, or not", actions.toggleBelieved),
    key("m", "next kind of map", actions.nextMap),
    key("x", "rocks in the true shapes that the simulator uses, or roughened", actions.toggleTrueShapes),
    key("l", "what the cameras see, or not", actions.toggleCameras),
  ];
}

const openHelp = (): void => document.querySelector("dialog")?.showModal();
