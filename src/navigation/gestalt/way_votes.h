// Votes by the way that is left (remedies.cost_to_go), in place of the waypoint votes of arcs,
// turns in place and splines alike. Evaluation takes them after the votes of the papers.
#pragma once

#include "navigation/gestalt/curvature_law.h"
#include "navigation/gestalt/gestalt_params.h"
#include "navigation/gestalt/manoeuvre.h"
#include "navigation/gestalt/splines.h"
#include "navigation/gestalt/votes.h"
#include "navigation/gestalt/way_to_go.h"

namespace rockyard::navigation {

// Replaces waypoint votes, and merges anew. A motion of the length s, that of the votes or to the
// goal, has the way s + (way from its end). The vote falls linearly with what it loses against the
// best of all motions that may be driven:
//   vote = 255 max(0, 1 - (way - best way) / loss_m).
class WayVoter {
 public:
  explicit WayVoter(const GestaltParams& params);

  void Vote(const PlanOrigin& origin, const messages::Goal& goal, const WayToGo& way,
            MotionVotes& votes) const;
  void Vote(const PlanOrigin& origin, const messages::Goal& goal, const WayToGo& way,
            SplineVotes& votes) const;

  // Return the way to the goal by a motion, m: by an arc or the straight drive after a turn of
  // way_m, by a spline until until_m of it.
  double Way_m(const PlanOrigin& origin, const messages::Goal& goal, const WayToGo& way,
               const messages::MotionVote& vote) const;
  double Way_m(const PlanOrigin& origin, const messages::Goal& goal, const WayToGo& way,
               const messages::Spline& spline, double until_m) const;

 private:
  template <typename AnyVote>
  void Replace(double way_m, double best_m, AnyVote& vote) const;

  GestaltParams params_;
  CurvatureLaw law_;
};

}  // namespace rockyard::navigation
