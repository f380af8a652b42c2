#include "experiments/arc_planning/arc_search.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>
#include <set>
#include <tuple>
#include <vector>

#include "math/functions.h"
#include "navigation/enav/path_tree.h"

namespace rockyard::experiments {
namespace {

struct OpenNode {
  double estimate_m = 0.0;  // of the whole way
  std::int64_t number = 0;  // in the order of opening
  double way_m = 0.0;
  math::Pose2 pose;

  bool operator>(const OpenNode& other) const {
    return std::tie(estimate_m, number) > std::tie(other.estimate_m, other.number);
  }
};

using Bin = std::tuple<std::int64_t, std::int64_t, std::int64_t>;

Bin BinOf(const ArcPlanningParams& params, const math::Pose2& pose) {
  const auto floor = [](double value) { return static_cast<std::int64_t>(std::floor(value)); };
  const double sector_rad = 2.0 * std::numbers::pi / static_cast<double>(params.heading_bins);
  // Sectors lie about 0, so that straight on stays in one.
  const std::int64_t sector = floor(pose.heading_rad / sector_rad + 0.5);
  return {floor(pose.x_m / params.place_bin_m), floor(pose.y_m / params.place_bin_m),
          (sector + params.heading_bins) % params.heading_bins};
}

}  // namespace

ArcSearch SearchArcs(const ArcPlanningParams& params, const math::Pose2& start,
                     const messages::Goal& goal,
                     const std::function<bool(const math::Pose2&)>& may_stand) {
  const auto distance_m = [&](const math::Pose2& pose) {
    return math::Hypot(goal.x_m - pose.x_m, goal.y_m - pose.y_m);
  };
  const auto poses =
      static_cast<std::int64_t>(std::ceil(params.arc_m / params.check_spacing_m - 1e-9));
  ArcSearch search;
  std::priority_queue<OpenNode, std::vector<OpenNode>, std::greater<>> open;
  std::set<Bin> closed;
  std::int64_t opened = 0;
  open.push({distance_m(start), opened++, 0.0, start});
  while (!open.empty() && search.nodes < params.max_nodes) {
    const OpenNode node = open.top();
    open.pop();
    if (distance_m(node.pose) <= params.goal_tolerance_m) {
      search.found = true;
      search.path_m = node.way_m;
      return search;
    }
    if (!closed.insert(BinOf(params, node.pose)).second) continue;
    ++search.nodes;
    for (const double curvature_per_m : params.curvatures_per_m) {
      const auto at = [&](double length_m) {
        return node.pose * navigation::AlongArc(curvature_per_m, length_m);
      };
      const math::Pose2 end = at(params.arc_m);
      if (closed.contains(BinOf(params, end))) continue;
      bool stands = true;
      for (std::int64_t i = 1; stands && i <= poses; ++i) {
        ++search.checks;
        stands =
            may_stand(at(std::min(static_cast<double>(i) * params.check_spacing_m, params.arc_m)));
      }
      if (!stands) continue;
      const double way_m = node.way_m + params.arc_m;
      open.push({way_m + distance_m(end), opened++, way_m, end});
    }
  }
  return search;
}

}  // namespace rockyard::experiments
