#include "batch/work_plan.h"

#include <algorithm>
#include <utility>

#include "core/check.h"
#include "core/random.h"
#include "statistics/proportions.h"

namespace rockyard::batch {
namespace {

// Permutes the trials (Fisher and Yates), the same way for the same length. No result depends on
// it.
void Shuffle(std::vector<TrialId>& trials) {
  core::RandomStream stream({1, 0}, core::Purpose::kTest);
  for (std::size_t left = trials.size(); left > 1; --left) {
    std::swap(trials[left - 1], trials[stream.NextU64() % left]);
  }
}

}  // namespace

WorkPlan::WorkPlan(std::vector<std::int64_t> planned, const PlanOptions& options)
    : options_(options), cells_(planned.size()) {
  EXPECT(options.shard.index >= 1 && options.shard.index <= options.shard.count);
  // A half-width of 0.5 would be met by no trials at all.
  EXPECT(!options.rule ||
         (options.shard.whole() && options.rule->block >= 1 && options.rule->half_width < 0.5));
  for (std::size_t i = 0; i < planned.size(); ++i) {
    EXPECT(planned[i] >= 0);
    cells_[i].planned = planned[i];
  }
}

void WorkPlan::AddStored(std::span<const FinishedTrial> stored) {
  EXPECT(round_.empty());
  for (const FinishedTrial& trial : stored) {
    // Trials beyond the plan are left out: single ones may lie far out, and a counter needs a byte
    // for each before them.
    if (trial.id.trial < At(trial.id.cell).planned) Finish(trial.id, trial.outcome);
  }
}

WorkPlan::NextStep WorkPlan::Next() {
  while (true) {
    if (const std::optional<TrialId> next = NextOfRound()) return {Step::kTrial, *next};
    if (remaining_ > 0) return {Step::kWait};
    BeginRound();
    if (round_.empty()) return {Step::kDone};
  }
}

bool WorkPlan::Finish(TrialId id, truth::TrialOutcome outcome) {
  const bool of_round = std::any_of(round_.begin(), round_.end(), [&](const Range& range) {
    return range.cell == id.cell && range.from <= id.trial && id.trial < range.to;
  });
  if (!cells_.at(static_cast<std::size_t>(id.cell)).counter.Add(id.trial, outcome)) return false;
  if (of_round) --remaining_;
  return true;
}

void WorkPlan::PutBack(TrialId id) {
  if (Pending(id)) listed_.push_back(id);
}

std::int64_t WorkPlan::planned(int cell) const { return options_.shard.Share(End(At(cell))); }

FinishedCounts WorkPlan::finished(int cell) const {
  const Cell& at = At(cell);
  return at.counter.Finished(End(at));
}

// Returns one more than the last trial that is planned.
std::int64_t WorkPlan::End(const Cell& cell) const {
  return cell.state.end == CellEnd::kOpen ? cell.planned : cell.state.asked;
}

void WorkPlan::BeginRound() {
  round_.clear();
  offset_ = 0;
  longest_ = 0;
  range_ = 0;
  if (!options_.rule) {
    for (int cell = 0; cell < cells(); ++cell) AddRange(cell, At(cell).planned);
  } else {
    for (Cell& cell : cells_) {
      if (cell.state.end == CellEnd::kOpen) Decide(cell);
    }
    for (const int cell : CellsOfNextRound()) AddRange(cell, options_.rule->block);
  }
  if (options_.order == Order::kShuffled) ListRound();
}

// Decides about a cell at the end of the blocks asked for, all of which are finished.
void WorkPlan::Decide(Cell& cell) const {
  CellState& state = cell.state;
  state.counts += cell.counter.Count(state.counts.trials, state.asked);
  state.interval = statistics::ProportionInterval(state.counts.declared_successes,
                                                  state.counts.drives(), options_.rule->confidence,
                                                  statistics::IntervalMethod::kStopped);
  if (state.half_width() <= options_.rule->half_width) {
    state.end = CellEnd::kPrecise;
  } else if (state.asked == cell.planned) {
    state.end = CellEnd::kPlanned;
  } else if (options_.rule->budget > 0 && asked_ >= options_.rule->budget) {
    state.end = CellEnd::kBudget;
  }
}

std::vector<int> WorkPlan::CellsOfNextRound() const {
  std::vector<int> open;
  for (int cell = 0; cell < cells(); ++cell) {
    if (state(cell).end == CellEnd::kOpen) open.push_back(cell);
  }
  if (options_.rule->allocation == Allocation::kUniform) return open;
  std::stable_sort(open.begin(), open.end(), [this](int first, int second) {
    return state(first).half_width() > state(second).half_width();
  });
  open.resize((open.size() + 1) / 2);
  return open;
}

void WorkPlan::AddRange(int cell, std::int64_t trials) {
  Cell& at = cells_[static_cast<std::size_t>(cell)];
  std::int64_t to = std::min(at.state.asked + trials, at.planned);
  const std::int64_t budget = options_.rule ? options_.rule->budget : 0;
  if (budget > 0) to = std::min(to, at.state.asked + budget - asked_);
  if (to <= at.state.asked) return;
  const Range range{cell, at.state.asked, to};
  asked_ += to - at.state.asked;
  at.state.asked = to;
  if (!options_.rule) at.state.end = CellEnd::kPlanned;
  for (std::int64_t trial = range.from; trial < range.to; ++trial) {
    if (Pending({cell, trial})) ++remaining_;
  }
  round_.push_back(range);
  longest_ = std::max(longest_, range.to - range.from);
}

void WorkPlan::ListRound() {
  std::vector<TrialId> trials;
  while (const std::optional<TrialId> next = NextOfRound()) trials.push_back(*next);
  Shuffle(trials);
  listed_ = std::move(trials);
}

std::optional<TrialId> WorkPlan::NextOfRound() {
  while (!listed_.empty()) {
    const TrialId id = listed_.back();
    listed_.pop_back();
    if (Pending(id)) return id;
  }
  for (; offset_ < longest_; ++offset_, range_ = 0) {
    while (range_ < round_.size()) {
      const Range& range = round_[range_++];
      const TrialId id{range.cell, range.from + offset_};
      if (id.trial < range.to && Pending(id)) return id;
    }
  }
  return std::nullopt;
}

bool WorkPlan::Pending(TrialId id) const {
  return options_.shard.Has(id.trial) && !At(id.cell).counter.Has(id.trial);
}

namespace {

PrefixCounts CountOf(truth::TrialOutcome outcome) {
  PrefixCounts counts;
  counts.trials = 1;
  counts.faults = outcome == truth::TrialOutcome::kSimulatorFault ? 1 : 0;
  counts.measured = outcome == truth::TrialOutcome::kMeasured ? 1 : 0;
  counts.declared_successes = truth::DeclaredSuccess(outcome) ? 1 : 0;
  return counts;
}

}  // namespace

PrefixCounts& PrefixCounts::operator+=(const PrefixCounts& other) {
  trials += other.trials;
  faults += other.faults;
  measured += other.measured;
  declared_successes += other.declared_successes;
  return *this;
}

bool PrefixCounter::Add(std::int64_t trial, truth::TrialOutcome outcome) {
  EXPECT(trial >= 0);
  if (Has(trial)) return false;
  const auto index = static_cast<std::size_t>(trial);
  if (index >= outcomes_.size()) outcomes_.resize(index + 1, kPending);
  outcomes_[index] = static_cast<std::int8_t>(outcome);
  ++finished_.trials;
  if (outcome == truth::TrialOutcome::kSimulatorFault) ++finished_.faults;
  std::int64_t prefix_end = prefix_.trials;
  while (Has(prefix_end)) ++prefix_end;
  prefix_ += Count(prefix_.trials, prefix_end);
  return true;
}

bool PrefixCounter::Has(std::int64_t trial) const {
  return trial < end() && outcomes_[static_cast<std::size_t>(trial)] != kPending;
}

FinishedCounts PrefixCounter::Finished(std::int64_t to) const {
  if (to >= end()) return finished_;
  FinishedCounts counts;
  for (std::int64_t trial = 0; trial < to; ++trial) {
    if (!Has(trial)) continue;
    ++counts.trials;
    counts.faults += Count(trial, trial + 1).faults;
  }
  return counts;
}

PrefixCounts PrefixCounter::Count(std::int64_t from, std::int64_t to) const {
  PrefixCounts counts;
  for (std::int64_t trial = from; trial < to; ++trial) {
    EXPECT(Has(trial));
    const auto outcome = outcomes_[static_cast<std::size_t>(trial)];
    counts += CountOf(static_cast<truth::TrialOutcome>(outcome));
  }
  return counts;
}

}  // namespace rockyard::batch
