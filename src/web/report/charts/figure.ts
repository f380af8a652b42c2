// One chart: title, one sentence on how to read it, key, drawing, and the numbers behind it.

import { el } from "../../shared/dom";

interface ChartSpec {
  id: string; title: string;
  /** How to read it, and what bands and bars are. */
  caption: string;
  /** What the drawing shows, for who does not see it. */
  alternative: string;
  key?: HTMLElement | null;
  /** The drawing at a width in pixels. */
  draw: (width: number) => Element;
  /** Tables of what is drawn; made when they are asked for. */
  numbers: () => HTMLElement[];
}

const LEAST_WIDTH = 260;

// Plot names each group of marks ("line", "dot") for readers, to whom the drawing is one picture with a
// name of its own; a group without a role may have none.
function nameMarksByData(drawing: Element): void {
  for (const group of drawing.querySelectorAll("g[aria-label]")) {
    group.setAttribute("data-mark", group.getAttribute("aria-label")!);
    group.removeAttribute("aria-label");
  }
}

function drawInto(box: HTMLElement, spec: ChartSpec, width: number): void {
  const drawing = spec.draw(Math.max(LEAST_WIDTH, width));
  drawing.setAttribute("role", "img");
  drawing.setAttribute("aria-label", spec.alternative);
  nameMarksByData(drawing);
  box.replaceChildren(drawing);
}

function numbersOf(spec: ChartSpec): HTMLDetailsElement {
  const details = el("details", { class: "numbers" }, el("summary", {}, "Numbers"));
  details.addEventListener(
    "toggle",
    () => {
      if (details.childElementCount === 1) details.append(...spec.numbers());
    },
  );
  return details;
}

/** The figure: drawn when it first has a width, and again when that changes. */
export function chartFigure(spec: ChartSpec): HTMLElement {
  const box = el("div", { class: "chart" });
  let drawn = 0;
  const observer = new ResizeObserver(([entry]) => {
    const width = Math.floor(entry?.contentRect.width ?? 0);
    if (width > 0 && width !== drawn) {
      drawn = width;
      drawInto(box, spec, width);
    }
  });
  observer.observe(box);
  return el("figure", { class: "chart-figure", id: spec.id },
    el("h3", {}, spec.title),
    spec.key,
    box,
    el("figcaption", {}, spec.caption),
    numbersOf(spec));
}
