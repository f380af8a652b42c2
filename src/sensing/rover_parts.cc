#include "sensing/rover_parts.h"

#include <utility>
#include <vector>

#include "rover/rover_layout_params.h"

namespace rockyard::sensing {

rendering::RoverBody MakeRoverBody(const rover::RoverGeometryParams& params) {
  std::vector<rendering::RoverBody::Box> boxes;
  for (const auto& box_R : rover::BodyBoxes(params)) boxes.push_back({box_R.min(), box_R.max()});
  std::vector<rendering::RoverBody::Wheel> wheels;
  for (const math::Vector3& wheel_R : rover::MakeRoverGeometry(params).wheel_R) {
    wheels.push_back({wheel_R, params.wheel_radius_m, 0.5 * params.wheel_width_m});
  }
  return {std::move(boxes), std::move(wheels)};
}

}  // namespace rockyard::sensing
