// What the picture shows, as switches that are its key as well.
import { el, labelled, select, svg } from "../../shared/dom";
import { checkbox } from "../controls";
import { rampCss } from "../palette";
import type { ReplayPayload } from "../payload";
import { toldElsewhere } from "../scene/course";
import type { Layers, MapKind } from "../view";

const MAPS: [MapKind, string][] = [
  ["goodness", "goodness"],
  ["certainty", "certainty"],
  ["elevation", "elevation"],
  ["off", "off"],
];

const MAP_WORDS: Record<MapKind, [string, string]> = {
  goodness: ["0, impassable", "255, safe; fainter where less certain"],
  certainty: ["0, unsure", "255, sure"],
  elevation: ["lowest", "highest of this map"],
  off: ["", ""],
};

const MARKS = [
  { kind: "hazard", mark: "hazard-mark", name: "hazard believed" },
  { kind: "scrape", mark: "scrape", name: "scrape" },
  { kind: "stall", mark: "stall", name: "stuck" },
];

const isMarked = (kind: string): boolean => MARKS.some((mark) => mark.kind === kind);

export function layersPanel(payload: ReplayPayload, layers: Layers, changed: () => void): HTMLElement {
  const panel = el("section", { class: "panel layers", "aria-label": "What is shown" }, el("h2", {}, "Shown"));
  type Switch = "marks" | "believed" | "wholePath" | "scan" | "grid" | "votes" | "mapAtTruth";
  const add = (name: Switch, label: string, mark: string | null = null): void => {
    const box = checkbox(label, layers[name], (on) => {
      layers[name] = on;
      changed();
    });
    box.append(mark ? swatch(mark) : "");
    panel.append(box);
  };
  panel.append(el("p", { class: "key" }, "True path", swatch("true")));
  add("believed", "Believed path and outline", "believed");
  add("wholePath", "Path to come");
  if (payload.scans.length > 0) {
    add("scan", "Last scan");
    panel.append(el("p", { class: "key" }, swatch("clear"), "clear stripe ", swatch("hazard"), "stripe with a hazard"));
  }
  if (payload.steps.length > 0) addMap(panel, layers, add, changed);
  if (payload.events.some(({ kind }) => isMarked(kind))) {
    add("marks", "Where it happened");
    const key = el("p", { class: "key" });
    for (const { kind, mark, name } of MARKS) {
      if (payload.events.some((event) => event.kind === kind)) key.append(swatch(mark), name);
    }
    panel.append(key);
  }
  add("grid", "Grid in metres");
  if (toldElsewhere(payload.course)) panel.append(el("p", { class: "key" }, "Designated goal", swatch("told")));
  if (payload.course.mirror_lines.length > 0) {
    panel.append(el("p", { class: "key" }, "Mirror line: operators turn the rover back", swatch("mirror")));
  }
  return panel;
}

function addMap(panel: HTMLElement, layers: Layers, add: (name: "votes" | "mapAtTruth" | "scan", label: string) => void, changed: () => void): void {
  const list = select(MAPS, layers.map);
  const low = el("span", {});
  const high = el("span", {});
  const key = el("p", { class: "ramp" }, low, rampBar(), high);
  const say = (): void => {
    [low.textContent, high.textContent] = MAP_WORDS[layers.map];
    key.hidden = layers.map === "off";
  };
  list.addEventListener("change", () => {
    layers.map = list.value as MapKind;
    say();
    changed();
  });
  say();
  panel.append(labelled("Map", list), key);
  add("mapAtTruth", "Map and arcs at the true pose");
  add("votes", "Arcs: wide and yellow is a high vote");
  add("scan", "Some of the points seen");
}

function rampBar(): SVGSVGElement {
  const bar = svg("svg", { viewBox: "0 0 64 8", class: "ramp-bar", "aria-hidden": "true" });
  for (let i = 0; i < 16; ++i) bar.append(svg("rect", { x: 4 * i, y: 0, width: 4.2, height: 8, style: `fill: ${rampCss(i / 15)}` }));
  return bar;
}

function swatch(kind: string): SVGSVGElement {
  const drawing = svg("svg", { viewBox: "0 0 34 12", class: `swatch ${kind}`, "aria-hidden": "true" });
  if (kind === "clear") drawing.append(svg("circle", { cx: 17, cy: 6, r: 3 }));
  else if (kind === "hazard") drawing.append(svg("path", { d: "M17 0l6 6-6 6-6-6z" }));
  else if (kind === "hazard-mark") drawing.append(svg("circle", { cx: 17, cy: 6, r: 5 }));
  else if (kind === "scrape") drawing.append(svg("path", { d: "M12 1l10 10m0-10l-10 10" }));
  else if (kind === "stall") drawing.append(svg("rect", { x: 12, y: 1, width: 10, height: 10 }));
  else drawing.append(svg("path", { d: "M1 6h32" }));
  return drawing;
}
