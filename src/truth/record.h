/// @file
/// The record of one finished trial, independent of the experiment that made it. Experiments write
/// records; stores, summaries, comparisons and reports read them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "truth/value_table.h"

namespace rockyard::truth {

/// How a trial ended. Must stay: the names of kTrialOutcomeNames, by which stores keep outcomes;
/// append only.
enum class TrialOutcome {
  kGoalReached,  ///< believed and truly within tolerance
  kFalseGoal,    ///< believed only
  kTipOver,
  kHighCentred,
  kJammed,
  kNoPath,
  kEnergyDepleted,
  kTimeLimit,
  kLeftArena,
  kSimulatorFault,  ///< NaN, solver blow-up, exception: counted apart, never a failure of the rover
  kMeasured,        ///< no drive: the record holds measurements of a sensor
  kExcessiveSlip,   ///< stopped, as its wheels were seen to slip too much
  kNavigatorFault,  ///< a plugin or process that decides failed: a failure of the rover's software
};

/// The names of outcomes in stores and files, in the order of TrialOutcome.
inline constexpr std::array<std::string_view, 13> kTrialOutcomeNames = {
    "goal_reached", "false_goal",      "tip_over",       "high_centred", "jammed",
    "no_path",      "energy_depleted", "time_limit",     "left_arena",   "simulator_fault",
    "measured",     "excessive_slip",  "navigator_fault"};

/// Returns the name of an outcome.
constexpr std::string_view Name(TrialOutcome outcome) {
  return kTrialOutcomeNames[static_cast<std::size_t>(outcome)];
}

/// Returns whether the rover declared arrival: the success of Matthies 1995, section 7.
constexpr bool DeclaredSuccess(TrialOutcome outcome) {
  return outcome == TrialOutcome::kGoalReached || outcome == TrialOutcome::kFalseGoal;
}

/// Returns whether the rover arrived by its own belief and in truth.
constexpr bool TrueSuccess(TrialOutcome outcome) { return outcome == TrialOutcome::kGoalReached; }

/// Returns whether the rover was found unable to move.
constexpr bool IsStuck(TrialOutcome outcome) {
  return outcome == TrialOutcome::kJammed || outcome == TrialOutcome::kHighCentred;
}

/// What a column is within a cell, where records of one cell add up (truth/measurement_record.h).
/// Stores keep no roles: when records are read, experiments give the roles again by the names of
/// columns.
enum class ColumnRole {
  kValue,      ///< a value of one trial: nothing adds it up
  kFactor,     ///< constant within a cell
  kTrials,     ///< a base: how many independent trials there were
  kBase,       ///< how often something could have happened, in trials that depend on each other
  kCount,      ///< how often it happened: with the base `of` a rate
  kMainCount,  ///< as kCount, and the count to show where there is room for one
  kSum,        ///< adds up to a mean per `of`
  kSquares,    ///< squares add up to a root mean square per `of`
};

/// One column of a record.
struct ValueInfo {
  std::string name;                      ///< with unit suffix, e.g. "true_distance_m"
  std::string unit;                      ///< "m", "s", "1", ...
  std::string meaning;                   ///< one sentence
  ColumnRole role = ColumnRole::kValue;  ///< how records of a cell add it up
  std::string of = {};  ///< name of the base, or of the count, that a count or a sum refers to
};

/// The columns of every record of one experiment, in order.
using RecordSchema = std::vector<ValueInfo>;

/// Return the name of the column that holds what a navigator counts for itself, and whether a
/// column has such a name. No other column has a dot in its name.
inline std::string OwnColumn(std::string_view navigator, std::string_view value) {
  return std::string(navigator) + "." + std::string(value);
}
constexpr bool IsOwnColumn(std::string_view name) {
  return name.find('.') != std::string_view::npos;
}

/// What is kept of one trial.
struct Record {
  std::uint64_t trial = 0;  ///< index in the campaign
  TrialOutcome outcome = TrialOutcome::kSimulatorFault;
  std::string detail;   ///< a sentence for people: why it ended
  RecordValues values;  ///< one for each column; NaN where undefined; empty for simulator faults
};

/// Returns whether the simulator failed, not the rover.
inline bool IsFault(const Record& record) {
  return record.outcome == TrialOutcome::kSimulatorFault;
}

/// Returns the record of a drive whose navigator ended the process that ran it: nothing of it was
/// measured, so that every value is NaN. `columns`: of the schema.
inline Record MakeNavigatorCrash(std::uint64_t trial, std::string detail, std::size_t columns) {
  return {trial, TrialOutcome::kNavigatorFault, std::move(detail),
          std::vector<double>(columns, std::numeric_limits<double>::quiet_NaN())};
}

/// Returns whether nothing of a drive was measured since its navigator ended the process that ran
/// it. Whoever drove it again would lose a process, too.
inline bool IsNavigatorCrash(const Record& record) {
  return record.outcome == TrialOutcome::kNavigatorFault &&
         std::none_of(record.values.begin(), record.values.end(),
                      [](double value) { return std::isfinite(value); });
}

/// Makes the record of a fault; its detail says how to run that trial again.
inline Record MakeFault(std::uint64_t seed, std::uint64_t trial, const std::string& reason) {
  return {trial,
          TrialOutcome::kSimulatorFault,
          reason + " (seed " + std::to_string(seed) + ", trial " + std::to_string(trial) + ")",
          {}};
}

}  // namespace rockyard::truth
