#include "navigation/enav/planner.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "math/functions.h"

namespace rockyard::navigation {
namespace {

using messages::Goal;

// From its centre to the farthest wheel.
double Reach_m(const messages::DriveCalibration& drive) {
  double reach_m = 0.0;
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    reach_m = std::max(reach_m, math::Hypot(drive.wheel_x_m[i], drive.wheel_y_m[i]));
  }
  return reach_m;
}

double Distance_m(const math::Pose2& pose, const Goal& goal) {
  return math::Hypot(goal.x_m - pose.x_m, goal.y_m - pose.y_m);
}

}  // namespace

EnavPlanner::EnavPlanner(const EnavParams& params, const messages::RoverBelief& rover,
                         double speed_m_s)
    : params_(params),
      rover_(rover),
      speed_m_s_(speed_m_s),
      turn_rate_rad_s_(speed_m_s / Reach_m(rover.drive)),
      ace_(params.ace, rover),
      tree_(params.tree),
      heights_(params.map.height_cell_m, params.map.height_side_m),
      costs_(params.map, speed_m_s, rover.belly_clearance_m) {}

void EnavPlanner::Forget() {
  heights_ = HeightMap(params_.map.height_cell_m, params_.map.height_side_m);
  costs_ = CostMap(params_.map, speed_m_s_, rover_.belly_clearance_m);
  felt_.clear();
}

void EnavPlanner::See(const messages::PointCloud& cloud, const math::Transform& X_OR) {
  heights_.Follow(X_OR.translation().x(), X_OR.translation().y());
  costs_.Follow(X_OR.translation().x(), X_OR.translation().y());
  for (const math::Vector3& point_R : cloud.points_R) {
    const math::Vector3 point = X_OR * point_R;
    const LatticeCell at = heights_.CellOf(point.x(), point.y());
    if (heights_.Holds(at)) heights_.At(at).Add(point.z());
    costs_.Add(point);
  }
}

void EnavPlanner::StandOn(const math::Transform& X_OR) {
  const math::Vector3 origin = X_OR.translation();
  const math::Vector3 up = X_OR.linear().col(2);
  const double radius_m = params_.map.stand_lengths * rover_.length_m;
  heights_.Follow(origin.x(), origin.y());
  const LatticeCell from = heights_.CellOf(origin.x() - radius_m, origin.y() - radius_m);
  const LatticeCell to = heights_.CellOf(origin.x() + radius_m, origin.y() + radius_m);
  for (std::int64_t y = from.y; y <= to.y; ++y) {
    for (std::int64_t x = from.x; x <= to.x; ++x) {
      if (!heights_.Holds({x, y}) || heights_.At({x, y}).seen()) continue;
      const double dx_m = heights_.MiddleX_m({x, y}) - origin.x();
      const double dy_m = heights_.MiddleY_m({x, y}) - origin.y();
      if (math::Hypot(dx_m, dy_m) > radius_m) continue;
      heights_.At({x, y}).Add(origin.z() - (up.x() * dx_m + up.y() * dy_m) / up.z());
    }
  }
}

EnavPlan EnavPlanner::Plan(const math::Pose2& from, const Goal& goal) {
  arcs_.assign(tree_.arcs().size(), {});
  turns_.assign(tree_.turns_rad().size(), {});
  costs_.Update(goal.x_m, goal.y_m);
  EnavPlan plan;
  for (const TreePath& path : SortedPaths(from, goal)) {
    if (Passes(path, from, plan)) {
      const TreeArc* arc = &tree_.arcs()[static_cast<std::size_t>(path.arc)];
      std::size_t poses = path.poses;
      const auto add = [&] {
        for (std::size_t i = poses; i > 0; --i) plan.way.push_back(from * arc->poses[i - 1]);
      };
      add();
      while (arc->before >= 0) {
        arc = &tree_.arcs()[static_cast<std::size_t>(arc->before)];
        poses = arc->poses.size();
        add();
      }
      std::reverse(plan.way.begin(), plan.way.end());
      plan.found = true;
      plan.turn_rad = tree_.turns_rad()[static_cast<std::size_t>(arc->turn)];
      plan.curvature_per_m = arc->curvature_per_m;
      plan.length_m =
          std::min(static_cast<double>(poses) * params_.tree.check_spacing_m, params_.tree.arc_m);
      return plan;
    }
    if (plan.over_budget) return plan;
  }
  return plan;
}

