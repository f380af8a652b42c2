// What is written where: topics with their schemas, and a message on its way into the file.
import * as foxglove from "@foxglove/schemas/jsonschema";

const TIME = {
  type: "object",
  title: "time",
  properties: { sec: { type: "integer", minimum: 0 }, nsec: { type: "integer", minimum: 0, maximum: 999_999_999 } },
  required: ["sec", "nsec"],
};
const NUMBER = { type: "number" };

/** What has no counterpart among Foxglove's schemas. */
const STATE = {
  title: "rockyard.State",
  description: "What the rover does, and its tilt",
  type: "object",
  properties: { timestamp: TIME, activity: { type: "string", description: "Of the stretch that ends here" }, tilt_rad: NUMBER },
  required: ["timestamp", "activity", "tilt_rad"],
};

const VOTES = {
  title: "rockyard.Votes",
  description: "One decision of a map-based navigator; votes from 0 to 255, curvature 1/m, positive to the left",
  type: "object",
  properties: {
    timestamp: TIME,
    step: { type: "integer" },
    behind: { type: "boolean" },
    votes: {
      type: "array",
      items: {
        type: "object",
        properties: {
          kind: { type: "string" },
          curvature: NUMBER,
          hazard: NUMBER,
          certainty: NUMBER,
          waypoint: NUMBER,
          merged: NUMBER,
          chosen: { type: "boolean" },
        },
        required: ["kind", "curvature", "hazard", "certainty", "waypoint", "merged", "chosen"],
      },
    },
  },
  required: ["timestamp", "step", "behind", "votes"],
};

/** A player that jumps to a time shows the last message of each topic: each is whole by itself. */
export const TOPICS = {
  "/tf": foxglove.FrameTransforms,
  "/pose/true": foxglove.PoseInFrame,
  "/pose/believed": foxglove.PoseInFrame,
  "/joints": foxglove.JointStates,
  "/state": STATE,
  "/scene/course": foxglove.SceneUpdate,
  "/scene/rocks": foxglove.SceneUpdate,
  "/scene/pushed_rocks": foxglove.SceneUpdate,
  "/scene/rover": foxglove.SceneUpdate,
  "/scene/paths": foxglove.SceneUpdate,
  "/scene/overlay": foxglove.SceneUpdate,
  "/scan": foxglove.PointCloud,
  "/look": foxglove.PointCloud,
  "/map": foxglove.Grid,
  "/votes": VOTES,
  "/events": foxglove.Log,
};

/** Of each grid that the navigator shows, by its name. */
const OVERLAY_GRID = "/overlay/";

export type Topic = keyof typeof TOPICS | `${typeof OVERLAY_GRID}${string}`;

export const gridTopic = (name: string): Topic => `${OVERLAY_GRID}${name}`;

export const schemaOf = (topic: Topic): (typeof TOPICS)[keyof typeof TOPICS] =>
  topic in TOPICS ? TOPICS[topic as keyof typeof TOPICS] : foxglove.Grid;

export interface Message {
  topic: Topic;
  /** Simulated time, s. */
  t: number;
  /** Bytes in it are written in base64. */
  content: object;
}
