// The random keys of a mission: one of the mission as a whole, one of each of its sols.
#pragma once

#include <cstdint>

#include "core/random.h"
#include "experiments/mission/mission_params.h"

namespace rockyard::experiments {

// The key of a sol, from 0: trial number mission * kMostSols + sol of the same seed, so that no two
// sols share a stream. What lasts a mission (rocks, ground, pan error, what the lander's fixes have
// in common) is drawn by the key of the mission itself, with purposes that no sol draws by its own.
// Missions of one seed and number meet the same noise sol by sol, whatever aids they have.
inline core::TrialKey SolKey(core::TrialKey mission, std::int64_t sol) {
  return {mission.seed, mission.trial * kMostSols + static_cast<std::uint32_t>(sol)};
}

}  // namespace rockyard::experiments
