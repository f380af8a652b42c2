// The rocker-bogie in a robot: which joints are wheels, steering, bogies and rockers, and what each
// of rockyard's eleven bodies carries. ReadUrdf takes every number from where this says.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "math/pose.h"
#include "messages/wheels.h"
#include "rover/rover_geometry_params.h"
#include "rover/urdf_reader/urdf_bodies.h"
#include "rover/urdf_reader/urdf_model.h"

namespace rockyard::rover {

// A wheel: the joint that turns it, the one that steers it, and the cylinder of its rim.
struct UrdfWheel {
  std::size_t joint = 0;
  std::optional<std::size_t> steering{};
  UrdfRim rim{};
};

struct UrdfSkeleton {
  std::vector<math::Transform> X_0L;  // of every link, while all joints are at zero
  // The origin of R in the frame of the root, whose axes R has: on the ground under the middle
  // between the outer axles.
  math::Vector3 p_0R = math::Vector3::Zero();
  std::vector<int> body;  // of every link: the body that carries it, as numbered in multibody.h
  messages::PerWheel<UrdfWheel> wheels;
  std::array<std::size_t, 2> bogie{};                  // joints, by Side
  std::array<std::optional<std::size_t>, 2> rocker{};  // none: the rocker is fixed to the chassis
  std::size_t chassis = 0;                             // link
  BogieEnd bogie_end = BogieEnd::kFront;
  SteeredWheels steered = SteeredWheels::kCorners;

  // Returns the place of a joint in R, m.
  math::Vector3 p_RJ(const UrdfModel& model, std::size_t joint) const {
    return X_0L[model.joints[joint].child].translation() - p_0R;
  }
  // Returns the axis of a joint, in the frame of the root, which is that of R.
  math::Vector3 axis_R(const UrdfModel& model, std::size_t joint) const {
    return X_0L[model.joints[joint].child].linear() * model.joints[joint].axis_C;
  }
};

// Finds it. Wheels are continuous joints about y whose links have a cylinder about the same axis
// and carry nothing that moves; a joint about z above a wheel steers it; two wheels of a side, one
// of them the middle one, turn with a bogie about y, the third with the rocker that carries the
// bogie. What other joints, movable or not, carry counts with the body that carries it. Throws
// core::UserError with all that rockyard's rovers have not.
UrdfSkeleton FindSkeleton(const UrdfModel& model, UrdfFindings& findings);

}  // namespace rockyard::rover
