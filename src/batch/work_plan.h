// Which trials of a campaign run next, and where each cell ends.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "batch/campaign.h"
#include "batch/prefix_counter.h"
#include "batch/stopping_rule.h"
#include "statistics/proportions.h"

namespace rockyard::batch {

// In which order pending trials are started. No result depends on it; kShuffled exists to test
// that.
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
// alone, all of which are finished by then, and never from the order in which trials finish: the
// same trials run whatever threads, ranks, order and interruptions, and stored trials beyond a
// decision do not enter it. Within a round the cells take turns, trial by trial. Not for two
// threads at once. Draws nothing (kShuffled permutes by a fixed stream). Memory: one byte per
// trial.
class WorkPlan {
 public:
  // `planned`: trials of each cell, with a rule at most. With a rule the shard must be the whole.
  WorkPlan(std::vector<std::int64_t> planned, const PlanOptions& options);

  // Trials of earlier sessions. Before the first Next.
  void AddStored(std::span<const FinishedTrial> stored);

  enum class Step { kTrial, kWait, kDone };
  struct NextStep {
    Step step = Step::kDone;
    TrialId id{};  // with kTrial
  };
  // kTrial: start this one. kWait: the round goes on; ask again when a trial has finished. kDone:
  // nothing is left. A trial is handed out once, unless it is put back.
  NextStep Next();

  // False where the trial was finished before.
  bool Finish(TrialId id, truth::TrialOutcome outcome);

  // A trial that was handed out and will not finish where it was.
  void PutBack(TrialId id);

  int cells() const { return static_cast<int>(cells_.size()); }
  const CellState& state(int cell) const { return At(cell).state; }
  const PrefixCounter& counter(int cell) const { return At(cell).counter; }
  // Trials of the cell that this campaign (or its shard) is to finish; an open cell may need less.
  std::int64_t planned(int cell) const;
  // Of those planned. What earlier sessions stored beyond them, with gaps perhaps, is no part of
  // the campaign.
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
