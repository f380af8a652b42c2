// Parameters of the arcs and votes of GESTALT: Goldberg 2002, table 1, groups "Arcs" and
// "Waypoints", plan-min-dist, plan-max-dist and the vote thresholds. Names and defaults are the
// table's; what the paper leaves open is marked as assumed.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/fields.h"
#include "math/angles.h"

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

}  // namespace rockyard::navigation

template <>
struct rockyard::core::EnumNames<rockyard::navigation::PathWeight> {
  static constexpr std::array<std::string_view, 3> kNames{"linear", "inverse", "uniform"};
};

template <>
struct rockyard::core::EnumNames<rockyard::navigation::UnknownCells> {
  static constexpr std::array<std::string_view, 2> kNames{"full_weight", "by_certainty"};
};
