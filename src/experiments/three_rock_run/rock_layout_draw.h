// The numbers of one layout of three rocks, and where they put the rocks.
#pragma once

#include <optional>
#include <vector>

#include "core/random.h"
#include "experiments/three_rock_run/run_history.h"
#include "experiments/three_rock_run/three_rock_run_params.h"

namespace rockyard::experiments {

// A rock as it is drawn: `offset_m` is its centre beside the rover's way, to the left.
struct DrawnRock {
  double along_m = 0.0;  // A: gap before the rover; B: path to it; C: path from B to it
  double offset_m = 0.0;
  double diameter_m = 0.0;
  double height_m = 0.0;
};

struct DrawnLayout {
  double goal_m = 0.0;
  DrawnRock a, b, c;
};

// Draws from stream kExperiment, substream 0, of the trial: thirteen uniform numbers.
DrawnLayout DrawLayout(const ThreeRockPrior& prior, core::TrialKey key);

// Rock A, so that a rover on the line to the goal, whose front is front_x_m ahead of its centre,
// comes to within its gap at path_m.
PlacedRock PlaceFirstRock(const DrawnRock& rock, double path_m, double front_x_m);

// A rock beside the way that was driven: `offset_m` to the left of the rover where its centre had
// come to path_m. None where the run ended before.
std::optional<PlacedRock> PlaceOnPath(const DrawnRock& rock, double path_m,
                                      const RunHistory& history);

}  // namespace rockyard::experiments
