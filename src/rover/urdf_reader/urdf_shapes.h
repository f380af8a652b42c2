// The shapes of a robot as they stand on rockyard's eleven bodies. Arms and chassis are read of
// them.
#pragma once

#include <vector>

#include "math/pose.h"
#include "rover/urdf_reader/urdf_model.h"
#include "rover/urdf_reader/urdf_skeleton.h"

namespace rockyard::rover {

struct UrdfPlacedShape {
  const UrdfShape* shape = nullptr;  // in the model
  int body = 0;                      // as numbered in multibody.h
  math::Transform X_RS = math::Transform::Identity();
};

// Returns the shapes of all bodies in the order of the file: of a body that has collisions these,
// of another one what is to be seen.
std::vector<UrdfPlacedShape> PlacedShapes(const UrdfModel& model, const UrdfSkeleton& skeleton);

}  // namespace rockyard::rover
