// What a report says of a run besides its records.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/provenance.h"

namespace rockyard::report {

struct RunDescription {
  std::string scenario;
  std::string fingerprint;             // of the resolved scenario
  std::string resolved;                // JSON of every effective value
  std::vector<std::string> ablations;  // in force (scenario/ablations.h), however they came to be
  std::string localization;  // "dead_reckoning", or "oracle": a perfect sensor, to be told apart
  std::uint64_t seed = 1;
  std::int64_t planned = 0;
  std::int64_t stored = 0;  // finished trials in the store, beyond the contiguous prefix too
  std::string trial_hash;   // over the records of the report
  core::Provenance provenance;
  std::vector<std::string> builds;  // every build that wrote trials
  int threads = 1;
};

}  // namespace rockyard::report
