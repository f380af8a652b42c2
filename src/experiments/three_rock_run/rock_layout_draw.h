// The numbers of a rock as they are drawn, and where they put it.
#pragma once

#include <cstdint>
#include <optional>

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

// What the streams of a trial are for: kExperiment has a substream for the goal and rock A, then
// one for each place that is tried of B, and of C.
enum class DrawnPart { kStart, kSecondRock, kThirdRock };

// The stream of the number-th try, from 0.
core::RandomStream StreamOf(DrawnPart part, std::int64_t number, core::TrialKey key);

// Uniform numbers of the prior, the next ones of `stream`.
double DrawUniform(const UniformRange& range, core::RandomStream& stream);
DrawnRock DrawRock(const RockPrior& prior, core::RandomStream& stream);

// Rock A, so that a rover on the line to the goal, whose front is front_x_m ahead of its centre,
// comes to within its gap at path_m.
PlacedRock PlaceFirstRock(const DrawnRock& rock, double path_m, double front_x_m);

// A rock beside the way that was driven: `offset_m` to the left of the rover where its centre had
// come to path_m. None where the run ended before.
std::optional<PlacedRock> PlaceOnPath(const DrawnRock& rock, double path_m,
                                      const RunHistory& history);

}  // namespace rockyard::experiments
