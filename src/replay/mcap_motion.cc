// The rover's shape and motion as messages of a trace in MCAP (mcap_messages.h declares the
// function).
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "replay/mcap_messages.h"
#include "replay/motion.h"

namespace rockyard::replay {
namespace {

using core::JsonList;
using math::Vector3;

constexpr std::string_view kBelievedFrame = "believed_rover";
constexpr Colour kBodyColour{0.75, 0.75, 0.78};
constexpr Colour kPanelColour{0.1, 0.2, 0.45};
constexpr Colour kWheelColour{0.2, 0.2, 0.22};
constexpr Colour kArmColour{0.55, 0.55, 0.58};

// Adds a cylinder with flat ends from one point to the other.
void AddRod(const Vector3& from, const Vector3& to, double radius_m, const Colour& colour,
            SceneParts& parts) {
  const Vector3 along = to - from;
  const auto turn = Eigen::Quaterniond::FromTwoVectors(Vector3::UnitZ(), along);
  parts.cylinders.push_back(DrumJson(PlaceJson(0.5 * (from + to), turn),
                                     {2.0 * radius_m, 2.0 * radius_m, along.norm()}, colour));
}

void AddBall(const Vector3& center, double radius_m, SceneParts& parts) {
  parts.spheres.push_back(
      SolidJson(PlaceJson(center), Vector3::Constant(2.0 * radius_m), kArmColour));
}

void AddLinkShape(const ReplayShape& shape, SceneParts& parts) {
  const Vector3 half_width(0.0, 0.5 * shape.width_m, 0.0);
  switch (shape.kind) {
    case ShapeKind::kBox:
      parts.cubes.push_back(SolidJson(PlaceJson(shape.a_m), shape.b_m,
                                      shape.part == "panel" ? kPanelColour : kBodyColour));
      return;
    case ShapeKind::kWheel:
      return AddRod(shape.a_m - half_width, shape.a_m + half_width, shape.radius_m, kWheelColour,
                    parts);
    case ShapeKind::kCapsule:
      AddRod(shape.a_m, shape.b_m, shape.radius_m, kArmColour, parts);
      AddBall(shape.a_m, shape.radius_m, parts);
      return AddBall(shape.b_m, shape.radius_m, parts);
    case ShapeKind::kSphere:
      return AddBall(shape.a_m, shape.radius_m, parts);
  }
}

// Adds an entity for each link that has shapes, in the frame of the link.
void AddRover(std::span<const ReplayLink> links, double time_s, McapMessages& to) {
  std::vector<std::string> entities;
  for (std::size_t link = 0; link < links.size(); ++link) {
    SceneParts parts;
    for (const ReplayShape& shape : links[link].shapes) AddLinkShape(shape, parts);
    if (links[link].shapes.empty()) continue;
    const std::string frame = LinkFrame(links, link);
    entities.push_back(EntityJson(time_s, frame, frame, parts));
  }
  AddSceneUpdate("/scene/rover", time_s, entities, to);
}

// A place of a frame in its parent.
struct Placing {
  Vector3 p = Vector3::Zero();
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
};

Placing TruePlacing(const ReplayPose& pose) {
  const math::Transform& X_WR = pose.sample.posture.X_WR;
  return {X_WR.translation(), Eigen::Quaterniond(X_WR.linear())};
}

// The believed rover has no height of its own and stands as high as the true one.
Placing BelievedPlacing(const ReplayPose& pose) {
  const messages::PoseEstimate& believed = pose.sample.estimate;
  return {{believed.x_m, believed.y_m, pose.sample.posture.X_WR.translation().z()},
          Yaw(believed.heading_rad)};
}

std::string TransformsJson(std::span<const ReplayLink> links, const ReplayPose& pose) {
  std::vector<std::string> transforms;
  const auto add = [&](std::string_view parent, std::string_view child, const Placing& placing) {
    transforms.push_back(ObjectJson("timestamp", TimeJson(pose.sample.time_s), "parent_frame_id",
                                    core::QuoteJson(parent), "child_frame_id",
                                    core::QuoteJson(child), "translation", VectorJson(placing.p),
                                    "rotation", TurnJson(placing.turn)));
  };
  add(kWorldFrame, kRoverFrame, TruePlacing(pose));
  add(kWorldFrame, kBelievedFrame, BelievedPlacing(pose));
  for (std::size_t link = 1; link < links.size(); ++link) {
    const Eigen::AngleAxisd turn(pose.joint_rad[link - 1], links[link].axis.normalized());
    add(LinkFrame(links, static_cast<std::size_t>(links[link].parent)), LinkFrame(links, link),
        {links[link].pivot_P, Eigen::Quaterniond(turn)});
  }
  return ObjectJson("transforms", JsonList(transforms));
}

std::string JointsJson(std::span<const ReplayLink> links, const ReplayPose& pose) {
  std::size_t link = 0;
  const std::string joints = JsonList(pose.joint_rad, [&](double angle_rad) {
    return ObjectJson("name", core::QuoteJson(links[++link].name), "position", angle_rad);
  });
  return ObjectJson("timestamp", TimeJson(pose.sample.time_s), "joints", joints);
}

}  // namespace

// Transforms are most of it, and players interpolate them: those of the moments that the page of a
// replay has are enough.
void AddMotionMessages(const ReplayData& data, McapMessages& to) {
  if (data.poses.empty()) return;
  AddRover(data.links, data.poses.front().sample.time_s, to);
  for (const std::size_t i : ThinMotion(data.poses).kept) {
    const ReplayPose& pose = data.poses[i];
    to.push_back(
        {"/tf", "foxglove.FrameTransforms", pose.sample.time_s, TransformsJson(data.links, pose)});
  }
  for (const ReplayPose& pose : data.poses) {
    const truth::TraceSample& sample = pose.sample;
    const auto add = [&](const char* topic, const char* schema, std::string json) {
      to.push_back({topic, schema, sample.time_s, std::move(json)});
    };
    const std::string time = TimeJson(sample.time_s);
    const auto place = [&](const Placing& placing) {
      return ObjectJson("timestamp", time, "frame_id", core::QuoteJson(kWorldFrame), "pose",
                        PlaceJson(placing.p, placing.turn));
    };
    add("/pose/true", "foxglove.PoseInFrame", place(TruePlacing(pose)));
    add("/pose/believed", "foxglove.PoseInFrame", place(BelievedPlacing(pose)));
    add("/joints", "foxglove.JointStates", JointsJson(data.links, pose));
    add("/state", "rockyard.State",
        ObjectJson("timestamp", time, "activity", core::QuoteJson(sample.activity), "tilt_rad",
                   sample.tilt_rad));
  }
}

}  // namespace rockyard::replay
