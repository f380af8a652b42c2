// What the picture shows, as switches that are its key as well.

import { checkbox, el, labelled, select, svg } from "../../shared/dom";
import { number } from "../../shared/format";
import { gridNames, lineNames, overlayStyle } from "../overlays";
import { rampCss } from "../palette";
import type { ReplayPayload } from "../payload";
import { mirrorLines, toldElsewhere } from "../scene/course";
import { WALL_HEIGHT_M } from "../scene/ground";
import { MOST_DRAW_CALLS, MOST_TRIANGLES, ROUGH_DEPTH } from "../scene/limits";
import { worldKind, type WorldKind } from "../scene/world";
import type { Layers, MapKind } from "../view";

const MAPS: [MapKind, string][] = [["goodness", "goodness"], ["certainty", "certainty"], ["elevation", "elevation"], ["off", "off"]];

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

type Add = (name: Exclude<keyof Layers, "map" | "overlayGrid">, label: string, mark?: string | null) => void;

/** What the scene in three dimensions shows at first, beside what the drive tells. */
export const SCENE_LAYERS = { tracks: true, light: true, cameras: false, trueShapes: false, plain: false } as const;

/** `solid`: whether the picture has three dimensions. */
export function layersPanel(payload: ReplayPayload, layers: Layers, solid: boolean, changed: () => void): HTMLElement {
  const panel = el("section", { class: "panel layers", "aria-label": "What is shown" }, el("h2", {}, "Shown"));
  const add: Add = (name, label, mark = null) => {
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
  if (payload.steps.length > 0) addMap(panel, payload, layers, add, changed);
  if (payload.overlays) addOverlays(panel, payload, layers, add, changed);
  if (payload.events.some(({ kind }) => isMarked(kind))) {
    add("marks", "Where it happened");
    const key = el("p", { class: "key" });
    for (const { kind, mark, name } of MARKS) {
      if (payload.events.some((event) => event.kind === kind)) key.append(swatch(mark), name);
    }
    panel.append(key);
  }
  add("grid", "Grid in metres");
  if (solid) addSolid(payload, add);
  if (toldElsewhere(payload.course)) panel.append(el("p", { class: "key" }, "Designated goal", swatch("told")));
  if (mirrorLines(payload).length > 0) panel.append(el("p", { class: "key" }, swatch("mirror"), mirrorWords(payload)));
  if (solid) panel.append(aboutPicture(payload));
  return panel;
}

function addSolid({ sensor }: ReplayPayload, add: Add): void {
  add("tracks", "Wheel tracks");
  if (sensor.lasers.length > 0) add("light", "Light planes while it scans", "laser");
  if (sensor.cameras.length > 0) add("cameras", "What the cameras see", "camera");
  add("trueShapes", "True shapes of rocks");
  add("plain", "Plain: no textures, coarser shadows");
}

function mirrorWords({ course }: ReplayPayload): string {
  const meaning = "Mirror line: the course is mirrored here; rocks beyond it are images of those before it. ";
  return meaning + (course.mirror_lines.length > 0 ? "Operators turn the rover back there." : "The rover drives on.");
}

/** Which world it is, and what of the picture the simulator does not know. */
function aboutPicture({ world, course }: ReplayPayload): HTMLElement {
  const degrees = (angle: number): string => `${Math.round((angle * 180) / Math.PI)}°`;
  const { elevation, azimuth } = world.sun;
  const place: Record<WorldKind, string> = { mars: "Mars", hall: "An arena in a hall on Earth", field: "Open ground on Earth" };
  const kind = worldKind(world);
  const light = kind === "hall" ? "A lamp" : "The sun";
  const around = kind === "hall" ? "the hall and the rim of the arena" : "the sky and the ground beyond the terrain";
  return el("details", { class: "about-picture" },
    el("summary", {}, "About the picture"),
    el("p", {}, `${place[kind]}: gravity is ${world.gravity} m/s². ${light} stands ${degrees(elevation)} above the horizon, ${degrees(azimuth)} from x to the left (sensors.sun).`),
    el("p", {}, `Drawn only, and nothing that the rover meets: ${around}, the grain of the soil, wheel tracks, and the rough surface of rocks. It lies within the true one, by at most ${Math.round(100 * ROUGH_DEPTH)} % of the distance from a rock's centre.`),
    course.walls.length > 0 ? el("p", {}, `Walls are drawn ${100 * WALL_HEIGHT_M} cm high; those of the simulator have no upper edge.`) : null,
    el("p", {}, `All light planes are drawn at once. A picture has at most ${number(MOST_TRIANGLES)} triangles and ${MOST_DRAW_CALLS} draw calls with its shadows: of many rocks those that look small have fewer faces.`));
}

function addMap(panel: HTMLElement, { steps, overlays }: ReplayPayload, layers: Layers, add: Add, changed: () => void): void {
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
  const paths = steps.some(({ splines }) => splines !== null) ? "Splines" : "Arcs";
  const moved = overlays ? `Map, ${paths.toLowerCase()} and what the navigator shows` : `Map and ${paths.toLowerCase()}`;
  add("mapAtTruth", `${moved} at the true pose`);
  add("votes", `${paths}: wide and yellow is a high vote`);
  add("scan", "Some of the points seen");
}

// A key of more is no key.
const MOST_NAMES = 12;

function addOverlays(panel: HTMLElement, { overlays, steps }: ReplayPayload, layers: Layers, add: Add, changed: () => void): void {
  const { every, shown } = overlays!;
  if (shown.length === 0) {
    panel.append(el("p", { class: "key" }, "What the navigator shows is too large for a page; rockyard trace --npz has it."));
    return;
  }
  add("overlay", "What the navigator shows");
  const lines = lineNames(overlays);
  const key = el("p", { class: "key overlay-lines" });
  lines.slice(0, MOST_NAMES).forEach((name, slot) => key.append(el("span", {}, overlaySwatch(slot), name || "a line")));
  if (lines.length > MOST_NAMES) key.append(`and ${number(lines.length - MOST_NAMES)} more`);
  if (lines.length > 0) panel.append(key);
  const grids = gridNames(overlays);
  if (grids.length > 0) {
    // By their places: any text may be a name.
    const options = grids.map((name, i): [string, string] => [`${i}`, name || "a grid"]);
    const list = select([...options, ["off", "off"]], layers.overlayGrid === null ? "off" : `${grids.indexOf(layers.overlayGrid)}`);
    const ramp = el("p", { class: "ramp", hidden: layers.overlayGrid === null }, el("span", {}, "1, blocked"), rampBar(), el("span", {}, "0, free"));
    list.addEventListener("change", () => {
      layers.overlayGrid = grids[Number(list.value)] ?? null;
      ramp.hidden = layers.overlayGrid === null;
      changed();
    });
    panel.append(labelled("Its grid", list), ramp);
  }
  if (steps.length === 0) add("mapAtTruth", "At the true pose, not the believed one");
  if (every > 1) panel.append(el("p", { class: "key" }, `To keep the page small, it has one overlay out of ${every}.`));
}

function overlaySwatch(slot: number): SVGSVGElement {
  const { colour, dash } = overlayStyle(slot);
  const dashes = dash?.map((length) => 3 * length).join(" ") ?? null;
  return svg("svg", { viewBox: "0 0 34 12", class: "swatch", "aria-hidden": "true" },
    svg("path", { d: "M1 6h32", style: `stroke: var(--scene-${colour})`, "stroke-dasharray": dashes }));
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
