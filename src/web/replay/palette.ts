// Colours of the pictures, from the style sheet, so that light, dark and print agree with the page.
import { resolvedColour } from "../shared/theme";
import type { WorldKind } from "./scene/world";

// Of these every world has its own.
const WORLD_NAMES = ["sky", "zenith", "ground", "rock", "around"] as const;

const NAMES = [
  "grid",
  "wall",
  "mirror",
  "true-path",
  "believed-path",
  "goal",
  "told-goal",
  "hazard",
  "scrape",
  "stall",
  "clear",
  "body",
  "panel",
  "wheel",
  "arm",
  "label",
  "chosen",
  "laser",
  "camera",
  "track",
  "overlay-1",
  "overlay-2",
  "overlay-3",
  "overlay-4",
  "overlay-5",
  "overlay-6",
  "overlay-edge",
] as const;

export type Palette = Record<(typeof NAMES)[number] | (typeof WORLD_NAMES)[number], string>;

export function readPalette(world: WorldKind): Palette {
  const palette = {} as Palette;
  for (const name of WORLD_NAMES) palette[name] = resolvedColour(`--scene-${world}-${name}`);
  for (const name of NAMES) palette[name] = resolvedColour(`--scene-${name}`);
  return palette;
}

// The ramp of the drawings that the program writes (report/xml_text.cc): its luminance grows all
// the way, so colour-blind readers and grey print keep the order.
const RAMP: readonly (readonly [number, number, number])[] = [
  [68, 1, 84],
  [59, 82, 139],
  [33, 145, 140],
  [94, 201, 98],
  [253, 231, 37],
];

/** Red, green, blue from 0 to 255 for a share from 0 (dark) to 1 (yellow). */
export function ramp(share: number): [number, number, number] {
  const place = Math.min(1, Math.max(0, share)) * (RAMP.length - 1);
  const below = Math.min(Math.floor(place), RAMP.length - 2);
  const rest = place - below;
  const from = RAMP[below]!;
  const to = RAMP[below + 1]!;
  return [0, 1, 2].map((i) => from[i]! + rest * (to[i]! - from[i]!)) as [number, number, number];
}

export const rampCss = (share: number): string => `rgb(${ramp(share).map(Math.round).join(" ")})`;
