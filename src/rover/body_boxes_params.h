// Chassis and solar panel as boxes, for whatever must not be in their way.
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "rover/rover_geometry_params.h"

namespace rockyard::rover {

// Returns the chassis from belly to panel and, on top of it, the solar panel, both as boxes in
// frame R, m. The panel is 25 mm thick, as in the rover's collision shapes.
inline std::array<Eigen::AlignedBox3d, 2> BodyBoxes(const RoverGeometryParams& params) {
  constexpr double kPanelThickness_m = 0.025;
  const double panel_z_m = params.height_m - kPanelThickness_m;
  const Eigen::Vector3d belly(0.5 * params.belly_length_m, 0.5 * params.belly_width_m, 0.0);
  const Eigen::Vector3d panel(0.5 * params.length_m, 0.5 * params.width_m, 0.0);
  const auto at_height = [](double z_m) { return Eigen::Vector3d(0.0, 0.0, z_m); };
  return {Eigen::AlignedBox3d(at_height(params.belly_clearance_m) - belly,
                              at_height(panel_z_m) + belly),
          Eigen::AlignedBox3d(at_height(panel_z_m) - panel, at_height(params.height_m) + panel)};
}

}  // namespace rockyard::rover
