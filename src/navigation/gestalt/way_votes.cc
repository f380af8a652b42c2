#include "navigation/gestalt/way_votes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace rockyard::navigation {
namespace {

using messages::MotionVote;
using messages::SplineVote;

constexpr double kBestVote = 255.0;
constexpr double kEndless = std::numeric_limits<double>::infinity();

// Returns the place after a motion of that length; of a turn in place, after its straight drive.
math::Pose2 EndOf(const MotionVote& vote, const messages::PoseEstimate& from, double length_m) {
  math::Pose2 start = Planar(from);
  start.heading_rad += vote.turn_rad;
  if (vote.motion.direction > 0 || vote.turn_rad != 0.0) {
    return AlongClothoid(start, vote.motion.curvature_per_m, 0.0, length_m);
  }
  // Backward is forward for a rover that faces the other way, on the mirrored arc.
  start.heading_rad += std::numbers::pi;
  return AlongClothoid(start, -vote.motion.curvature_per_m, 0.0, length_m);
}

}  // namespace

WayVoter::WayVoter(const GestaltParams& params)
    : params_(params), law_(params.splines.law, params.speed) {}

double WayVoter::Way_m(const PlanOrigin& origin, const messages::Goal& goal, const WayToGo& way,
                       const MotionVote& vote) const {
  const double length_m =
      std::min(params_.remedies.cost_to_go.way_m, TowardsGoal(origin.pose, goal).distance_m);
  const math::Pose2 end = EndOf(vote, origin.pose, length_m);
  return length_m + way.From_m(end.x_m, end.y_m);
}

double WayVoter::Way_m(const PlanOrigin& origin, const messages::Goal& goal, const WayToGo& way,
                       const messages::Spline& spline, double until_m) const {
  const double length_m = std::min(until_m, TowardsGoal(origin.pose, goal).distance_m);
  const math::Pose2 end = AlongSpline(Planar(origin.pose), spline, 0.0, length_m, law_);
  return length_m + way.From_m(end.x_m, end.y_m);
}

void WayVoter::Vote(const PlanOrigin& origin, const messages::Goal& goal, const WayToGo& way,
                    MotionVotes& votes) const {
  std::vector<double> ways_m;
  double best_m = kEndless;
  for (const auto* row : {&votes.forward, &votes.backward, &votes.point_turns}) {
    for (const MotionVote& vote : *row) {
      ways_m.push_back(Way_m(origin, goal, way, vote));
      const bool may_be_driven = vote.hazard > params_.drive.min_drive_goodness && !vote.vetoed;
      if (may_be_driven) best_m = std::min(best_m, ways_m.back());
    }
  }
  auto way_m = ways_m.begin();
  for (auto* row : {&votes.forward, &votes.backward, &votes.point_turns}) {
    for (MotionVote& vote : *row) Replace(*way_m++, best_m, vote);
  }
}

void WayVoter::Vote(const PlanOrigin& origin, const messages::Goal& goal, const WayToGo& way,
                    SplineVotes& votes) const {
  std::vector<double> ways_m;
  double best_m = kEndless;
  for (const SplineVote& vote : votes) {
    ways_m.push_back(Way_m(origin, goal, way, vote.spline, params_.splines.waypoint_m));
    const bool may_be_driven = vote.feasible && vote.hazard > params_.drive.min_drive_goodness;
    if (may_be_driven) best_m = std::min(best_m, ways_m.back());
  }
  for (std::size_t i = 0; i < votes.size(); ++i) Replace(ways_m[i], best_m, votes[i]);
}

template <typename AnyVote>
void WayVoter::Replace(double way_m, double best_m, AnyVote& vote) const {
  const bool whole = params_.votes.whole_numbers;
  const double loss = (way_m - best_m) / params_.remedies.cost_to_go.loss_m;
  vote.waypoint = RoundedVote(kBestVote * std::clamp(1.0 - loss, 0.0, 1.0), whole);
  vote.merged =
      RoundedVote(MergeVotes({vote.hazard, vote.hazard_certainty}, vote.waypoint,
                             params_.waypoints.waypoint_certainty, params_.votes.min_vote_goodness),
                  whole);
}

}  // namespace rockyard::navigation
