// The shapes of the rover's links as cubes, cylinders and spheres in the links' frames.
import type { CubePrimitive, CylinderPrimitive, SpherePrimitive, Vector3 } from "@foxglove/schemas";
import type { ReplayPayload, Shape } from "../replay/payload";
import { alongZ, colour, fromList, pose, vector } from "./geometry";
import { linkFrame } from "./motion_messages";

const BODY = colour(0.75, 0.75, 0.78);
const PANEL = colour(0.1, 0.2, 0.45);
const WHEEL = colour(0.2, 0.2, 0.22);
const ARM = colour(0.55, 0.55, 0.58);

interface Parts {
  cubes: CubePrimitive[];
  spheres: SpherePrimitive[];
  cylinders: CylinderPrimitive[];
}

function ball(center: Vector3, radius: number): SpherePrimitive {
  return { pose: pose(center), size: vector(2 * radius, 2 * radius, 2 * radius), color: ARM };
}

/** From one end to the other, with flat ends. */
function cylinder(from: Vector3, to: Vector3, radius: number, color: typeof BODY): CylinderPrimitive {
  const along = vector(to.x - from.x, to.y - from.y, to.z - from.z);
  const middle = vector((from.x + to.x) / 2, (from.y + to.y) / 2, (from.z + to.z) / 2);
  return {
    pose: pose(middle, alongZ(along)),
    size: vector(2 * radius, 2 * radius, Math.hypot(along.x, along.y, along.z)),
    bottom_scale: 1,
    top_scale: 1,
    color,
  };
}

function add({ cubes, spheres, cylinders }: Parts, shape: Shape): void {
  switch (shape.kind) {
    case "box":
      cubes.push({
        pose: pose(fromList(shape.center)),
        size: fromList(shape.size),
        color: shape.part.includes("panel") ? PANEL : BODY,
      });
      return;
    case "sphere":
      spheres.push(ball(fromList(shape.center), shape.radius));
      return;
    case "wheel": {
      const { x, y, z } = fromList(shape.center);
      const half = shape.width / 2;
      cylinders.push(cylinder(vector(x, y - half, z), vector(x, y + half, z), shape.radius, WHEEL));
      return;
    }
    case "capsule": {
      const from = fromList(shape.from);
      const to = fromList(shape.to);
      cylinders.push(cylinder(from, to, shape.radius, ARM));
      spheres.push(ball(from, shape.radius), ball(to, shape.radius));
    }
  }
}

/** Of each link that has shapes. */
export function roverParts(rover: ReplayPayload["rover"]): (Parts & { frame: string })[] {
  return rover.links.flatMap(({ shapes }, i) => {
    const parts: Parts = { cubes: [], spheres: [], cylinders: [] };
    for (const shape of shapes) add(parts, shape);
    return shapes.length > 0 ? [{ frame: linkFrame(rover, i), ...parts }] : [];
  });
}
