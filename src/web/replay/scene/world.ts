// Which surroundings the picture has.
import type { World } from "../payload";

export type WorldKind = "mars" | "hall" | "field";

// Half way from the Moon's gravity (1.62) to that of Mars (3.72), and from there to Earth's, m/s2.
const MARS_FROM = 2.67;
const MARS_TO = 6.77;

/** Mars by its gravity; on Earth arenas stand in a hall, and open ground is a test field. */
export function worldKind({ gravity, arena }: World): WorldKind {
  if (gravity > MARS_FROM && gravity < MARS_TO) return "mars";
  return arena.kind === "open" ? "field" : "hall";
}
