// `rockyard bench verify`: whether the run of an entry is what it says. The chain is made again
// from all records and actions; drives are driven again from their actions, whoever decided, and
// have to give their records bit for bit.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "campaign/bench/bench.h"
#include "campaign/stop.h"
#include "campaign/work.h"

namespace rockyard::campaign {

struct BenchVerifyRequest {
  std::filesystem::path folder;
  std::string suite = {};            // a sweep file or its name; "": bench/ and the name in the run
  std::filesystem::path entry = {};  // to be held against what drove; "": it is not at hand
  std::int64_t sample = 300;         // drives that are driven again; all where there are no more
  std::uint64_t seed = 0;            // of the choice of these drives: not to be known to the entry
  int threads = 0;                   // 0: as many as the machine runs at once
};

struct BenchVerification {
  BenchRun run;
  std::int64_t drives = 0;
  std::int64_t driven_again = 0;
  // Of the sample, drives that cannot be driven again: their navigator ended its process, or the
  // simulator failed.
  std::int64_t not_driven = 0;
  std::vector<std::string> findings;  // sentences; none: nothing is wrong

  // Returns the chance that a run of which this share of the drives is invented has none of them in
  // the sample.
  double ChanceToMiss(double share) const;
};

// Verifies; asks a plugin or process of the entry for its description. `progress` is told of
// drives, by one thread at a time. The findings are told in the order of cells and trials, ten at
// the most of each kind. Throws core::UserError where the folder holds no run of an entry, or where
// another build of the program made it: physics of one build is driven again by that build.
BenchVerification VerifyBench(
    const BenchVerifyRequest& request,
    const std::function<void(std::size_t done, std::size_t planned)>& progress = {},
    const Stop& stop = {});

}  // namespace rockyard::campaign
