#include "campaign/mobility/step_drive.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "math/angles.h"
#include "messages/commands.h"
#include "rover/rover.h"
#include "rover/rover_layout_params.h"
#include "terrain/terrain.h"

namespace rockyard::campaign {
namespace {

constexpr double kStepWithin_m = 0.005;
constexpr double kStepTipped_rad = math::DegToRad(60.0);

// Flat ellipsoids stacked so densely that their front is a wall with ripples of a hundredth of
// their thickness; so wide that it is straight.
terrain::Terrain StepAt(double x_m, double depth_m, double height_m,
                        const rover::RoverGeometryParams& size, const terrain::SoilParams& soil) {
  const double half_thickness_m = size.wheel_radius_m / 6.5;
  const double half_depth_m = 0.5 * depth_m;
  std::vector<terrain::Rock> rocks;
  for (double z_m = height_m - half_thickness_m; z_m > -half_thickness_m;
       z_m -= 0.6 * half_thickness_m) {
    rocks.push_back(
        {.center_W = math::Vector3(x_m + half_depth_m, 0.0, z_m),
         .semi_axes_m = math::Vector3(half_depth_m, 10.0 * size.width_m, half_thickness_m),
         .diameter_m = depth_m,
         .height_m = z_m + half_thickness_m});
  }
  terrain::GroundParams ground{.soil = soil};
  ground.soil.spread.enabled = false;
  return {terrain::Ground(ground, {}), std::move(rocks), {}};
}

rover::RoverParams AsMultibody(const rover::RoverParams& params) {
  rover::RoverParams multibody = params;
  multibody.fidelity = rover::Fidelity::kMultibody;
  // The bound of rover_params.cc on the speed of rims inside, 0.2 m/s on wheels of 65 mm on Earth.
  const double gentle_m_s = 0.05 * std::sqrt(params.physics.gravity_m_s2 *
                                             params.geometry.wheel_radius_m / (9.81 * 0.065));
  multibody.physics.time_scale =
      std::max(params.physics.time_scale, gentle_m_s / params.drive.speed_m_s);
  return multibody;
}

}  // namespace

bool ClimbsStep(const rover::RoverParams& params, const terrain::SoilParams& soil,
                double height_m) {
  const rover::RoverParams multibody = AsMultibody(params);
  const rover::RoverGeometryParams& size = params.geometry;
  const double radius_m = size.wheel_radius_m;
  const double reach_m = 0.5 * std::max(size.length_m, size.wheelbase_m + 2.0 * radius_m);
  const double step_x_m = reach_m + radius_m;
  const terrain::Terrain terrain = StepAt(step_x_m, 4.0 * reach_m, height_m, size, soil);
  // With the rear axle a radius behind the edge.
  const double there_m = step_x_m + 0.5 * size.wheelbase_m + radius_m;
  const auto rover = rover::MakeRover(multibody, terrain);
  rover->Place({});
  messages::WheelCommand command;
  command.rate_rad_s.fill(params.drive.speed_m_s / radius_m);
  const auto steps = static_cast<std::int64_t>(3.0 * (there_m + height_m) /
                                               (params.drive.speed_m_s * rover->step_s()));
  for (std::int64_t step = 0; step < steps; ++step) {
    rover->Step(command);
    const math::Transform& X_WR = rover->state().X_WR;
    if (math::Tilt(X_WR) > kStepTipped_rad) return false;
    if (X_WR.translation().x() > there_m) return X_WR.translation().z() > 0.5 * height_m;
  }
  return false;
}

std::optional<double> HighestStep(const rover::RoverParams& params, const terrain::SoilParams& soil,
                                  const std::function<bool()>& stop) {
  const double stride_m = 0.5 * params.geometry.wheel_radius_m;
  double climbed_m = 0.0;
  double too_high_m = stride_m;
  while (too_high_m <= 12.0 * stride_m) {
    if (stop()) return std::nullopt;
    if (!ClimbsStep(params, soil, too_high_m)) break;
    climbed_m = too_high_m;
    too_high_m += stride_m;
  }
  while (too_high_m - climbed_m > kStepWithin_m) {
    if (stop()) return std::nullopt;
    const double height_m = 0.5 * (climbed_m + too_high_m);
    (ClimbsStep(params, soil, height_m) ? climbed_m : too_high_m) = height_m;
  }
  return climbed_m;
}

}  // namespace rockyard::campaign
