// The random keys of the scenes of one run.
#pragma once

#include <cstdint>
#include <limits>
#include <stdexcept>

#include "core/random.h"

namespace rockyard::experiments {

// A key of its own for every scene of every run, so that nothing that lasts from scan to scan
// (outliers that persist) links two scenes. Throws std::out_of_range where 32 bits end.
inline core::TrialKey SceneKey(core::TrialKey run, std::int64_t scenes_per_run,
                               std::int64_t scene) {
  const std::uint64_t number =
      std::uint64_t{run.trial} * static_cast<std::uint64_t>(scenes_per_run) +
      static_cast<std::uint64_t>(scene);
  if (number > std::numeric_limits<std::uint32_t>::max()) {
    throw std::out_of_range("scenes end at 2^32 - 1, the size of their random key");
  }
  return {run.seed, static_cast<std::uint32_t>(number)};
}

}  // namespace rockyard::experiments
