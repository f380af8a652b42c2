// Parameters of the Pathfinder behaviour controller: what Matthies 1995, section 7, leaves open.
// Defaults are the plain reading of the paper, and a test holds the rules to it. Records and
// baselines of the paper's runs depend on the defaults, as their scenarios state few parameters; a
// bound only refuses files.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/fields.h"
#include "math/angles.h"

namespace rockyard::navigation {

// What the rover does when max_repeats reactions have brought no progress.
enum class ReactionsExhausted {
  kGiveUp,
  kGoOn,  // felt hazards are ignored for ignore_m of driving
};

// What the controller does about a hazard that the rover feels. Matthies 1995, section 6, names the
// sensors; section 7 has rules for what is seen only. All of this is assumed.
struct VehicleReactionParams {
  double back_off_m = 0.20;
  double turn_rad = math::DegToRad(45.0);
  double straight_m = 0.30;
  std::int64_t max_repeats = 6;
  double progress_m = 0.25;
  ReactionsExhausted on_exhausted = ReactionsExhausted::kGiveUp;
  double ignore_m = 0.50;

  void Visit(core::FieldVisitor& v);
};

// When the direction of a turn in place is chosen.
enum class TurnDirection {
  kLatched,   // once, when the hazard appears; kept until no hazard is detected
  kEachScan,  // again at every scan during the turn
};

// What a scan with hazards on the left and on the right leads to.
enum class BothSidesReaction {
  kRuleOrder,     // the rules in the order printed: left hazard first, so turn right
  kTowardGoal,    // turn to the side on which the goal lies
  kFewerHazards,  // turn to the side with fewer hazardous stripes; right on a tie
};

// What "right is clear" means when the centre stripe sees a hazard.
enum class RightIsClear {
  kNoRightHazard,   // none of the right stripes is hazardous in the same scan
  kOutermostClear,  // the outermost right stripe is not hazardous in the same scan
};

struct PathfinderParams {
  std::vector<std::int64_t> left_stripes = {0, 1};
  std::vector<std::int64_t> centre_stripes = {2};
  std::vector<std::int64_t> right_stripes = {3, 4};
  TurnDirection turn_direction = TurnDirection::kLatched;
  BothSidesReaction both_sides = BothSidesReaction::kRuleOrder;
  RightIsClear right_is_clear = RightIsClear::kNoRightHazard;
  double scan_interval_m = 0.065;
  double turn_increment_rad = math::DegToRad(10.0);
  double turn_give_up_rad = math::DegToRad(360.0);
  double clear_distance_m = 0.0;
  double goal_tolerance_m = 0.10;
  double heading_deadband_rad = math::DegToRad(5.0);
  double wide_arc_radius_m = 1.5;
  double tight_arc_radius_m = 0.75;
  double tight_arc_bearing_rad = math::DegToRad(30.0);
  double point_turn_bearing_rad = math::DegToRad(150.0);
  double point_turn_after_m = 0.30;
  double time_out_s = 0.0;
  double back_off_m = 0.0;
  double threading_m = 0.0;
  VehicleReactionParams vehicle_reaction;

  std::size_t stripe_count() const {
    return left_stripes.size() + centre_stripes.size() + right_stripes.size();
  }

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::navigation

template <>
struct rockyard::core::EnumNames<rockyard::navigation::ReactionsExhausted> {
  static constexpr std::array<std::string_view, 2> kNames{"give_up", "go_on"};
};

template <>
struct rockyard::core::EnumNames<rockyard::navigation::TurnDirection> {
  static constexpr std::array<std::string_view, 2> kNames{"latched", "each_scan"};
};

template <>
struct rockyard::core::EnumNames<rockyard::navigation::BothSidesReaction> {
  static constexpr std::array<std::string_view, 3> kNames{"rule_order", "toward_goal",
                                                          "fewer_hazards"};
};

template <>
struct rockyard::core::EnumNames<rockyard::navigation::RightIsClear> {
  static constexpr std::array<std::string_view, 2> kNames{"no_right_hazard", "outermost_clear"};
};
