// How much of a sweep's failures each of its ablations accounts for: a sweep whose axes are
// ablations is a factorial experiment. The table, summary.json and attribution.csv of such sweeps
// tell it. No exit code depends on it; programs of others read the columns of the CSV.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/json_value.h"
#include "report/trial_outcomes.h"
#include "scenario/sweep.h"
#include "statistics/attribution.h"

namespace rockyard::report {

// The attributions at one setting of the other axes: of trials without declared success, and of
// those without true success, by SuccessKind.
struct SweepAttribution {
  std::string at;  // levels of the axes that are no ablations; empty where there are none
  std::array<statistics::Attribution, 2> by_success;
  std::int64_t left_out = 0;  // trials with a simulator fault in some cell, left out of all
};

// Returns one attribution for each setting of the axes that are no ablations, and none for sweeps
// that are no grid, have no axis of ablations or more than statistics::kMaxFunctions, or no common
// random numbers: trials are compared in pairs. Uses the trials that every cell of a setting has.
// `outcomes` are those of each cell, by trial from 0 on. Intervals allow for trials that share
// layouts.
std::vector<SweepAttribution> AttributeSweep(const scenario::Sweep& sweep,
                                             std::span<const CellOutcomes> outcomes);

// Tables for the terminal, at most 100 columns wide. Empty where there is nothing.
std::string AttributionText(std::span<const SweepAttribution> attributions);

// attribution.csv: at, success, kind (failure_rate of a combination, share, alone, last, removed,
// remainder, effect), functions, value, low, high.
std::string AttributionCsv(std::span<const SweepAttribution> attributions);

// A JSON list: the rows of AttributionCsv by setting and success, with trials, left_out and
// sum_of_alone.
core::JsonValue AttributionJson(std::span<const SweepAttribution> attributions);

}  // namespace rockyard::report
