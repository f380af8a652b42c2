// What a run of an experiment gives, whatever happens in it, and the random keys of its scenes.
#pragma once

#include <cstdint>
#include <exception>
#include <limits>
#include <stdexcept>

#include "core/error.h"
#include "core/random.h"
#include "truth/record.h"

namespace rockyard::experiments {

// The record that `measure` gives of the trial's key. What it throws comes back as a simulator
// fault, but for failures of the machine, which tell nothing of the trial: they are thrown on.
template <typename Measure>
truth::Record RecordOf(std::uint64_t seed, std::uint64_t index, const Measure& measure) {
  try {
    if (index > std::numeric_limits<std::uint32_t>::max()) {
      throw std::out_of_range("trial indices end at 2^32 - 1, the size of their random key");
    }
    return measure(core::TrialKey{seed, static_cast<std::uint32_t>(index)});
  } catch (const std::exception& error) {
    if (core::IsMachineFailure(error)) throw;
    return truth::MakeFault(seed, index, error.what());
  }
}

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
