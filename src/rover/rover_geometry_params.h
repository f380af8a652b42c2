// Dimensions of the six-wheel rocker-bogie rover. The defaults describe Rocky 3.2. Both fidelities
// build the rover by them; sensors take from them what the rover hides and shades, referee and
// counters its outline. Meanings and sources stand in the .cc.
//
// Frame R: x forward, y left, z up, origin on the ground under the chassis centre while the rover
// stands on level ground. The pivots of Rocky 3.2 are not public: the defaults take the widths of
// wheels and belly and the height of the rocker's pivot from Rocky 7, whose wheels have the same
// size, and spread the wheels over the published length. These values are marked as assumed, with a
// range. Records depend on a default in every scenario that leaves its parameter out; a bound only
// refuses files.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/fields.h"
#include "math/angles.h"

namespace rockyard::rover {

// Which end of the rover stands on the bogies; the other end stands on the rockers.
enum class BogieEnd { kRear, kFront };

// Which wheels steer.
enum class SteeredWheels { kCorners, kAll };

struct RoverGeometryParams {
  double length_m = 0.65;
  double width_m = 0.48;
  double height_m = 0.30;
  double belly_clearance_m = 0.13;
  double wheel_radius_m = 0.065;
  double wheel_width_m = 0.08;
  double lug_height_m = 0.01;
  std::int64_t lug_count = 18;
  double wheelbase_m = 0.52;
  double middle_wheel_x_m = 0.0;
  SteeredWheels steered_wheels = SteeredWheels::kCorners;
  BogieEnd bogie_end = BogieEnd::kFront;
  double rocker_pivot_x_m = -0.015;
  double rocker_pivot_z_m = 0.19;
  double bogie_pivot_z_m = 0.13;
  double knee_z_m = 0.145;
  double belly_length_m = 0.40;
  double belly_width_m = 0.26;
  double arm_y_m = 0.147;
  double arm_radius_m = 0.012;
  double hub_radius_m = 0.025;
  double rocker_limit_rad = math::DegToRad(25.0);
  double bogie_limit_rad = math::DegToRad(50.0);

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::rover

template <>
struct rockyard::core::EnumNames<rockyard::rover::BogieEnd> {
  static constexpr std::array<std::string_view, 2> kNames{"rear", "front"};
};

template <>
struct rockyard::core::EnumNames<rockyard::rover::SteeredWheels> {
  static constexpr std::array<std::string_view, 2> kNames{"corners", "all"};
};
