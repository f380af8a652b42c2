// The rover as a tree of links: what turns about what, and which parts each link carries. Replays
// draw it and URDF files describe it; both show the names. No record depends on it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "math/pose.h"
#include "rover/rover_geometry_params.h"
#include "truth/trace.h"

namespace rockyard::rover {

// How a link turns on its parent. kFixed: the chassis, which has no parent.
enum class LinkJoint { kFixed, kRocker, kBogie, kSteering, kWheel };

// One link: what turns as one piece about a joint on its parent.
struct Link {
  std::string name;  // "chassis", "left_rocker", "left_bogie", "left_front_wheel", ...
  LinkJoint joint = LinkJoint::kFixed;
  std::size_t index = 0;      // side of a rocker or bogie, wheel of a knuckle or wheel
  int parent = -1;            // index of the link that carries it; -1: none
  std::optional<int> body{};  // whose parts it carries, as in multibody.h; a knuckle carries none
  math::Vector3 pivot_P = math::Vector3::Zero();  // from the origin of the parent's frame
  math::Vector3 axis = math::Vector3::UnitY();    // unit, in both frames
};

// Returns the chassis first, then for each side rocker, bogie and the wheels from front to rear, a
// knuckle before each wheel that steers; parents come before children. All frames are parallel to R
// while every angle is 0; the frame of the chassis is R.
std::vector<Link> MakeLinks(const RoverGeometryParams& params);

// Returns the angle of the link's joint in a posture, rad; 0 for the chassis.
double JointAngle(const Link& link, const truth::RoverPosture& posture);

}  // namespace rockyard::rover
