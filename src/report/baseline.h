// Baselines: what a campaign gave, kept in the repository so that later builds can be held against
// it. `rockyard baseline` writes them, `rockyard check` reads them. Must stay, as later builds read
// what earlier ones wrote: letters of outcomes and names of metrics. A new outcome gets a letter of
// its own. Values are rounded when they are written, as the check rounds those of the run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/json_value.h"
#include "statistics/regression.h"
#include "truth/record.h"

namespace rockyard::report {

inline constexpr std::string_view kBaselineKind = "rockyard_baseline";

// A letter for each outcome, in the order of truth::TrialOutcome.
inline constexpr std::string_view kOutcomeLetters = "GFTHJNELAXMSV";
static_assert(kOutcomeLetters.size() == truth::kTrialOutcomeNames.size());

// One cell of a campaign.
struct BaselineCell {
  std::string name;         // "" in a campaign of one cell
  std::string scenario;     // name
  std::string fingerprint;  // of the resolved scenario
  std::string resolved;     // JSON of every effective value
  std::uint64_t seed = 1;
  std::string trial_hash;  // over the records that the baseline is of
  std::vector<truth::TrialOutcome> outcomes;
  std::vector<statistics::BaselineMetric> metrics;
};

struct Baseline {
  std::string name;
  std::string reason;  // why it was made, or made anew
  std::string build;
  std::vector<BaselineCell> cells;
};

// Fills outcomes and metrics from the records 0, 1, 2, ... of the cell: every metric that a trial
// has a value of, what navigators count for themselves among them, rounded (RoundForBaseline), with
// its default margin.
void FillBaselineCell(const truth::RecordSchema& schema, std::span<const truth::Record> records,
                      BaselineCell& cell);

// JSON: {"kind": "rockyard_baseline", "schema_version": 1, "name", "reason", "build", "cells":
// [...]}. A cell has name, scenario, fingerprint, seed (decimal text), trial_hash, outcomes (a
// letter for each trial, kOutcomeLetters: G goal_reached, F false_goal, T tip_over, H high_centred,
// J jammed, N no_path, E energy_depleted, L time_limit, A left_arena, X simulator_fault, S
// excessive_slip, V navigator_fault), margins (by metric), metrics (by metric a list with a number
// or null for each trial; rates of outcomes follow from outcomes), resolved. Some 250 bytes for
// each trial.
std::string BaselineJson(const Baseline& baseline);

// Whether a JSON document says that it is a baseline.
bool IsBaseline(const core::JsonValue& json);

// Reads a baseline. Throws core::UserError with every problem and its JSON path. Metrics that this
// program does not know are left out: `unknown` gets their names. What navigators count is known
// by the form of its name alone.
Baseline ParseBaseline(const core::JsonValue& json, std::vector<std::string>* unknown = nullptr);

}  // namespace rockyard::report
