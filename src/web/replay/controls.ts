// Buttons and check boxes of this page.
import { el } from "../shared/dom";

export function button(
  label: string,
  title: string,
  act: () => void,
  attributes: Record<string, string> = {},
): HTMLButtonElement {
  const element = el("button", { type: "button", title, ...attributes }, label);
  element.addEventListener("click", act);
  return element;
}

export function checkbox(label: string, checked: boolean, act: (on: boolean) => void, title = ""): HTMLLabelElement {
  const input = el("input", { type: "checkbox", checked });
  input.addEventListener("change", () => act(input.checked));
  return el("label", { class: "check", title: title || null }, input, el("span", {}, label));
}
