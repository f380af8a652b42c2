#include "navigation/enav/path_tree.h"

#include <algorithm>
#include <cmath>

#include "math/functions.h"

namespace rockyard::navigation {
namespace {

constexpr double kPublishedWheelbase_m = 2.26;

// Evenly from -largest to +largest.
std::vector<double> Curvatures(std::int64_t count, double largest) {
  std::vector<double> curvatures;
  for (std::int64_t i = 0; i < count; ++i) {
    const double share =
        count > 1 ? 2.0 * static_cast<double>(i) / static_cast<double>(count - 1) - 1.0 : 0.0;
    curvatures.push_back(share * largest);
  }
  return curvatures;
}

}  // namespace

math::Pose2 AlongArc(double curvature_per_m, double length_m) {
  const double turn_rad = curvature_per_m * length_m;
  // The chord leaves at half of the turn: length times sin(h) / h.
  const double half_rad = 0.5 * turn_rad;
  const auto [s, c] = math::SinCos(half_rad);
  const double chord_m = half_rad == 0.0 ? length_m : length_m * s / half_rad;
  return {chord_m * c, chord_m * s, turn_rad};
}

EnavParams ScaledTo(EnavParams params, double wheelbase_m) {
  if (params.tree.lengths == TreeLengths::kAsTold) return params;
  const double scale = wheelbase_m / kPublishedWheelbase_m;
  params.tree.arc_m *= scale;
  params.tree.check_spacing_m *= scale;
  params.tree.max_curvature_per_m /= scale;
  params.drive.execute_arc_m *= scale;
  return params;
}

PathTree::PathTree(const EnavTreeParams& params) {
  const std::int64_t half = params.num_turns / 2;
  for (std::int64_t i = 0; i < params.num_turns; ++i) {
    turns_rad_.push_back(params.turn_span_rad * static_cast<double>(i - half) /
                         static_cast<double>(params.num_turns));
  }
  // The last pose of an arc is its end, wherever the spacing falls.
  const auto poses =
      static_cast<std::int64_t>(std::ceil(params.arc_m / params.check_spacing_m - 1e-9));
  const auto add = [&](int turn, int before, const math::Pose2& from, double curvature_per_m) {
    TreeArc arc{turn, before, curvature_per_m, {}};
    for (std::int64_t i = 1; i <= poses; ++i) {
      const double length_m =
          std::min(static_cast<double>(i) * params.check_spacing_m, params.arc_m);
      arc.poses.push_back(from * AlongArc(curvature_per_m, length_m));
    }
    arcs_.push_back(std::move(arc));
  };
  for (std::size_t turn = 0; turn < turns_rad_.size(); ++turn) {
    for (const double c : Curvatures(params.num_first_arcs, params.max_curvature_per_m)) {
      add(static_cast<int>(turn), -1, {0.0, 0.0, turns_rad_[turn]}, c);
    }
  }
  const int first = static_cast<int>(arcs_.size());
  for (int before = 0; before < first; ++before) {
    for (const double c : Curvatures(params.num_second_arcs, params.max_curvature_per_m)) {
      const TreeArc& from = arcs_[static_cast<std::size_t>(before)];
      add(from.turn, before, from.poses.back(), c);
    }
  }
  const int begin = params.num_second_arcs > 0 ? first : 0;
  for (int arc = begin; arc < static_cast<int>(arcs_.size()); ++arc) ends_.push_back(arc);
}

}  // namespace rockyard::navigation
