// Turns in place that GESTALT makes before it drives, by its remedies (remedy_params.h). The cycle
// asks for one whenever it has voted; records depend on them where a remedy is on.
#pragma once

#include <vector>

#include "messages/estimates.h"
#include "messages/navigation_view.h"
#include "navigation/gestalt/arcs.h"
#include "navigation/gestalt/curvature_law.h"
#include "navigation/gestalt/gestalt_params.h"
#include "navigation/gestalt/goodness_grid.h"
#include "navigation/gestalt/manoeuvre.h"
#include "navigation/gestalt/way_to_go.h"

namespace rockyard::navigation {

// Knows nothing of the drive cycle. Angles are positive to the left; 0 is no turn.
class RemedyTurns {
 public:
  explicit RemedyTurns(const GestaltParams& params);

  // Returns the turn of turn_first: towards the way, where that leads farther aside than
  // bearing_rad.
  double First(const GoodnessGrid& grid, const PlanOrigin& origin, const messages::Goal& goal,
               const WayToGo& way) const;

  // Returns the turn of stop_to_turn, which replaces the spline `best`; null: none is safe.
  // `turned_rad` is what the rover has turned on the move since its last progress.
  double InsteadOf(const messages::Spline* best, double turned_rad, const GoodnessGrid& grid,
                   const PlanOrigin& origin, const messages::Goal& goal, const WayToGo& way) const;

 private:
  // A turn in place, and the way to the goal by the straight drive after it.
  struct Turn {
    double angle_rad = 0.0;
    double way_m = 0.0;
  };

  // Where turns may lead. Without a way that was searched all round is no good rule: before a wall
  // the shortest way leads back to its middle, whichever way the rover has gone.
  enum class Directions { kTowardsGoal, kAllRound };
  Directions Sensible() const;

  // Returns the turn after which the way is shortest, of those after which nothing that is known
  // blocks the straight drive; no turn, and an endless way, if there is none.
  Turn BestTurn(Directions directions, const GoodnessGrid& grid, const messages::PoseEstimate& pose,
                const messages::Goal& goal, const WayToGo& way) const;
  bool LiesInsideTightestCircle(const messages::PoseEstimate& pose,
                                const messages::Goal& goal) const;

  GestaltParams params_;
  CurvatureLaw law_;
  PathSampling sampling_;
  std::vector<PathPoint> straight_;  // the places of the sampling on a straight drive
};

}  // namespace rockyard::navigation
