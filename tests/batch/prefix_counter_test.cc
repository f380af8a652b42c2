#include <gtest/gtest.h>

#include <cmath>
#include <queue>
#include <vector>

#include "batch/work_plan.h"
#include "core/random.h"

namespace rockyard::batch {
namespace {

using truth::TrialOutcome;

TEST(PrefixCounter, WaitsForEveryTrialBefore) {
  PrefixCounter counter;
  counter.Add(2, TrialOutcome::kGoalReached);
  counter.Add(1, TrialOutcome::kFalseGoal);
  EXPECT_EQ(counter.finished(), 2);
  EXPECT_EQ(counter.prefix().trials, 0);
  counter.Add(0, TrialOutcome::kSimulatorFault);
  EXPECT_EQ(counter.prefix().trials, 3);
  EXPECT_EQ(counter.prefix().faults, 1);
  EXPECT_EQ(counter.prefix().declared_successes, 2);
  counter.Add(9, TrialOutcome::kJammed);
  EXPECT_EQ(counter.finished(), 4);
  EXPECT_EQ(counter.prefix().trials, 3);
}

struct Event {
  double at;
  std::int64_t trial;
  bool success;
  bool operator>(const Event& other) const { return at > other.at; }
};

// Rates seen when half of 60 trials are finished on 8 workers, where a failure takes ten times as
// long as a success, and both are equally likely.
struct Seen {
  double prefix_successes = 0.0;
  double prefix_trials = 0.0;
  double completed_successes = 0.0;
  double completed_trials = 0.0;
};

void Simulate(std::uint32_t replicate, Seen& seen) {
  constexpr std::int64_t kTrials = 60;
  constexpr std::int64_t kWorkers = 8;
  core::RandomStream stream({20, replicate}, core::Purpose::kTest);
  std::priority_queue<Event, std::vector<Event>, std::greater<>> running;
  PrefixCounter counter;
  std::int64_t next = 0;
  const auto start = [&](double now) {
    if (next == kTrials) return;
    const bool success = stream.Uniform() < 0.5;
    running.push({now + (success ? 1.0 : 10.0) * (0.5 + stream.Uniform()), next++, success});
  };
  for (std::int64_t i = 0; i < kWorkers; ++i) start(0.0);
  double completed_successes = 0.0;
  while (counter.finished() < kTrials / 2) {
    const Event event = running.top();
    running.pop();
    counter.Add(event.trial, event.success ? TrialOutcome::kGoalReached : TrialOutcome::kNoPath);
    completed_successes += event.success ? 1.0 : 0.0;
    start(event.at);
  }
  seen.prefix_successes += static_cast<double>(counter.prefix().declared_successes);
  seen.prefix_trials += static_cast<double>(counter.prefix().trials);
  seen.completed_successes += completed_successes;
  seen.completed_trials += static_cast<double>(counter.finished());
}

// The prefix is cut where an unfinished trial stands, which is a failure more often than not: the
// prefix itself then has a bias of at most one trial. Completion order is the negative control.
TEST(PrefixCounter, LongFailuresDoNotBiasTheRate) {
  Seen seen;
  constexpr std::uint32_t kReplicates = 2000;
  for (std::uint32_t i = 0; i < kReplicates; ++i) Simulate(i, seen);
  const double prefix = seen.prefix_successes / seen.prefix_trials;
  const double completed = seen.completed_successes / seen.completed_trials;
  // Standard error of the prefix rate about 0.0025: eight of them, alpha below 1e-14.
  constexpr double kTolerance = 0.02;
  EXPECT_LT(std::abs(prefix - 0.5), kTolerance);
  EXPECT_GT(std::abs(completed - 0.5), kTolerance) << "the control must show the bias";
}

}  // namespace
}  // namespace rockyard::batch
