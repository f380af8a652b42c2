// JSON schemas of the messages of a trace as MCAP (trace_mcap.h): those by which Foxglove and
// others know how to draw a message, and ours for what has no counterpart there.
#pragma once

#include <string>
#include <string_view>

namespace rockyard::replay {

// Returns the schema of this name: "foxglove.FrameTransforms", "foxglove.PoseInFrame",
// "foxglove.JointStates", "foxglove.SceneUpdate", "foxglove.PointCloud", "foxglove.Grid",
// "foxglove.CompressedImage", "foxglove.Log", "rockyard.State" or "rockyard.Votes". Must agree:
// those of Foxglove, member by member (npm package @foxglove/schemas), but for their descriptions.
std::string McapSchema(std::string_view name);

}  // namespace rockyard::replay
