#include "batch/work_plan.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "core/random.h"
#include "statistics/proportions.h"

namespace rockyard::batch {
namespace {

using truth::TrialOutcome;

constexpr StoppingRule kRule{.half_width = 0.1, .max_trials = 2000, .block = 50};

// Cells with success rates of their own; a few faults. Pure functions of cell and trial.
TrialOutcome OutcomeOf(TrialId id) {
  constexpr double kRates[] = {0.95, 0.5, 0.999, 0.2, 0.7};
  core::RandomStream stream(
      {static_cast<std::uint64_t>(id.cell) + 1, static_cast<std::uint32_t>(id.trial)},
      core::Purpose::kTest);
  if (stream.Uniform() < 0.02) return TrialOutcome::kSimulatorFault;
  return stream.Uniform() < kRates[id.cell] ? TrialOutcome::kGoalReached : TrialOutcome::kNoPath;
}

std::vector<std::vector<std::int64_t>> Sets(const WorkPlan& plan,
                                            const std::set<std::pair<int, std::int64_t>>& ran) {
  std::vector<std::vector<std::int64_t>> sets(static_cast<std::size_t>(plan.cells()));
  for (const auto& [cell, trial] : ran) sets[static_cast<std::size_t>(cell)].push_back(trial);
  return sets;
}

// Runs a plan with `workers` trials in flight, which finish in an order of their own.
std::vector<std::vector<std::int64_t>> RunPlan(WorkPlan& plan, std::size_t workers,
                                               std::uint64_t order) {
  core::RandomStream stream({order, 7}, core::Purpose::kTest);
  std::vector<TrialId> flying;
  std::set<std::pair<int, std::int64_t>> ran;
  while (true) {
    WorkPlan::NextStep next{WorkPlan::Step::kWait};
    while (flying.size() < workers) {
      next = plan.Next();
      if (next.step != WorkPlan::Step::kTrial) break;
      EXPECT_TRUE(ran.insert({next.id.cell, next.id.trial}).second) << "handed out twice";
      flying.push_back(next.id);
    }
    if (flying.empty()) {
      EXPECT_EQ(next.step, WorkPlan::Step::kDone);
      return Sets(plan, ran);
    }
    const std::size_t done = stream.NextU64() % flying.size();
    EXPECT_TRUE(plan.Finish(flying[done], OutcomeOf(flying[done])));
    flying.erase(flying.begin() + static_cast<std::ptrdiff_t>(done));
  }
}

std::vector<std::int64_t> UpTo(std::int64_t count) {
  std::vector<std::int64_t> trials;
  for (std::int64_t i = 0; i < count; ++i) trials.push_back(i);
  return trials;
}

TEST(WorkPlan, FixedNumbersRunOnceInTurns) {
  WorkPlan plan({3, 1, 2}, {});
  std::vector<TrialId> order;
  for (auto next = plan.Next(); next.step == WorkPlan::Step::kTrial; next = plan.Next()) {
    order.push_back(next.id);
  }
  EXPECT_THAT(order, testing::ElementsAre(TrialId{0, 0}, TrialId{1, 0}, TrialId{2, 0},
                                          TrialId{0, 1}, TrialId{2, 1}, TrialId{0, 2}));
  EXPECT_EQ(plan.Next().step, WorkPlan::Step::kWait);
  for (const TrialId& id : order) plan.Finish(id, TrialOutcome::kGoalReached);
  EXPECT_EQ(plan.Next().step, WorkPlan::Step::kDone);
  EXPECT_FALSE(plan.Finish({0, 0}, TrialOutcome::kGoalReached)) << "it has been finished before";
  EXPECT_EQ(plan.finished(0).trials + plan.finished(1).trials + plan.finished(2).trials, 6);
}

TEST(WorkPlan, WhatIsStoredDoesNotRunAndWhatIsPutBackDoes) {
  WorkPlan plan({4}, {});
  plan.AddStored(std::vector<FinishedTrial>{{{0, 1}, TrialOutcome::kNoPath}});
  EXPECT_EQ(plan.Next().id, (TrialId{0, 0}));
  EXPECT_EQ(plan.Next().id, (TrialId{0, 2}));
  plan.PutBack({0, 0});
  EXPECT_EQ(plan.Next().id, (TrialId{0, 0}));
  EXPECT_EQ(plan.Next().id, (TrialId{0, 3}));
  plan.PutBack({0, 1});
  EXPECT_EQ(plan.Next().step, WorkPlan::Step::kWait) << "trial 1 is finished";
}

TEST(WorkPlan, ShardsShareEveryTrialOnce) {
  std::multiset<std::int64_t> seen;
  for (int index = 1; index <= 4; ++index) {
    WorkPlan plan({10, 3}, {.shard = {index, 4}});
    std::int64_t planned = 0;
    for (auto next = plan.Next(); next.step == WorkPlan::Step::kTrial; next = plan.Next()) {
      seen.insert(next.id.cell * 100 + next.id.trial);
      ++planned;
    }
    EXPECT_EQ(plan.planned(0) + plan.planned(1), planned);
  }
  EXPECT_EQ(seen.size(), 13U);
  EXPECT_EQ(std::set<std::int64_t>(seen.begin(), seen.end()).size(), 13U);
}

class RulePlan : public testing::TestWithParam<Allocation> {
 protected:
  PlanOptions Options(std::int64_t budget = 0, Order order = Order::kNatural) const {
    PlanOptions options;
    options.rule = kRule;
    options.rule->allocation = GetParam();
    options.rule->budget = budget;
    options.order = order;
    return options;
  }
  const std::vector<std::int64_t> planned_{2000, 2000, 2000, 2000, 80};
};

// The same trials run, whoever finishes when.
TEST_P(RulePlan, DecidesTheSameWhateverTheOrder) {
  for (const std::int64_t budget : {0, 777}) {
    WorkPlan plain(planned_, Options(budget));
    const auto expected = RunPlan(plain, 1, 1);
    for (std::uint64_t order = 2; order < 8; ++order) {
      const bool shuffled = order % 2 == 0;
      WorkPlan plan(planned_, Options(budget, shuffled ? Order::kShuffled : Order::kNatural));
      EXPECT_EQ(RunPlan(plan, 3 * order, order), expected) << budget << " " << order;
      for (int cell = 0; cell < plan.cells(); ++cell) {
        EXPECT_EQ(plan.state(cell).end, plain.state(cell).end);
        EXPECT_EQ(plan.state(cell).interval.low, plain.state(cell).interval.low);
      }
    }
  }
}

// A resumed campaign makes the decisions that it had made, from any part of the trials.
TEST_P(RulePlan, DecidesTheSameWhenItGoesOn) {
  WorkPlan plain(planned_, Options());
  const auto expected = RunPlan(plain, 1, 1);
  core::RandomStream stream({3, 9}, core::Purpose::kTest);
  for (int part = 0; part < 5; ++part) {
    std::vector<FinishedTrial> stored;
    std::vector<std::vector<std::int64_t>> missing(planned_.size());
    for (std::size_t cell = 0; cell < expected.size(); ++cell) {
      for (const std::int64_t trial : expected[cell]) {
        const TrialId id{static_cast<int>(cell), trial};
        if (stream.Uniform() < 0.25 * part) {
          stored.push_back({id, OutcomeOf(id)});
        } else {
          missing[cell].push_back(trial);
        }
      }
    }
    WorkPlan plan(planned_, Options());
    plan.AddStored(stored);
    EXPECT_EQ(RunPlan(plan, 4, 5), missing) << part;
  }
}

// What is stored beyond the decisions, with gaps, neither enters them nor is finished or planned.
TEST_P(RulePlan, DecidesTheSameWhateverIsStoredBeyond) {
  WorkPlan plain(planned_, Options());
  const auto expected = RunPlan(plain, 1, 1);
  WorkPlan plan(planned_, Options());
  for (int cell = 0; cell < plan.cells(); ++cell) {
    // All that goes wrong beyond would change every decision that looked at it.
    const std::int64_t asked = plain.state(cell).asked;
    for (std::int64_t trial = asked; trial < asked + 400; ++trial) {
      if (trial % 50 == 49) continue;
      const TrialId id{cell, trial};
      plan.AddStored(std::vector<FinishedTrial>{{id, TrialOutcome::kSimulatorFault}});
    }
    if (cell == 1) plan.AddStored(std::vector<FinishedTrial>{{{cell, 3}, OutcomeOf({cell, 3})}});
  }
  auto missing = expected;
  std::erase(missing[1], 3);
  EXPECT_EQ(RunPlan(plan, 4, 5), missing);
  for (int cell = 0; cell < plan.cells(); ++cell) {
    const CellState& state = plan.state(cell);
    EXPECT_EQ(state.end, plain.state(cell).end);
    EXPECT_EQ(state.asked, plain.state(cell).asked);
    EXPECT_EQ(state.counts.trials, plain.state(cell).counts.trials);
    EXPECT_EQ(state.interval.low, plain.state(cell).interval.low);
    EXPECT_EQ(state.interval.high, plain.state(cell).interval.high);
    EXPECT_EQ(plan.planned(cell), state.asked);
    EXPECT_EQ(plan.finished(cell).trials, state.asked);
    EXPECT_EQ(plan.finished(cell).faults, plain.finished(cell).faults);
  }
}

// Each cell ends at the first block end that meets the rule; nothing beyond it is asked for.
TEST_P(RulePlan, EndsAtTheFirstBlockThatMeetsTheRule) {
  WorkPlan plan(planned_, Options());
  const auto ran = RunPlan(plan, 5, 3);
  for (int cell = 0; cell < plan.cells(); ++cell) {
    const std::int64_t asked = plan.state(cell).asked;
    EXPECT_EQ(ran[static_cast<std::size_t>(cell)], UpTo(asked)) << "a contiguous prefix";
    EXPECT_EQ(plan.planned(cell), asked);
    std::int64_t successes = 0;
    std::int64_t drives = 0;
    for (std::int64_t trial = 0; trial < asked; ++trial) {
      if (trial > 0 && trial % kRule.block == 0) {
        const auto earlier = statistics::ProportionInterval(successes, drives, kRule.confidence,
                                                            statistics::IntervalMethod::kStopped);
        EXPECT_GT(earlier.high - earlier.low, 2.0 * kRule.half_width) << cell << " " << trial;
      }
      const TrialOutcome outcome = OutcomeOf({cell, trial});
      if (outcome == TrialOutcome::kSimulatorFault) continue;
      ++drives;
      if (truth::DeclaredSuccess(outcome)) ++successes;
    }
    EXPECT_EQ(plan.state(cell).counts.declared_successes, successes);
    EXPECT_EQ(plan.state(cell).counts.drives(), drives);
    EXPECT_EQ(plan.state(cell).end, asked == planned_[static_cast<std::size_t>(cell)]
                                        ? CellEnd::kPlanned
                                        : CellEnd::kPrecise);
  }
  EXPECT_EQ(plan.state(4).end, CellEnd::kPlanned);
  EXPECT_EQ(plan.state(4).asked, 80) << "the last block is short";
}

TEST_P(RulePlan, KeepsTheBudget) {
  WorkPlan plan(planned_, Options(333));
  std::size_t ran = 0;
  for (const auto& cell : RunPlan(plan, 4, 3)) ran += cell.size();
  EXPECT_EQ(ran, 333U);
  EXPECT_EQ(plan.state(1).end, CellEnd::kBudget);
}

INSTANTIATE_TEST_SUITE_P(Allocations, RulePlan,
                         testing::Values(Allocation::kUniform, Allocation::kAdaptive));

// What adaptive allocation is for: with the same budget the widest interval is narrower.
TEST(Allocation, AdaptiveSpendsTrialsWhereTheyAreNeeded) {
  double widest[2] = {0.0, 0.0};
  for (const Allocation allocation : {Allocation::kUniform, Allocation::kAdaptive}) {
    PlanOptions options;
    options.rule = {.half_width = 0.01, .block = 20, .allocation = allocation, .budget = 2000};
    WorkPlan plan({5000, 5000, 5000, 5000, 5000}, options);
    RunPlan(plan, 2, 1);
    for (int cell = 0; cell < plan.cells(); ++cell) {
      double& most = widest[static_cast<std::size_t>(allocation)];
      most = std::max(most, plan.state(cell).half_width());
    }
    EXPECT_LT(plan.state(2).asked, plan.state(1).asked + (allocation == Allocation::kUniform));
  }
  EXPECT_LT(widest[1], 0.95 * widest[0]);
}

}  // namespace
}  // namespace rockyard::batch