// A path that passes the goal ends there, and what it misses it by is driven. Ground in the cell on
// which the rover stands costs nothing beyond its time: the rover got there. Ties go to the path
// that comes first in the tree.
std::vector<TreePath> EnavPlanner::SortedPaths(const math::Pose2& from, const Goal& goal) const {
  const double pose_m = params_.tree.check_spacing_m;
  const double near_m = std::max(params_.drive.goal_tolerance_m, pose_m);
  const double reach_m = 2.0 * params_.tree.arc_m + near_m;
  const bool near = Distance_m(from, goal) <= reach_m;
  const double own_m = 0.5 * params_.map.cost_cell_m;
  // Of each arc, from where the rover stands: the cost to its end or to the goal, and where it
  // ends.
  struct ArcCost {
    double cost_s = 0.0;
    std::size_t poses = 0;
    bool at_goal = false;
  };
  std::vector<ArcCost> costs(tree_.arcs().size());
  const auto cost_of = [&](const TreeArc& arc) -> ArcCost {
    ArcCost cost;
    if (arc.before >= 0) {
      const ArcCost& before = costs[static_cast<std::size_t>(arc.before)];
      if (before.at_goal || !std::isfinite(before.cost_s)) return before;
      cost.cost_s = before.cost_s;
    } else {
      cost.cost_s =
          std::abs(tree_.turns_rad()[static_cast<std::size_t>(arc.turn)]) / turn_rate_rad_s_;
    }
    double last_m = 0.0, nearest_m = near_m;
    ArcCost at_goal;
    for (const math::Pose2& relative : arc.poses) {
      const math::Pose2 pose = from * relative;
      ++cost.poses;
      const double to_m = std::min(static_cast<double>(cost.poses) * pose_m, params_.tree.arc_m);
      const double flat = costs_.FlatCost_s_per_m();
      const double ground = costs_.Cost_s_per_m(pose.x_m, pose.y_m);
      const bool own =
          std::max(std::abs(pose.x_m - from.x_m), std::abs(pose.y_m - from.y_m)) < own_m;
      cost.cost_s +=
          (to_m - last_m) * (flat + (own ? 0.0 : params_.drive.map_weight * (ground - flat)));
      last_m = to_m;
      if (!near || Distance_m(pose, goal) > nearest_m) continue;
      nearest_m = Distance_m(pose, goal);
      at_goal = {cost.cost_s + nearest_m * flat, cost.poses, true};
    }
    return at_goal.at_goal ? at_goal : cost;
  };
  for (std::size_t i = 0; i < costs.size(); ++i) costs[i] = cost_of(tree_.arcs()[i]);
  std::vector<TreePath> paths;
  for (int end : tree_.ends()) {
    ArcCost cost = costs[static_cast<std::size_t>(end)];
    const TreeArc* arc = &tree_.arcs()[static_cast<std::size_t>(end)];
    if (arc->before >= 0 && costs[static_cast<std::size_t>(arc->before)].at_goal) {
      end = arc->before;  // it passes the goal on its first arc
      arc = &tree_.arcs()[static_cast<std::size_t>(end)];
    }
    if (!cost.at_goal) {
      const math::Pose2 last = from * arc->poses.back();
      cost.cost_s += costs_.ToGo_s(last.x_m, last.y_m);
    }
    if (std::isfinite(cost.cost_s)) paths.push_back({end, cost.poses, cost.cost_s});
  }
  std::stable_sort(paths.begin(), paths.end(),
                   [](const TreePath& p, const TreePath& q) { return p.cost_s < q.cost_s; });
  return paths;
}

bool EnavPlanner::Passes(const TreePath& path, const math::Pose2& from, EnavPlan& plan) {
  const auto passes_arc = [&](int number, std::size_t poses) {
    const TreeArc& arc = tree_.arcs()[static_cast<std::size_t>(number)];
    return Passes(arcs_[static_cast<std::size_t>(number)], poses, plan,
                  [&](std::size_t i) { return from * arc.poses[i]; });
  };
  const TreeArc& last = tree_.arcs()[static_cast<std::size_t>(path.arc)];
  const auto turn = static_cast<std::size_t>(last.turn);
  const double turn_rad = tree_.turns_rad()[turn];
  const double step_rad = params_.tree.turn_check_rad;
  const std::size_t headings =
      step_rad > 0.0 ? static_cast<std::size_t>(std::ceil(std::abs(turn_rad) / step_rad)) : 0;
  const auto heading = [&](std::size_t i) {
    const double share = static_cast<double>(i + 1) / static_cast<double>(headings);
    return from * math::Pose2{0.0, 0.0, share * turn_rad};
  };
  if (!Passes(turns_[turn], headings, plan, heading)) return false;
  if (last.before >= 0 &&
      !passes_arc(last.before, tree_.arcs()[static_cast<std::size_t>(last.before)].poses.size())) {
    return false;
  }
  return passes_arc(path.arc, path.poses);
}

// Goes on where it was left: no pose is checked twice.
template <typename PoseAt>
bool EnavPlanner::Passes(Checked& checked, std::size_t poses, EnavPlan& plan, PoseAt&& pose_at) {
  while (checked.passed < poses && !checked.failed) {
    const bool stands = MayStand(pose_at(checked.passed), plan);
    if (plan.over_budget) return false;
    checked.failed = !stands;
    if (stands) ++checked.passed;
  }
  return checked.passed >= poses;
}

bool EnavPlanner::MayStand(const math::Pose2& pose, EnavPlan& plan) {
  for (const Goal& place : felt_) {
    const math::Pose2 at = math::SeenFrom(pose, {place.x_m, place.y_m, 0.0});
    const double margin_m = params_.drive.felt_radius_m;
    if (std::abs(at.x_m) < 0.5 * rover_.length_m + margin_m &&
        std::abs(at.y_m) < 0.5 * rover_.width_m + margin_m) {
      return false;
    }
  }
  if (plan.checks >= params_.drive.max_checks && params_.drive.over_budget == OverBudget::kStop) {
    plan.over_budget = true;
    return false;
  }
  ++plan.checks;
  return ace_.Check(heights_, pose).safe();
}

}  // namespace rockyard::navigation
