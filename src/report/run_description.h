// What a report says of a run besides its records: settings, builds, and what has become of the
// planned trials. Summaries, the terminal and the report page tell it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/json_value.h"
#include "core/provenance.h"

namespace rockyard::report {

// What has become of the planned trials: planned = completed + faulted + pending.
struct Accounting {
  std::int64_t planned = 0;                // of a shard: its share
  std::int64_t completed = 0;              // stored without a fault, in any order
  std::int64_t faulted = 0;                // stored as simulator faults
  std::int64_t pending = 0;                // with a stopping rule that has not ended: at most
  std::int64_t infrastructure_faults = 0;  // failures of the machine: retried, in none of these
};

// The rule that ended the trials, or will.
struct StoppingReport {
  double half_width = 0.0;
  std::int64_t max_trials = 0;
  std::int64_t block = 0;
  double confidence = 0.95;
  std::string allocation;   // "uniform" or "adaptive"
  std::int64_t budget = 0;  // 0: none
  // "open", "precise" (the half-width is reached), "max_trials" or "budget".
  std::string end;
  // At the last decision, over trials 0 .. trials-1: declared successes of those without a fault,
  // and the interval whose half-width the rule is about.
  std::int64_t trials = 0;
  std::int64_t drives = 0;
  std::int64_t successes = 0;
  double low = 0.0;
  double high = 1.0;
};

struct RunDescription {
  std::string scenario;
  std::string fingerprint;  // of the resolved scenario
  std::string resolved;     // JSON of every effective value
  // What the scenario was changed by on the way from its file: "PATH=VALUE", "--ablate NAME".
  // Nothing: not known.
  std::optional<std::vector<std::string>> settings;
  std::vector<std::string> setup;  // of a drive, in words: rover, world, physics; what it drives by
  std::vector<std::string> ablations;  // in force (scenario/ablations.h), however they came to be
  std::string localization;  // "dead_reckoning", or "oracle": a perfect sensor, to be told apart
  std::uint64_t seed = 1;
  std::int64_t planned = 0;
  std::int64_t stored = 0;  // finished trials in the store, beyond the contiguous prefix too
  std::string trial_hash;   // over the records of the report
  core::Provenance provenance;
  std::vector<std::string> builds;  // every build that wrote trials
  int threads = 1;
  Accounting accounting;
  std::optional<StoppingReport> stopping;
  int shard_index = 1;  // of shard_count; the whole where that is 1
  int shard_count = 1;
};

// {"accounting": {planned, completed, faulted, pending, infrastructure_faults}} and, where the run
// has them, "stopping" (the rule, where it ended, the interval there) and "shard".
core::JsonValue AccountingJson(const RunDescription& run);

// The members "accounting" and "stopping" of a cell.
core::JsonValue AccountingJson(const Accounting& accounting,
                               const std::optional<StoppingReport>& stopping);

// A line for the terminal that adds up, and one for failures of the machine.
std::string AccountingText(const Accounting& accounting);

// The lines of a run's accounting, and lines for the rule.
std::string AccountingText(const RunDescription& run);

// A line that keeps a changed scenario from being taken for that of its name; empty where nothing
// was changed, or that is not known.
std::string SettingsText(const RunDescription& run);

// Returns the accounting of two cells of a campaign together.
Accounting Sum(const Accounting& first, const Accounting& second);

// Returns where the rule ended a cell, in some words: "precise enough after 40 trials, 1.0 .. 12.3
// %".
std::string StoppingPhrase(const StoppingReport& stopping);

// What a shard of a campaign of cells has.
struct ShardCell {
  std::string name;
  Accounting accounting;
};
std::string ShardCampaignJson(const std::string& name, int index, int count,
                              const std::vector<ShardCell>& cells);

// summary.json of a shard: no rates, since its trials are no contiguous prefix.
std::string ShardJson(const RunDescription& run);

// The shard for the terminal, with what to do next.
std::string ShardText(const RunDescription& run);

}  // namespace rockyard::report
