// The choice of ENav: all paths of the tree by their cost, the best first, checked by ACE until one
// passes. A path costs the time of its turn and arcs, what the cost map holds along it beyond that
// time, and the way on to the goal from its end.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "messages/calibration.h"
#include "messages/estimates.h"
#include "messages/point_cloud.h"
#include "navigation/enav/ace.h"
#include "navigation/enav/cost_map.h"
#include "navigation/enav/path_tree.h"

namespace rockyard::navigation {

// What a planning cycle found.
struct EnavPlan {
  bool found = false;
  double turn_rad = 0.0;         // in place, before the arc
  double curvature_per_m = 0.0;  // of the first arc
  double length_m = 0.0;         // of it
  std::vector<math::Pose2> way;  // the poses that were checked, in the map's frame
  std::int64_t checks = 0;       // by ACE
  bool over_budget = false;      // it ended by max_checks
};

class EnavPlanner {
 public:
  // `params` have the lengths of this rover (ScaledTo). `speed_m_s` is that of its fastest rim.
  EnavPlanner(const EnavParams& params, const messages::RoverBelief& rover, double speed_m_s);

  // Forgets all that was seen and felt.
  void Forget();
  // Takes what was seen from a pose of the rover in the map's frame.
  void See(const messages::PointCloud& cloud, const math::Transform& X_OR);
  // Takes the ground on which the rover stands for what it does not see of it.
  void StandOn(const math::Transform& X_OR);
  // No path leads the rover's outline near this place any more.
  void Avoid(const messages::Goal& place) { felt_.push_back(place); }
  void ForgetFelt() { felt_.clear(); }

  // Plans from a pose to a goal, both in the map's frame.
  EnavPlan Plan(const math::Pose2& from, const messages::Goal& goal);

  const HeightMap& heights() const { return heights_; }
  const CostMap& costs() const { return costs_; }
  const PathTree& tree() const { return tree_; }

 private:
  // What is known of the safety of an arc or turn.
  struct Checked {
    std::size_t passed = 0;  // poses from its beginning
    bool failed = false;     // at the next one
  };

  std::vector<TreePath> SortedPaths(const math::Pose2& from, const messages::Goal& goal) const;
  bool Passes(const TreePath& path, const math::Pose2& from, EnavPlan& plan);
  template <typename PoseAt>
  bool Passes(Checked& checked, std::size_t poses, EnavPlan& plan, PoseAt&& pose_at);
  bool MayStand(const math::Pose2& pose, EnavPlan& plan);

  EnavParams params_;
  messages::RoverBelief rover_;
  double speed_m_s_;
  double turn_rate_rad_s_;
  Ace ace_;
  PathTree tree_;
  HeightMap heights_;
  CostMap costs_;
  std::vector<messages::Goal> felt_;
  // Of the cycle under way.
  std::vector<Checked> arcs_;
  std::vector<Checked> turns_;
};

}  // namespace rockyard::navigation
