// Which trials of a campaign run next, and where each cell ends; which of an unfinished run may be
// shown. Sessions of a campaign take trials from a plan; readers of runs ask a plan where cells
// ended (StoredPlan in supervisor.h).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "batch/campaign.h"
#include "statistics/proportions.h"
#include "truth/record.h"

namespace rockyard::batch {

// Counts over trials 0 .. trials-1, all of which are finished.
struct PrefixCounts {
  std::int64_t trials = 0;
  std::int64_t faults = 0;
  std::int64_t measured = 0;  // no drives: neither success nor failure
  std::int64_t declared_successes = 0;

  // The trials that a success rate is about.
  std::int64_t drives() const { return trials - faults - measured; }
  PrefixCounts& operator+=(const PrefixCounts& other);
};

// Counts of any finished trials.
struct FinishedCounts {
  std::int64_t trials = 0;
  std::int64_t faults = 0;  // of these
};

// Counts what may be shown of an unfinished run. Finished trials arrive in any order; rates use
// only the contiguous prefix of their indices. Trials that fail run longer, so that over completion
// order successes would be counted too often; the prefix waits for every trial before it. Memory:
// one byte per trial.
class PrefixCounter {
 public:
  // Adds a trial, from 0 on. Returns false, and changes nothing, where the trial has been added
  // before.
  bool Add(std::int64_t trial, truth::TrialOutcome outcome);

  bool Has(std::int64_t trial) const;
  // One more than the largest trial that was added.
  std::int64_t end() const { return static_cast<std::int64_t>(outcomes_.size()); }
  // Returns the counts over from <= trial < to, all of which must be finished.
  PrefixCounts Count(std::int64_t from, std::int64_t to) const;

  // Counts the trials below `to`. Cost: linear in `to` where trials beyond it were added.
  FinishedCounts Finished(std::int64_t to) const;
  std::int64_t finished() const { return finished_.trials; }
  const PrefixCounts& prefix() const { return prefix_; }

 private:
  static constexpr std::int8_t kPending = -1;

  std::vector<std::int8_t> outcomes_;  // by trial
  FinishedCounts finished_;
  PrefixCounts prefix_;
};

// Who gets the blocks of a round.
enum class Allocation {
  kUniform,   // every cell that has not ended gets one
  kAdaptive,  // the half of them (rounded up) with the widest intervals; at a tie the first
};

// When a campaign has run enough trials of a cell: at the first block end where the interval of its
// declared success has at most this half-width. Simulator faults enter no rate. The number of
// trials depends on their outcomes, which the interval allows for
// (statistics::IntervalMethod::kStopped). A store keeps the rule.
struct StoppingRule {
  double half_width = 0.02;
  std::int64_t max_trials = 10000;  // of a cell
  std::int64_t block = 25;          // trials between two decisions
  double confidence = 0.95;
  Allocation allocation = Allocation::kUniform;
  std::int64_t budget = 0;  // of trials, all cells together; 0: none

  bool operator==(const StoppingRule&) const = default;
};

// In which order pending trials are started. No result depends on it, which kShuffled exists to
// test.
enum class Order { kNatural, kShuffled };

struct PlanOptions {
  std::optional<StoppingRule> rule{};  // none: every planned trial runs, in one round
  Order order = Order::kNatural;
  Shard shard{};
};

enum class CellEnd {
  kOpen,     // goes on
  kPlanned,  // all its planned trials are asked for
  kPrecise,  // the rule is met
  kBudget,   // the campaign's budget is used up
};

// A cell as the last decision about it left it.
struct CellState {
  CellEnd end = CellEnd::kOpen;
  std::int64_t asked = 0;                   // trials 0 .. asked-1 are to run
  PrefixCounts counts;                      // of those at the last decision; with a rule
  statistics::Interval interval{0.0, 1.0};  // of declared success; with a rule
  double half_width() const { return (interval.high - interval.low) / 2.0; }
};

// The work of a campaign in rounds. A round is decided from the outcomes of the rounds before it
// alone, all of which are finished by then, and never from the order in which trials finish. So the
// same trials run whatever threads, ranks, order and interruptions, and stored trials beyond a
// decision do not enter it.
//
// Must stay: the way of deciding. Decisions are not stored: sessions that go on and readers of a
// store (StoredPlan) decide again, so that another way would end stored cells elsewhere.
//
// Within a round the cells take turns, trial by trial. A plan draws nothing (kShuffled permutes by
// a fixed stream). Not for two threads at once. Memory: one byte per trial.
class WorkPlan {
 public:
  // `planned`: trials of each cell; with a rule, the most of them. With a rule the shard must be
  // the whole campaign.
  WorkPlan(std::vector<std::int64_t> planned, const PlanOptions& options);

  // Adds trials of earlier sessions. Call it before the first Next.
  void AddStored(std::span<const FinishedTrial> stored);

  enum class Step { kTrial, kWait, kDone };
  struct NextStep {
    Step step = Step::kDone;
    TrialId id{};  // with kTrial
  };
  // Returns what to do next. kTrial: start this trial. kWait: the round goes on; ask again when a
  // trial has finished. kDone: nothing is left. A trial is handed out once, unless it is put back.
  NextStep Next();

  // Notes the end of a trial. Returns false where the trial was finished before.
  bool Finish(TrialId id, truth::TrialOutcome outcome);

  // Puts back a trial that was handed out and will not finish where it was.
  void PutBack(TrialId id);

  int cells() const { return static_cast<int>(cells_.size()); }
  const CellState& state(int cell) const { return At(cell).state; }
  const PrefixCounter& counter(int cell) const { return At(cell).counter; }
  // The trials of the cell that this campaign (or its shard) is to finish; an open cell may need
  // less.
  std::int64_t planned(int cell) const;
  // Counts of the planned trials that are finished. What earlier sessions stored beyond them, with
  // gaps perhaps, is no part of the campaign.
  FinishedCounts finished(int cell) const;

 private:
  struct Cell {
    std::int64_t planned = 0;
    CellState state;
    PrefixCounter counter;
  };
  struct Range {
    int cell = 0;
    std::int64_t from = 0;
    std::int64_t to = 0;
  };

  const Cell& At(int cell) const { return cells_.at(static_cast<std::size_t>(cell)); }
  std::int64_t End(const Cell& cell) const;
  void BeginRound();
  void Decide(Cell& cell) const;
  std::vector<int> CellsOfNextRound() const;
  void AddRange(int cell, std::int64_t trials);
  void ListRound();
  std::optional<TrialId> NextOfRound();
  bool Pending(TrialId id) const;

  PlanOptions options_;
  std::vector<Cell> cells_;
  std::vector<Range> round_;
  std::int64_t offset_ = 0;      // of the turn in every range
  std::int64_t longest_ = 0;     // range of the round
  std::size_t range_ = 0;        // next to take a turn
  std::int64_t remaining_ = 0;   // trials of the round that are not finished
  std::vector<TrialId> listed_;  // handed out first, from the back
  std::int64_t asked_ = 0;       // of all cells
};

}  // namespace rockyard::batch
