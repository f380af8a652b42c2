// How the trials of a sweep's cells ended: all that comparing cells needs.
#pragma once

#include <array>
#include <cstdint>
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

}  // namespace rockyard::report
