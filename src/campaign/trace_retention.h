// Which trials of a campaign leave a trace, and how.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "truth/record.h"

namespace rockyard::campaign {

// What rules ask for together: their union.
struct TraceRetention {
  bool all = false;
  bool failures = false;  // see report::FailedTrials
  std::size_t worst = 0;  // see report::WorstTrials
  double share = 0.0;     // of all trials, chosen by a hash of seed and trial

  bool any() const { return all || failures || worst > 0 || share > 0.0; }
};

enum class TraceFormat { kNpz, kCsv };

struct TraceOptions {
  std::vector<std::string> rules;  // "all", "failures", "worst:N", "share:P"
  std::string format = "npz";

  // Throws core::UserError with everything that is wrong. Of two counts or shares the larger holds.
  TraceRetention retention() const;
  TraceFormat form() const { return format == "csv" ? TraceFormat::kCsv : TraceFormat::kNpz; }
};

// Whether share:P keeps the trial: a pure function of (seed, trial), so that a campaign that is
// extended or gone on with keeps what it kept; a larger share keeps all that a smaller one does.
// SplitMix64 (Steele, Lea and Flood 2014, "Fast splittable pseudorandom number generators") mixes
// seed and trial to 53 bits.
bool IsInShare(std::uint64_t seed, std::uint64_t trial, double share);

// The trials of one cell that the rules keep, ascending. Simulator faults are never kept: they have
// no record that the trace could be held against.
std::vector<std::uint64_t> KeptTrials(const TraceRetention& retention,
                                      const truth::RecordSchema& schema,
                                      std::span<const truth::Record> records, std::uint64_t seed);

// "every failure, the 5 worst failures, 1 % of all trials" for people.
std::string RetentionText(const TraceRetention& retention);

}  // namespace rockyard::campaign
