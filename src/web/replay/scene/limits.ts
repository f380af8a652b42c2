// What a picture may cost, so that a phone and a browser that draws in software keep up. Shadows count:
// what casts one is drawn twice.

/** Triangles of rocks without their shadows: with 5000 in sight, 20 for each and hundreds for the nearest ones. */
export const MOST_ROCK_TRIANGLES = 120_000;
/** Of the soil: twice the heights that a page holds. */
export const MOST_SOIL_TRIANGLES = 80_000;
/** Of wheel tracks: two a piece. */
export const MOST_TRACK_TRIANGLES = 24_000;
/** Pieces of the lines that a navigator shows; where there are more, they are one pixel wide. */
export const MOST_OVERLAY_PIECES = 2000;
/** Squares along a side of the grid that it shows. */
export const MOST_OVERLAY_SQUARES = 60;
/** Of all that is drawn for one picture: rocks and their shadows, soil, tracks, and as much as half of the rocks for all else. */
export const MOST_TRIANGLES = 400_000;
/** Calls that a picture sends to the graphics, its shadows included. */
export const MOST_DRAW_CALLS = 250;

/** How deep the rough surface of a rock may lie within the true one, as a share of the distance from its centre. */
export const ROUGH_DEPTH = 0.12;
