// Keys of the page, and the help that lists them.
import { el } from "../../shared/dom";
import { button } from "../controls";

export interface Key {
  /** As KeyboardEvent.key says, one or more. */
  keys: string[];
  shown: string;
  does: string;
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
  const dialog = el(
    "dialog",
    { "aria-label": "Keys" },
    el("h2", {}, "Keys"),
    list,
    el("p", {}, "Drag turns the picture, the right button or two fingers move it, the wheel or a pinch comes nearer. A click on the time line goes there."),
  );
  dialog.append(button("Close", "Close (Escape)", () => dialog.close()));
  document.body.append(dialog);
  return dialog;
}
