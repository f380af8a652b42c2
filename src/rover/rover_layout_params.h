// Where the parts of the rover are, in frame R on level ground, and how heavy each body is. Both
// fidelities and URDF files build on it; calibrations start from its drive geometry, and sensors
// and pictures take the outline of the rover from it.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <utility>
#include <vector>

#include "math/pose.h"
#include "messages/calibration.h"
#include "messages/wheels.h"
#include "rover/rover_geometry_params.h"
#include "rover/rover_params.h"

namespace rockyard::rover {

// The order of arrays with one entry for each side.
enum class Side : std::size_t { kLeft, kRight };

// Wheel centres, by messages::Wheel, and pivots, by Side, in R, m.
struct RoverGeometry {
  messages::PerWheel<math::Vector3> wheel_R;
  messages::PerWheel<bool> steered{};
  messages::PerWheel<bool> on_bogie{};  // otherwise on the rocker
  std::array<math::Vector3, 2> rocker_pivot_R;
  std::array<math::Vector3, 2> bogie_pivot_R;
};

// Spreads the wheels over the wheelbase and puts the bogies at the end that the parameters name.
RoverGeometry MakeRoverGeometry(const RoverGeometryParams& params);

// Returns the true drive geometry. On-board code gets a copy of it that may be wrong, and only from
// trial/sight/onboard_calibration.h.
messages::DriveCalibration MakeDriveCalibration(const RoverParams& params);

// Returns the sinkage up to which the law of the rut holds, m: a sixth of the wheel's diameter
// (Wong 2008 sec. 2.5).
inline double LargestLawfulSinkage(const RoverGeometryParams& params) {
  return params.wheel_radius_m / 3.0;
}

// A closed outline seen from above: corners (x, y) in R, m, counter-clockwise.
using Outline = std::vector<std::pair<double, double>>;
// Returns the outline of the overall length and width.
Outline BodyOutline(const RoverGeometryParams& params);

// Returns the chassis from belly to panel and, on top of it, the solar panel, both as boxes in
// frame R, m. The thickness of the panel must equal that of MakeParts (part_shapes.cc).
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

// Mass, centre of mass and principal moments of inertia of one body.
struct BodyMass {
  double mass_kg = 0.0;
  // The centre of mass in the frame of the body, m.
  math::Vector3 com_B = math::Vector3::Zero();
  // The moments of inertia about the centre of mass, along the axes of the body's frame.
  math::Vector3 inertia_kg_m2 = math::Vector3::Zero();
};

// The masses of all bodies. The chassis is given in R; rocker, bogie and wheel are given in frames
// at their joints, with axes parallel to R. The chassis is a solid box from its underside to the
// top of the panel, about the centre of mass that the parameters give; rockers and bogies are flat
// bars as long as half and a quarter of the rover; wheels are solid cylinders.
struct RoverMasses {
  BodyMass chassis;
  BodyMass rocker;
  BodyMass bogie;
  BodyMass wheel;
};

// Makes the masses. The chassis has the mass that wheels, rockers and bogies leave of the total, as
// in Linkage (quasi_static/linkage.cc), which must agree. Must stay: rockers, bogies and wheels
// have their centres of mass at their joints, and wheels are alike about both axes across the axle;
// the mass matrix and its inverse are made for that (joint_space_inertia.cc).
RoverMasses MakeRoverMasses(const RoverParams& params);

}  // namespace rockyard::rover
