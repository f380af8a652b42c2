// Turns in place that GESTALT makes before it drives, by its remedies (remedy_params.h). The cycle
// asks for one whenever it has voted; records depend on them where a remedy is on.
#pragma once

#include <optional>
#include <vector>

#include "messages/estimates.h"
#include "messages/navigation_view.h"
#include "navigation/gestalt/arcs.h"
#include "navigation/gestalt/gestalt_params.h"
#include "navigation/gestalt/goodness_grid.h"
#include "navigation/gestalt/manoeuvre.h"
#include "navigation/gestalt/way_to_go.h"

namespace rockyard::navigation {

// A turn in place before anything is driven, and what follows it.
struct RemedyTurn {
  double angle_rad = 0.0;  // positive left; 0: straight on
  bool drives = false;     // drive.step_m straight on follows without another look

  bool any() const { return drives || angle_rad != 0.0; }
};

// Knows nothing of the drive cycle.
class RemedyTurns {
 public:
  explicit RemedyTurns(const GestaltParams& params);

  // Returns the turn that replaces what would be driven on. `goes_on_m` is the way to the goal by
  // that, if anything is safe to drive; `turned_rad` what the rover has turned on the move since
  // its last progress.
  RemedyTurn InsteadOf(std::optional<double> goes_on_m, double turned_rad, const GoodnessGrid& grid,
                       const PlanOrigin& origin, const messages::Goal& goal,
                       const WayToGo& way) const;

 private:
  // A turn in place, and the way to the goal by the straight drive after it.
  struct Turn {
    double angle_rad = 0.0;
    double way_m = 0.0;
    bool seen = false;  // the drive's end; what was not is looked at before it is driven
  };

  // Where turns may lead. Without a way that was searched all round is no good rule: before a wall
  // the shortest way leads back to its middle, whichever way the rover has gone.
  enum class Directions { kTowardsGoal, kAllRound };
  Directions Sensible() const;
  bool SearchesWay() const { return params_.remedies.cost_to_go.enabled; }

  // Returns the turn after which the way is shortest, of those after which nothing that is known
  // blocks the straight drive; no turn, and an endless way, if there is none. Where no straight
  // drive of half of what is judged leads on, one of half of that may.
  Turn BestTurn(Directions directions, const GoodnessGrid& grid, const messages::PoseEstimate& pose,
                const messages::Goal& goal, const WayToGo& way) const;
  Turn BestTurnBefore(double length_m, Directions directions, const GoodnessGrid& grid,
                      const messages::PoseEstimate& pose, const messages::Goal& goal,
                      const WayToGo& way) const;
  bool LiesInsideTightestCircle(const messages::PoseEstimate& pose,
                                const messages::Goal& goal) const;

  GestaltParams params_;
  PathSampling sampling_;
  std::vector<PathPoint> straight_;  // the places of the sampling on a straight drive
};

}  // namespace rockyard::navigation
