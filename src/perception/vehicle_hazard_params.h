// Thresholds of the hazards that the Pathfinder rover feels rather than sees (Matthies 1995,
// section 6). The paper names the sensors and gives no threshold, so every value is assumed. A
// criterion works where its sensor is on board (sensors.vehicle).
#pragma once

#include <cstdint>

#include "core/fields.h"
#include "math/angles.h"

namespace rockyard::perception {

struct VehicleHazardParams {
  double max_tilt_rad = math::DegToRad(25.0);
  double max_rocker_rad = math::DegToRad(15.0);
  double max_bogie_rad = math::DegToRad(44.0);
  double max_current_A = 0.18;
  double max_turn_share = 0.2;
  std::int64_t tilt_ticks = 2;
  std::int64_t articulation_ticks = 2;
  std::int64_t current_ticks = 30;
  std::int64_t contact_ticks = 1;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::perception
