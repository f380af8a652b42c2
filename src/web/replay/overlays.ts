// What navigators show of themselves: its names and how each is told from others, where it lies, and
// pictures of its grids. The scene, the plan and their key draw by it.
import { ramp } from "./palette";
import type { Overlay, OverlayGrid, Overlays } from "./payload";
import { corrected } from "./scene/arcs";

/** How the lines of one name look: a colour of the style sheet, and a dash. */
export interface OverlayStyle {
  colour: `overlay-${1 | 2 | 3 | 4 | 5 | 6}`;
  /** Lengths of dash and gap in widths of the line; null for solid ones. */
  dash: [number, number] | null;
}

const COLOURS = ["overlay-1", "overlay-2", "overlay-3", "overlay-4", "overlay-5", "overlay-6"] as const;
// Four of them and six colours: twelve names differ.
const DASHES = [null, [3.5, 2], [1.2, 1.6], [7, 2]] as const;

export function overlayStyle(slot: number): OverlayStyle {
  const dash = DASHES[slot % DASHES.length]!;
  return { colour: COLOURS[slot % COLOURS.length]!, dash: dash && [...dash] };
}

const namesOf = (things: { name: string }[]): string[] => [...new Set(things.map(({ name }) => name))];

/** The names of all lines, in the order in which they appear: the place is the slot of the style. */
export const lineNames = (overlays: Overlays | null): string[] => namesOf((overlays?.shown ?? []).flatMap(({ lines }) => lines));

export const gridNames = (overlays: Overlays | null): string[] => namesOf((overlays?.shown ?? []).flatMap(({ grids }) => grids));

/** From the world of an overlay to the one that is drawn. */
export type Placing = (x: number, y: number) => [number, number];

/** An overlay lies in the believed world; `atTruth` moves it by the error that the rover had at its moment. */
export const placingOf = ({ believed, pose }: Overlay, atTruth: boolean): Placing =>
  atTruth ? (x, y) => corrected(believed, pose, x, y) : (x, y) => [x, y];

// What any graphics can hold; larger grids lose rows and columns.
const MOST_PIXELS = 2048;
const FULL_VALUE = 255;
// The ground is seen through it.
const ALPHA = 165;

export interface GridPicture {
  /** A pixel a cell, the row of the lowest y first; unknown cells are clear. */
  canvas: HTMLCanvasElement;
  /** What it covers, m. */
  width: number;
  height: number;
}

const pictures = new WeakMap<OverlayGrid, GridPicture | null>();

/** Free cells are yellow, blocked ones dark. Null where there is no cell. */
export function gridPicture(grid: OverlayGrid): GridPicture | null {
  const known = pictures.get(grid);
  if (known !== undefined) return known;
  const made = paint(grid);
  pictures.set(grid, made);
  return made;
}

function paint({ nx, ny, step, values }: OverlayGrid): GridPicture | null {
  if (nx < 1 || ny < 1) return null;
  const every = Math.ceil(Math.max(nx, ny) / MOST_PIXELS);
  const canvas = document.createElement("canvas");
  canvas.width = Math.ceil(nx / every);
  canvas.height = Math.ceil(ny / every);
  const context = canvas.getContext("2d")!;
  const image = context.createImageData(canvas.width, canvas.height);
  for (let i = 0; i < canvas.width * canvas.height; ++i) {
    const cell = Math.floor(i / canvas.width) * every * nx + (i % canvas.width) * every;
    const value = values[cell] ?? -1;
    if (value >= 0) image.data.set([...ramp(1 - value / FULL_VALUE), ALPHA], 4 * i);
  }
  context.putImageData(image, 0, 0);
  return { canvas, width: canvas.width * every * step, height: canvas.height * every * step };
}
