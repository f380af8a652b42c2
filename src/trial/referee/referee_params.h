// When a drive is over, other than by arriving: the parameters of the referee. The defaults are
// those of the course of Matthies 1995; limits that a scenario may leave open follow its course
// (open_values_params.h), and the help of those in the .cc states that law. Records depend on the
// defaults in every scenario that states no others; bounds only refuse files. Meanings and sources
// stand in the .cc.
#pragma once

#include <array>
#include <string_view>

#include "core/fields.h"
#include "math/angles.h"

namespace rockyard::trial {

// What becomes of a rover whose wheels spin without moving it.
enum class SpinningWheels {
  kStuck,    // it is stuck after stall_window_s, whatever its odometer says
  kDriveOn,  // it carries on until it believes to have arrived or another rule ends the run
};

// What becomes of a rover that the referee has found stuck.
enum class StuckRover {
  kEnd,    // the run is over: its time and energy are those up to the verdict
  kRunOn,  // it spins its wheels until its batteries are empty: that time and energy count as well
};

// Rules by which a drive ends.
struct RefereeParams {
  double tip_over_rad = math::DegToRad(60.0);
  StuckRover stuck_rover = StuckRover::kEnd;
  SpinningWheels spinning_wheels = SpinningWheels::kStuck;
  double stall_window_s = 10.0;
  double stall_distance_m = 0.02;
  double stall_turn_rad = math::DegToRad(5.0);
  double high_centre_time_share = 0.2;
  double no_path_progress_m = 0.25;
  double no_path_distance_m = 4.0;
  double no_path_turn_rad = math::DegToRad(1080.0);
  double no_path_time_s = 3600.0;
  double time_limit_s = 14400.0;
  double hazard_height_m = 0.13;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::trial

template <>
struct rockyard::core::EnumNames<rockyard::trial::StuckRover> {
  static constexpr std::array<std::string_view, 2> kNames{"end", "run_on"};
};

template <>
struct rockyard::core::EnumNames<rockyard::trial::SpinningWheels> {
  static constexpr std::array<std::string_view, 2> kNames{"stuck", "drive_on"};
};
