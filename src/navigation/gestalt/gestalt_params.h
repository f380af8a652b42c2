// Every parameter of GESTALT: table 1 of Goldberg 2002, and what the drive cycle needs beside it.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/fields.h"
#include "math/angles.h"
#include "navigation/gestalt/continuous_params.h"
#include "navigation/gestalt/map_params.h"
#include "navigation/gestalt/speed_law_params.h"
#include "navigation/gestalt/spline_params.h"
#include "navigation/gestalt/vote_params.h"

namespace rockyard::navigation {

// When turning in place is chosen over an arc.
enum class PointTurns {
  kNever,
  kNothingSafe,   // no arc may be driven
  kBelowMinVote,  // no arc's merged vote reaches min_vote_goodness
  kCandidates,    // the turn that would be made merges to more than every arc
};

// When backward arcs may be chosen.
enum class BackwardArcs {
  kBelowThreshold,  // the best forward vote is below min_fwd_threshold
  kAlways,
  kLastResort,  // the best forward vote is below min_vote_goodness
};

enum class ArrivalCheck {
  kBetweenSteps,  // at the beginning of each cycle
  kWhileDriving,  // at every tick
};

struct GestaltDriveParams {
  double step_m = 0.35;
  bool rear_cameras = true;
  BackwardArcs backward_arcs = BackwardArcs::kBelowThreshold;
  PointTurns point_turns = PointTurns::kBelowMinVote;
  double point_turn_margin = 0.0;
  double min_drive_goodness = 10.0;
  double step_time_out_s = 300.0;
  double search_turn_rad = math::DegToRad(360.0);
  std::int64_t max_fruitless_cycles = 100;
  double progress_m = 0.25;
  double back_off_m = 0.35;
  double felt_radius_m = 0.10;
  double felt_again_m = 0.10;
  bool veto_felt = true;
  std::int64_t max_felt = 6;
  ArrivalCheck arrival_check = ArrivalCheck::kBetweenSteps;
  double time_out_s = 0.0;

  void Visit(core::FieldVisitor& v);
};

struct GestaltParams {
  GestaltMapParams map;
  GestaltArcParams arcs;
  GestaltWaypointParams waypoints;
  GestaltPlanParams plan;
  GestaltVoteParams votes;
  GestaltDriveParams drive;
  GestaltContinuousParams continuous;
  GestaltSplineParams splines;
  SpeedLawParams speed;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::navigation

template <>
struct rockyard::core::EnumNames<rockyard::navigation::PointTurns> {
  static constexpr std::array<std::string_view, 4> kNames{"never", "nothing_safe", "below_min_vote",
                                                          "candidates"};
};

template <>
struct rockyard::core::EnumNames<rockyard::navigation::BackwardArcs> {
  static constexpr std::array<std::string_view, 3> kNames{"below_threshold", "always",
                                                          "last_resort"};
};

template <>
struct rockyard::core::EnumNames<rockyard::navigation::ArrivalCheck> {
  static constexpr std::array<std::string_view, 2> kNames{"between_steps", "while_driving"};
};
