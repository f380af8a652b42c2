// How much of a sweep's failures each of its ablations accounts for: sweeps whose axes are
// ablations are factorial experiments.
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

// What failed: trials without declared success, and those without true success, by SuccessKind.
struct SweepAttribution {
  std::string at;  // levels of the axes that are no ablations; empty where there are none
  std::array<statistics::Attribution, 2> by_success;
  std::int64_t left_out = 0;  // trials with a simulator fault in some cell, left out of all
};

// One attribution for each setting of the axes that are no ablations. Nothing for sweeps that are
// no grid, have no axis of ablations or more than statistics::kMaxFunctions, or no common random
// numbers: trials are compared in pairs. Uses the trials that every cell of a setting has.
// `outcomes` of each cell, by trial from 0 on. Intervals allow for trials that share layouts.
std::vector<SweepAttribution> AttributeSweep(const scenario::Sweep& sweep,
                                             std::span<const CellOutcomes> outcomes);

// Tables for the terminal, at most 100 columns wide. Empty where there is nothing.
std::string AttributionText(std::span<const SweepAttribution> attributions);

// attribution.csv: at, success, kind (failure_rate of a combination, share, alone, last, removed,
// remainder, effect), functions, value, low, high.
std::string AttributionCsv(std::span<const SweepAttribution> attributions);

// A JSON list with the same.
core::JsonValue AttributionJson(std::span<const SweepAttribution> attributions);

}  // namespace rockyard::report
