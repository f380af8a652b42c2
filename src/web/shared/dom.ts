// Elements from data. Text only ever becomes text nodes and attributes: nothing here reads markup.

export type Child = Node | string | number | null | undefined | false;

type Attributes = Record<string, string | number | boolean | null | undefined>;

/** An element with attributes (left out where null, undefined or false) and children. */
export function el<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  setAttributes(element, attributes);
  append(element, children);
  return element;
}

const SVG = "http://www.w3.org/2000/svg";

/** The same for a drawing. */
export function svg<K extends keyof SVGElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): SVGElementTagNameMap[K] {
  const element = document.createElementNS(SVG, tag);
  setAttributes(element, attributes);
  append(element, children);
  return element;
}

function setAttributes(element: Element, attributes: Attributes): void {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    element.setAttribute(name, value === true ? "" : String(value));
  }
}

function append(element: Element, children: Child[]): void {
  for (const child of children) {
    if (child === null || child === undefined || child === false) continue;
    element.append(child instanceof Node ? child : String(child));
  }
}

/** A name that may be broken after a comma: names of cells are lists without spaces. */
export function breakable(name: string): HTMLElement {
  const parts = name.split(/(?<=,)/);
  return el("span", {}, ...parts.flatMap((part, i) => (i > 0 ? [el("wbr"), part] : [part])));
}

/** A labelled control: the label stands before it. */
export function labelled(label: string, control: HTMLElement): HTMLLabelElement {
  return el("label", { class: "labelled" }, el("span", {}, label), control);
}

/** A drop-down list; `options` are [value, text]. */
export function select(options: [string, string][], chosen?: string): HTMLSelectElement {
  const list = el("select");
  for (const [value, text] of options) list.append(el("option", { value }, text));
  if (chosen !== undefined) list.value = chosen;
  return list;
}

export function button(label: string | Child[], title: string, act: () => void, attributes: Attributes = {}): HTMLButtonElement {
  const element = el("button", { type: "button", title: title || null, ...attributes }, ...(typeof label === "string" ? [label] : label));
  element.addEventListener("click", act);
  return element;
}

export function checkbox(label: string, checked: boolean, act: (on: boolean) => void, title = ""): HTMLLabelElement {
  const input = el("input", { type: "checkbox", checked });
  input.addEventListener("change", () => act(input.checked));
  return el("label", { class: "check", title: title || null }, input, el("span", {}, label));
}
