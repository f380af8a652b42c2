// Where the parts of the rover are, in frame R on level ground, and how heavy each body is.
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

enum class Side : std::size_t { kLeft, kRight };

// Centres and pivots in R, m, by messages::Wheel and by Side.
struct RoverGeometry {
  messages::PerWheel<math::Vector3> wheel_R;  // wheel centres, m
  messages::PerWheel<bool> steered{};
  messages::PerWheel<bool> on_bogie{};          // otherwise on the rocker
  std::array<math::Vector3, 2> rocker_pivot_R;  // by Side
  std::array<math::Vector3, 2> bogie_pivot_R;
};

// Spreads the wheels over the wheelbase and puts the bogies at the end that the parameters name.
RoverGeometry MakeRoverGeometry(const RoverGeometryParams& params);

// Returns the true drive geometry. On-board code gets a copy that may be wrong, from
// trial/eyes/onboard_calibration.h alone.
messages::DriveCalibration MakeDriveCalibration(const RoverParams& params);

// Returns the sinkage up to which the law of the rut holds, m: a sixth of the wheel's diameter
// (Wong 2008 sec. 2.5).
inline double LargestLawfulSinkage(const RoverGeometryParams& params) {
  return params.wheel_radius_m / 3.0;
}

// A closed outline seen from above: corners (x, y) in R, m, counter-clockwise.
using Outline = std::vector<std::pair<double, double>>;
Outline BodyOutline(const RoverGeometryParams& params);  // overall length by width

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

// Masses and moments of inertia of the rover's bodies, as the simulation has them.

// Mass, centre of mass and principal moments of inertia of one body.
struct BodyMass {
  double mass_kg = 0.0;
  // The centre of mass in the frame of the body, m.
  math::Vector3 com_B = math::Vector3::Zero();
  // The moments of inertia about the centre of mass, along the axes of the body's frame.
  math::Vector3 inertia_kg_m2 = math::Vector3::Zero();
};

// The chassis is given in R; rocker, bogie and wheel in frames at their joints, with axes parallel
// to R. The chassis is a solid box from its underside to the panel, about the centre of mass that
// the parameters give; rockers and bogies are flat bars as long as half and a quarter of the rover;
// wheels are solid cylinders.
struct RoverMasses {
  BodyMass chassis;
  BodyMass rocker;
  BodyMass bogie;
  BodyMass wheel;
};

// The chassis has the mass that wheels, rockers and bogies leave of the total. Rockers, bogies and
// wheels have their centres of mass at their joints, and wheels are alike about both axes across
// the axle: the inverse of the mass matrix is made for that (joint_space_inertia.cc).
RoverMasses MakeRoverMasses(const RoverParams& params);

}  // namespace rockyard::rover
