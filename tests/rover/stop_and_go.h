// The motion of a trial: a rover that drives a wheel radius, stops to look, and drives on.
#pragma once

#include "rover_drive.h"

namespace rockyard::rover {

// One leg as in a trial of Matthies 1995: 6.5 cm at 15 cm/s, then the brakes until the rover
// stands.
inline constexpr double kLegDrive_s = 26.0 / 60.0;
inline constexpr double kLegRest_s = 0.05;  // beyond the ramp of the motors

// What a rover made of the way that its wheels rolled.
struct LegResult {
  double along = 0.0;   // way along its heading over the way of the rims
  double across = 0.0;  // and across it
};

// Drives `legs` legs, after two that are not counted, and compares the way with that of the rims.
inline LegResult DriveLegs(const RoverParams& params, const terrain::Terrain& terrain, int legs) {
  const auto rover = PlacedRover(params, terrain);
  const messages::WheelCommand drive = Drive(params, params.drive.speed_m_s, 0.0);
  const auto leg = [&] {
    RunFor(*rover, drive, kLegDrive_s);
    RunFor(*rover, kBraked, params.drive.ramp_s + kLegRest_s);
  };
  for (int i = 0; i < 2; ++i) leg();
  const truth::RoverState from = rover->state();
  for (int i = 0; i < legs; ++i) leg();
  const truth::RoverState& to = rover->state();
  double rolled_m = 0.0;
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    rolled_m += params.geometry.wheel_radius_m * (to.wheel_angle_rad[i] - from.wheel_angle_rad[i]) /
                messages::kWheelCount;
  }
  const math::Vector3 moved = to.X_WR.translation() - from.X_WR.translation();
  // The rover heads along its own x axis at the beginning.
  const math::Vector3 forward = from.X_WR.linear().col(0);
  const math::Vector3 across = moved - moved.dot(forward) * forward;
  return {moved.dot(forward) / rolled_m, across.norm() / rolled_m};
}

}  // namespace rockyard::rover
