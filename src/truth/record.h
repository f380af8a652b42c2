// The record of one finished trial, independent of the experiment that made it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rockyard::truth {

// How a trial ended. Stored by name; append only.
enum class TrialOutcome {
  kGoalReached,  // believed and truly within tolerance
  kFalseGoal,    // believed only
  kTipOver,
  kHighCentred,
  kJammed,
  kNoPath,
  kEnergyDepleted,
  kTimeLimit,
  kLeftArena,
  kSimulatorFault,  // NaN, solver blow-up, exception: counted apart, never a failure of the rover
  kMeasured,        // no drive: the record holds measurements of a sensor
};

inline constexpr std::array<std::string_view, 11> kTrialOutcomeNames = {
    "goal_reached",    "false_goal", "tip_over",   "high_centred",    "jammed",  "no_path",
    "energy_depleted", "time_limit", "left_arena", "simulator_fault", "measured"};

constexpr std::string_view Name(TrialOutcome outcome) {
  return kTrialOutcomeNames[static_cast<std::size_t>(outcome)];
}

// Believed to have arrived: the success of Matthies 1995, section 7.
constexpr bool DeclaredSuccess(TrialOutcome outcome) {
  return outcome == TrialOutcome::kGoalReached || outcome == TrialOutcome::kFalseGoal;
}

// One column of a record.
struct ValueInfo {
  std::string name;  // with unit suffix, e.g. "true_distance_m"
  std::string unit;  // "m", "s", "1", ...
  std::string meaning;
};

// Names, in order, of the values of every record of one experiment.
using RecordSchema = std::vector<ValueInfo>;

struct Record {
  std::uint64_t trial = 0;
  TrialOutcome outcome = TrialOutcome::kSimulatorFault;
  std::string detail;          // a sentence for people: why it ended
  std::vector<double> values;  // as RecordSchema; NaN where undefined; empty for simulator faults
};

// The simulator failed, not the rover.
inline bool IsFault(const Record& record) {
  return record.outcome == TrialOutcome::kSimulatorFault;
}

// The record of a fault; its detail says how to run that trial again.
inline Record MakeFault(std::uint64_t seed, std::uint64_t trial, const std::string& reason) {
  return {trial,
          TrialOutcome::kSimulatorFault,
          reason + " (seed " + std::to_string(seed) + ", trial " + std::to_string(trial) + ")",
          {}};
}

}  // namespace rockyard::truth
