// Geometries from lists of numbers, and colours for the corners of others.

import { BufferGeometry, type Color, Float32BufferAttribute } from "three";

interface Corners {
  /** Two numbers a corner. */
  uv?: number[];
  /** `channels` numbers a corner, linear light. */
  color?: number[];
  channels?: 3 | 4;
  /** Three corners each, which are lit as a whole; without them every three corners are one. */
  faces?: number[];
}

/** Corners by three numbers each. */
export function geometryOf(position: number[], { uv, color, channels = 3, faces }: Corners = {}): BufferGeometry {
  const geometry = new BufferGeometry().setAttribute("position", new Float32BufferAttribute(position, 3));
  if (uv) geometry.setAttribute("uv", new Float32BufferAttribute(uv, 2));
  if (color) geometry.setAttribute("color", new Float32BufferAttribute(color, channels));
  if (faces) geometry.setIndex(faces).computeVertexNormals();
  return geometry;
}

/** The same geometry with a colour for each corner, by its height. */
export function colouredByHeight(geometry: BufferGeometry, colourAt: (z: number) => Color): BufferGeometry {
  const position = geometry.getAttribute("position");
  const colours = Array.from({ length: position.count }, (_, i) => colourAt(position.getZ(i)).toArray()).flat();
  return geometry.setAttribute("color", new Float32BufferAttribute(colours, 3));
}
