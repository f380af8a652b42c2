#include "navigation/gestalt/evaluation.h"

#include <algorithm>

#include "core/check.h"
#include "navigation/gestalt/votes.h"

namespace rockyard::navigation {
namespace {

using messages::LookDirection;

// Returns the parameters for votes on arcs. A motion that is replaced on the move ends, for its
// waypoint vote, where the next plan is made.
GestaltParams ForArcVotes(const GestaltParams& params) {
  GestaltParams voting = params;
  if (params.continuous.cycle == DriveCycle::kStopAndLook) return voting;
  voting.drive.step_m = std::max(params.drive.step_m, params.continuous.ReplanDistance_m());
  return voting;
}

}  // namespace

Evaluation::Evaluation(const GestaltParams& params, double full_speed_m_s)
    : params_(params),
      map_(params.map),
      voter_(ForArcVotes(params)),
      way_(params),
      way_voter_(params),
      remedy_turns_(params) {
  if (params.continuous.cycle == DriveCycle::kCsad) spline_voter_.emplace(params, full_speed_m_s);
}

void Evaluation::See(const messages::PointCloud& cloud, const math::Transform& X_OR,
                     const messages::PoseEstimate& rover) {
  looked_behind_ = cloud.direction == LookDirection::kBehind;
  if (!looked_behind_) map_.BeginCycle(rover.x_m, rover.y_m);
  map_.Add(cloud, X_OR);
}

void Evaluation::Forget(const messages::PoseEstimate& rover) {
  map_.Clear();
  way_.Forget();
  map_.BeginCycle(rover.x_m, rover.y_m);
}

void Evaluation::Vote(const PlanOrigin& origin, const messages::Goal& goal,
                      const FeltHazards& felt) {
  grid_ = &map_.Evaluate();
  votes_ = voter_.Vote(*grid_, origin.pose, goal);
  felt.MarkVetoes(votes_);
  if (spline_voter_) {
    spline_votes_ = spline_voter_->Vote(*grid_, origin.pose, origin.curvature_per_m, goal);
  }
  way_.Plan(*grid_, goal, origin.pose.x_m, origin.pose.y_m);
  if (!params_.remedies.cost_to_go.enabled) return;
  way_voter_.Vote(origin, goal, way_, votes_);
  way_voter_.Vote(origin, goal, way_, spline_votes_);
}

const messages::SplineVote* Evaluation::SafeSpline() const {
  const messages::SplineVote* best = ChooseSpline(spline_votes_, params_);
  return best != nullptr && best->merged >= params_.votes.min_vote_goodness ? best : nullptr;
}

RemedyTurn Evaluation::TurnInstead(const PlanOrigin& origin, const messages::Goal& goal,
                                   double turned_rad) {
  EXPECT(grid_ != nullptr);
  std::optional<double> goes_on_m;
  if (spline_voter_) {
    if (const messages::SplineVote* best = SafeSpline()) {
      // As far as arcs: a spline is replaced long before its end.
      goes_on_m =
          way_voter_.Way_m(origin, goal, way_, best->spline, params_.remedies.cost_to_go.way_m);
    }
  } else if (const messages::MotionVote* best = ChooseArc(votes_, params_)) {
    const bool safe = best->motion.direction > 0 && best->merged >= params_.votes.min_vote_goodness;
    if (safe) goes_on_m = way_voter_.Way_m(origin, goal, way_, *best);
  }
  return remedy_turns_.InsteadOf(goes_on_m, turned_rad, *grid_, origin, goal, way_);
}

const messages::Spline* Evaluation::TakeSafeSpline() {
  const messages::SplineVote* best = SafeSpline();
  if (best == nullptr) return nullptr;
  messages::SplineVote& chosen =
      spline_votes_[static_cast<std::size_t>(best - spline_votes_.data())];
  chosen.chosen = true;
  return &chosen.spline;
}

void Evaluation::Show(const PlanOrigin& origin, const messages::AttitudeEstimate& attitude,
                      const messages::Goal& goal) {
  view_ = {.step = view_ ? view_->step + 1 : 0,
           .estimate = origin.pose,
           .attitude = attitude,
           .goal = goal,
           .looked_behind = looked_behind_,
           .map = map_.View(),
           .forward = votes_.forward,
           .backward = votes_.backward,
           .point_turns = votes_.point_turns,
           .splines = spline_votes_,
           .spline_start = origin.pose};
}

}  // namespace rockyard::navigation
