// Where the rover and its links are, where it believes to be, and what it does.
import type { FrameTransform, FrameTransforms, JointStates, PoseInFrame } from "@foxglove/schemas";
import type { ReplayPayload } from "../replay/payload";
import { fromList, pose, timestamp, turnAbout, vector, yaw } from "./geometry";
import type { Message } from "./topics";

export const WORLD = "world";
/** Frame R of the true rover. */
const ROVER = "rover";
const BELIEVED_ROVER = "believed_rover";

/** Frame of a link of the true rover; link 0, the chassis, is R itself. */
export const linkFrame = ({ links }: ReplayPayload["rover"], index: number): string =>
  index <= 0 ? ROVER : `${ROVER}/${links[index]!.name}`;

type Place = Pick<FrameTransform, "translation" | "rotation">;

/** Of frame R in the world; the believed rover has no height of its own and stands as high as the true one. */
function placesAt({ motion }: ReplayPayload, i: number): { real: Place; believed: Place } {
  const { x, y, z, qx, qy, qz, qw, believed_x: bx, believed_y: by, believed_heading: heading } = motion;
  return {
    real: { translation: vector(x[i]!, y[i]!, z[i]!), rotation: { x: qx[i]!, y: qy[i]!, z: qz[i]!, w: qw[i]! } },
    believed: { translation: vector(bx[i]!, by[i]!, z[i]!), rotation: yaw(heading[i]!) },
  };
}

function transformsAt(replay: ReplayPayload, i: number): FrameTransforms {
  const { rover, motion } = replay;
  const { real, believed } = placesAt(replay, i);
  const stamp = timestamp(motion.t[i]!);
  const transform = (parent: string, child: string, place: Place): FrameTransform => ({
    timestamp: stamp,
    parent_frame_id: parent,
    child_frame_id: child,
    ...place,
  });
  const links = rover.links.slice(1).map(({ name, parent, pivot, axis }, k) =>
    transform(linkFrame(rover, parent), linkFrame(rover, k + 1), {
      translation: fromList(pivot),
      rotation: turnAbout(fromList(axis), motion.joints[name]?.[i] ?? 0),
    }),
  );
  return { transforms: [transform(WORLD, ROVER, real), transform(WORLD, BELIEVED_ROVER, believed), ...links] };
}

/** Five messages for each moment. */
export function motionMessages(replay: ReplayPayload): Message[] {
  const { motion } = replay;
  return motion.t.flatMap((t, i): Message[] => {
    const { real, believed } = placesAt(replay, i);
    const inWorld = ({ translation, rotation }: Place): PoseInFrame => ({
      timestamp: timestamp(t),
      frame_id: WORLD,
      pose: pose(translation, rotation),
    });
    const state = { timestamp: timestamp(t), activity: motion.activity_names[motion.activity[i]!] ?? "", tilt_rad: motion.tilt[i]! };
    const joints: JointStates = {
      timestamp: timestamp(t),
      joints: Object.entries(motion.joints).map(([name, angles]) => ({ name, position: angles[i]! })),
    };
    return [
      { topic: "/tf", t, content: transformsAt(replay, i) },
      { topic: "/pose/true", t, content: inWorld(real) },
      { topic: "/pose/believed", t, content: inWorld(believed) },
      { topic: "/joints", t, content: joints },
      { topic: "/state", t, content: state },
    ];
  });
}
