// Parameters of GESTALT but for its map (map_params.h), which the files of this folder read: arcs,
// votes and waypoints of Goldberg 2002, table 1, the drive cycle, and driving on the move (Howard
// 2012). Names and defaults of table 1 are the table's, and a test holds them to it; what the
// papers leave open is marked as assumed. A default decides the records of every scenario that
// leaves it out; a bound only refuses files. Meanings, units and origins stand in
// gestalt_params.cc.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/fields.h"
#include "math/angles.h"
#include "navigation/gestalt/map_params.h"
#include "navigation/gestalt/remedy_params.h"

namespace rockyard::navigation {

// Candidate motions. Curvatures are spaced evenly from -max_curvature to +max_curvature.
struct GestaltArcParams {
  double max_curvature_per_m = 2.0;
  std::int64_t num_forward_arcs = 23;
  std::int64_t num_backward_arcs = 23;
  double point_turn_amount_rad = math::DegToRad(90.0);
  std::int64_t num_point_turns = 0;

  void Visit(core::FieldVisitor& v);
};

struct GestaltWaypointParams {
  double tight_curve_fraction = 1.0;
  double vote_index_variance = 225.0;
  double waypoint_certainty = 192.0;
  double goal_tolerance_m = 0.25;

  void Visit(core::FieldVisitor& v);
};

// Weight of a cell at distance s along a path: "biased to consider nearby cells more strongly"
// (Goldberg 2002, step 4).
enum class PathWeight {
  kLinear,   // 1 - (1 - far_weight) (s - plan_min_dist) / (plan_max_dist - plan_min_dist)
  kInverse,  // 1 / s
  kUniform,  // 1: no bias
};

// What unknown cells do to the hazard vote of a path.
enum class UnknownCells {
  kFullWeight,   // they count with the goodness of their pair, 11
  kByCertainty,  // cells count by their certainty, as votes do when they are merged: unknown ones
                 // say nothing
};

struct GestaltPlanParams {
  double plan_min_dist_m = 0.3;
  double plan_max_dist_m = 3.0;
  double max_path_turn_rad = math::DegToRad(360.0);
  PathWeight path_weight = PathWeight::kLinear;
  double far_weight = 0.2;
  UnknownCells unknown_cells = UnknownCells::kFullWeight;
  std::int64_t samples_per_cell = 2;

  void Visit(core::FieldVisitor& v);
};

struct GestaltVoteParams {
  double min_allowed_goodness = 10.0;
  double min_fwd_threshold = 180.0;
  double min_vote_goodness = 26.0;
  bool whole_numbers = true;

  void Visit(core::FieldVisitor& v);
};

// The speed law (SpeedShare): full speed up to full_speed_curvature, min_speed_share of it from
// slow_curvature on: "The maximum speed [...] was 7 cm/sec and is reduced only for high-curvature
// maneuvers" (Howard 2012, section 3). By default curves are driven as fast as straight lines.
struct SpeedLawParams {
  double full_speed_curvature_per_m = 0.5;
  double min_speed_share = 1.0;
  double slow_curvature_per_m = 1.0;

  void Visit(core::FieldVisitor& v);
};

// In what the curvature between two knots is linear (CurvatureLaw): "Clothoid trajectories are
// motions whose curvature varies linearly with distance or time" (Howard 2012, section 2). The two
// are the same at constant speed.
enum class SplineLaw {
  kDistance,
  kTime,  // at the speed of the speed law
};

// The splines among which a rover that steers while it drives chooses (Howard 2012, sections 2 and
// 3). First and second knots are spaced evenly from -max_curvature to +max_curvature.
struct GestaltSplineParams {
  double length_m = 3.0;
  std::int64_t num_first_knots = 15;
  std::int64_t num_second_knots = 15;
  double max_curvature_per_m = 1.0;
  double max_curvature_rate_per_m_s = 0.45;
  SplineLaw law = SplineLaw::kDistance;
  double waypoint_m = 3.0;

  // Returns |dc/ds| of a spline from one curvature of the first knots to the next. Conditions on a
  // drive hold max_curvature_rate against it.
  double LeastRate_per_m2() const;

  void Visit(core::FieldVisitor& v);
};

// How looking, planning and driving follow each other.
enum class DriveCycle {
  kStopAndLook,  // Goldberg 2002: at rest, one after the other
  kCsod,  // continuous steering or driving: it looks and plans while it drives arcs, and stands
          // to steer
  kCsad,  // continuous steering and driving: it drives clothoid splines and stands for nothing
};

// Where a plan that is made on the move begins.
enum class PlanStart {
  kPredicted,  // from where the rover looked, along the motion under way, at its speed then
  kEstimated,  // where the rover believes to be when the plan is ready: as if planning took no time
};

// What a rover does on the move where no new plan is safe.
enum class NoSafePlan {
  kStop,    // stops at once, and looks about as it does at rest
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

  // Returns the distance driven between two plans, m, where none is late.
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
  GestaltRemedyParams remedies;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::navigation

template <>
struct rockyard::core::EnumNames<rockyard::navigation::PathWeight> {
  static constexpr std::array<std::string_view, 3> kNames{"linear", "inverse", "uniform"};
};

template <>
struct rockyard::core::EnumNames<rockyard::navigation::UnknownCells> {
  static constexpr std::array<std::string_view, 2> kNames{"full_weight", "by_certainty"};
};

template <>
struct rockyard::core::EnumNames<rockyard::navigation::SplineLaw> {
  static constexpr std::array<std::string_view, 2> kNames{"distance", "time"};
};

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
