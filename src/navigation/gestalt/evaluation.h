// What GESTALT makes of its looks: the map, the votes on every motion, and the choice among
// splines. The cycle owns one. Records depend on votes and choice, but of the view only on its
// being there (navigator.h).
#pragma once

#include <optional>

#include "messages/navigation_view.h"
#include "navigation/gestalt/felt.h"
#include "navigation/gestalt/gestalt_params.h"
#include "navigation/gestalt/manoeuvre.h"
#include "navigation/gestalt/map.h"
#include "navigation/gestalt/splines.h"
#include "navigation/gestalt/turns.h"
#include "navigation/gestalt/votes.h"
#include "navigation/gestalt/way_to_go.h"
#include "navigation/gestalt/way_votes.h"

namespace rockyard::navigation {

// Map, votes and view. Invariant: all votes are of one moment: from one origin, on the map as it
// was after the last look.
class Evaluation {
 public:
  Evaluation(const GestaltParams& params, double full_speed_m_s);

  // Adds what was seen from X_OR to the map. A look ahead begins a cycle of the map, with its
  // window around `rover`; a look behind adds to that cycle.
  void See(const messages::PointCloud& cloud, const math::Transform& X_OR,
           const messages::PoseEstimate& rover);

  // Forgets the map of a rover that was moved by hand.
  void Forget(const messages::PoseEstimate& rover);

  // Votes on every motion that begins at `origin`.
  void Vote(const PlanOrigin& origin, const messages::Goal& goal, const FeltHazards& felt);

  MotionVotes& votes() { return votes_; }
  bool votes_on_splines() const { return spline_voter_.has_value(); }

  // Chooses the best spline and marks it as chosen; null where none is safe.
  const messages::Spline* TakeSafeSpline();

  // Returns the turn in place that a remedy makes instead of what the votes would choose.
  // `turned_rad` is what the rover has turned without progress.
  RemedyTurn TurnInstead(const PlanOrigin& origin, const messages::Goal& goal, double turned_rad);

  // Makes view() of the last votes, for traces and pages. It copies them: a choice has to be marked
  // before.
  void Show(const PlanOrigin& origin, const messages::AttitudeEstimate& attitude,
            const messages::Goal& goal);
  const messages::NavigationView* view() const { return view_ ? &*view_ : nullptr; }

  GestaltMap& map() { return map_; }

 private:
  // Returns the best spline; null where none is safe.
  const messages::SplineVote* SafeSpline() const;

  GestaltParams params_;
  GestaltMap map_;
  ArcVoter voter_;
  std::optional<SplineVoter> spline_voter_;  // where the cycle is csad
  MotionVotes votes_;
  SplineVotes spline_votes_;
  WayToGo way_;
  WayVoter way_voter_;
  RemedyTurns remedy_turns_;
  const GoodnessGrid* grid_ = nullptr;  // of the last votes
  bool looked_behind_ = false;
  std::optional<messages::NavigationView> view_;
};

}  // namespace rockyard::navigation
