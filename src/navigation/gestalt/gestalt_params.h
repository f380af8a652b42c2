// Every parameter of GESTALT: table 1 of Goldberg 2002, and what the drive cycle needs beside it.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/fields.h"
#include "math/angles.h"
#include "navigation/gestalt/map_params.h"
#include "navigation/gestalt/spline_params.h"
#include "navigation/gestalt/vote_params.h"

namespace rockyard::navigation {

// How looking, planning and driving follow each other.
enum class DriveCycle {
  kStopAndLook,  // Goldberg 2002: at rest, one after the other
  kCsod,  // continuous steering or driving: it looks and plans while it drives arcs, and stands
          // to steer
  kCsad,  // continuous steering and driving: it drives clothoid splines and stands for nothing
};

// Where a plan that is made on the move begins.
enum class PlanStart {
  kPredicted,  // from where it looked, along the motion under way, at the speed that it had
  kEstimated,  // where the rover believes to be when the plan is ready: as if planning took no time
};

// What a rover does on the move where no new plan is safe.
enum class NoSafePlan {
  kStop,    // at once, and looks about as it does at rest
  kFinish,  // drives on as far as the motion under way was judged, and stops there
};

// What a rover does at the end of its motion where the next plan is not ready.
enum class LatePlan {
  kWait,         // stands until it is
  kStopAndLook,  // drops what is under way and looks again, at rest
};

// Driving without stopping to look: Howard 2012, section 2.
struct GestaltContinuousParams {
  DriveCycle cycle = DriveCycle::kStopAndLook;
  double motion_m = 1.0;
  double replan_fraction = 0.5;
  PlanStart plan_start = PlanStart::kPredicted;
  NoSafePlan no_safe_plan = NoSafePlan::kStop;
  LatePlan late_plan = LatePlan::kWait;

  // Driven between two plans, m, where none is late.
  double ReplanDistance_m() const { return replan_fraction * motion_m; }

  void Visit(core::FieldVisitor& v);
};

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
struct rockyard::core::EnumNames<rockyard::navigation::DriveCycle> {
  static constexpr std::array<std::string_view, 3> kNames{"stop_and_look", "csod", "csad"};
};

template <>
struct rockyard::core::EnumNames<rockyard::navigation::PlanStart> {
  static constexpr std::array<std::string_view, 2> kNames{"predicted", "estimated"};
};

template <>
struct rockyard::core::EnumNames<rockyard::navigation::NoSafePlan> {
  static constexpr std::array<std::string_view, 2> kNames{"stop", "finish"};
};

template <>
struct rockyard::core::EnumNames<rockyard::navigation::LatePlan> {
  static constexpr std::array<std::string_view, 2> kNames{"wait", "stop_and_look"};
};

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
