// How the trials of a sweep's cells ended, which is all that comparing cells needs. Which trials of
// a run to look at first, and one that stands for each way in which they ended: campaigns keep
// traces of these, and the report page replays them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "scenario/sweep.h"
#include "statistics/clustered_rate.h"
#include "statistics/proportions.h"
#include "truth/record.h"

namespace rockyard::report {

enum class SuccessKind { kDeclared, kTrue };
inline constexpr std::array<std::string_view, 2> kSuccessNames{"declared success", "true success"};

// One byte per trial, for trials 0, 1, 2, ... of a cell. Trials on one layout of rocks
// (course.trials_per_layout) hang together.
class CellOutcomes {
 public:
  CellOutcomes() = default;
  explicit CellOutcomes(std::span<const truth::Record> records, std::int64_t per_layout = 1);

  std::size_t size() const { return outcomes_.size(); }
  bool IsFault(std::size_t trial) const {
    return Outcome(trial) == truth::TrialOutcome::kSimulatorFault;
  }
  bool Succeeded(std::size_t trial, SuccessKind kind) const;

  std::size_t per_layout() const { return per_layout_; }
  bool SharesLayouts() const { return per_layout_ > 1; }

  // The layout of each trial; empty where none share one.
  std::vector<std::size_t> Groups() const;

  // Successes and trials of each layout, faults left out.
  std::vector<statistics::CountOfRun> ByLayout(SuccessKind kind) const;

  // Records without values.
  std::vector<truth::Record> Records() const;

 private:
  truth::TrialOutcome Outcome(std::size_t trial) const {
    return static_cast<truth::TrialOutcome>(outcomes_[trial]);
  }

  std::vector<std::uint8_t> outcomes_;
  std::size_t per_layout_ = 1;
};

// Returns the trials that ended other than goal_reached, simulator faults and measurements left
// out: the failures of the rover. By trial number. Here and in the next two, a trial whose
// navigator ended the process that ran it (truth::IsNavigatorCrash) is left out, too: these trials
// are driven again to be shown, and it would end that process as well.
std::vector<std::uint64_t> FailedTrials(std::span<const truth::Record> records);

// Returns true_goal_distance_m of the record, whose schema has it in that column; infinity where it
// is not finite or not there: unknown is as far as can be.
double GoalDistanceOrInfinity(const truth::Record& record, std::optional<std::size_t> column);

// Returns at most `most` failed trials, those that ended furthest from the goal
// (true_goal_distance_m) first (where that is unknown, before all others), ties by trial number; by
// trial number alone where the schema has no such column. Must stay a function of the records
// alone, so that a run that is gone on with writes the traces that are missing.
std::vector<std::uint64_t> WorstTrials(const truth::RecordSchema& schema,
                                       std::span<const truth::Record> records, std::size_t most);

// Returns a trial for each outcome that occurs, but for simulator faults and measurements: the one
// whose true_distance_m is the median of that outcome's (the lower of two, and of equals the one
// with the lowest number), neither the best of them nor the worst. Commonest outcome first. Without
// that column it is the trial in the middle of their numbers. Cost: n log n.
std::vector<std::uint64_t> ExampleTrials(const truth::RecordSchema& schema,
                                         std::span<const truth::Record> records);

}  // namespace rockyard::report
