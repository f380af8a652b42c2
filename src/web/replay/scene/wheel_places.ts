// Where the wheels are, from the pose of the rover and the angles of its joints.
import { Quaternion, Vector3 } from "three";
import type { Quaternion as Attitude } from "../motion";
import type { RoverShape, Shape } from "../payload";

type Wheel = Extract<Shape, { kind: "wheel" }>;

export interface WheelPlace {
  center: Vector3;
  /** Unit vector along the axle, to the left. */
  axle: Vector3;
}

export interface RoverPose {
  x: number;
  y: number;
  z: number;
  attitude: Attitude;
  joints: Record<string, number>;
}

export class WheelPlaces {
  /** In the order of the links. */
  readonly wheels: { link: number; shape: Wheel }[] = [];
  private readonly links: { name: string; parent: number; pivot: Vector3; axis: Vector3 }[];

  constructor({ links }: RoverShape) {
    this.links = links.map(({ name, parent, pivot, axis }) => {
      return { name, parent, pivot: new Vector3(...pivot), axis: new Vector3(...axis).normalize() };
    });
    links.forEach(({ shapes }, link) => {
      for (const shape of shapes) if (shape.kind === "wheel") this.wheels.push({ link, shape });
    });
  }

  at({ x, y, z, attitude, joints }: RoverPose): WheelPlace[] {
    const turns: Quaternion[] = [];
    const places: Vector3[] = [];
    this.links.forEach(({ name, parent, pivot, axis }, i) => {
      if (i === 0) {
        turns.push(new Quaternion(attitude.x, attitude.y, attitude.z, attitude.w).normalize());
        places.push(new Vector3(x, y, z));
        return;
      }
      places.push(pivot.clone().applyQuaternion(turns[parent]!).add(places[parent]!));
      turns.push(turns[parent]!.clone().multiply(new Quaternion().setFromAxisAngle(axis, joints[name] ?? 0)));
    });
    return this.wheels.map(({ link, shape }) => ({
      center: new Vector3(...shape.center).applyQuaternion(turns[link]!).add(places[link]!),
      axle: new Vector3(0, 1, 0).applyQuaternion(turns[link]!),
    }));
  }
}
