#include "campaign/trace_retention.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "core/refusals.h"

namespace rockyard::campaign {
namespace {

using testing::IsSubsetOf;
using testing::SizeIs;
using truth::TrialOutcome;

const truth::RecordSchema kSchema{{"true_goal_distance_m", "m", ""}};

// Every third trial fails, every tenth is a fault of the simulator.
std::vector<truth::Record> Records(std::uint64_t trials) {
  std::vector<truth::Record> records;
  for (std::uint64_t i = 0; i < trials; ++i) {
    if (i % 10 == 9) {
      records.push_back({i, TrialOutcome::kSimulatorFault, "", {}});
    } else {
      const double distance_m = static_cast<double>((i * 7919) % 101);
      records.push_back(
          {i, i % 3 == 0 ? TrialOutcome::kNoPath : TrialOutcome::kGoalReached, "", {distance_m}});
    }
  }
  return records;
}

std::vector<std::uint64_t> Kept(const std::vector<std::string>& rules, std::uint64_t trials,
                                std::uint64_t seed = 1) {
  return KeptTrials(TraceOptions{.rules = rules}.retention(), kSchema, Records(trials), seed);
}

TEST(TraceRetention, RulesAreAUnion) {
  const auto failures = Kept({"failures"}, 200);
  const auto share = Kept({"share:0.1"}, 200);
  std::set<std::uint64_t> both(failures.begin(), failures.end());
  both.insert(share.begin(), share.end());
  const auto kept = Kept({"failures", "share:0.1", "worst:5"}, 200);
  EXPECT_TRUE(std::equal(kept.begin(), kept.end(), both.begin(), both.end()));
  EXPECT_GT(kept.size(), failures.size());
}

TEST(TraceRetention, AllButFaults) {
  EXPECT_THAT(Kept({"all"}, 100), SizeIs(90));
  EXPECT_THAT(Kept({"share:1"}, 100), SizeIs(90));
}

TEST(TraceRetention, WorstAreFailures) {
  EXPECT_THAT(Kept({"worst:3"}, 200), IsSubsetOf(Kept({"failures"}, 200)));
  EXPECT_THAT(Kept({"worst:3", "worst:5"}, 200), SizeIs(5));
  EXPECT_EQ(Kept({"worst:100000"}, 200), Kept({"failures"}, 200));
}

// A campaign that is extended keeps the share that it kept.
TEST(TraceRetention, TheShareOfMoreTrialsHoldsThatOfFewer) {
  const auto few = Kept({"share:0.2"}, 500);
  auto more = Kept({"share:0.2"}, 5000);
  more.erase(std::lower_bound(more.begin(), more.end(), 500), more.end());
  EXPECT_EQ(more, few);
  EXPECT_THAT(few, IsSubsetOf(Kept({"share:0.5"}, 500)));
  EXPECT_NE(few, Kept({"share:0.2"}, 500, 2));
}

// Binomial with n = 20000, p = 0.1: six standard deviations are 255, of which alpha = 2e-9.
TEST(TraceRetention, TheShareIsAsLargeAsItSays) {
  for (const std::uint64_t seed : {0, 1, 2, 77}) {
    int kept = 0;
    for (std::uint64_t trial = 0; trial < 20000; ++trial) kept += IsInShare(seed, trial, 0.1);
    EXPECT_NEAR(kept, 2000, 255) << seed;
  }
}

TEST(TraceRetention, WhatIsNoRuleIsSaidAtOnce) {
  const TraceOptions options{
      .rules = {"worst:0", "share:0", "share:1.5", "share:nan", "worst:x", "some", "", "all"}};
  auto problems = core::ProblemsIn([&] { options.retention(); });
  ASSERT_THAT(problems, SizeIs(7));
  problems.resize(1);
  EXPECT_THAT(problems, core::OneProblem("--traces", "\"worst:0\" is no rule", "worst:N"));
}

TEST(TraceRetention, NoRuleKeepsNothing) {
  EXPECT_FALSE(TraceOptions{}.retention().any());
  EXPECT_THAT(Kept({}, 100), SizeIs(0));
}

TEST(TraceRetention, TextForPeople) {
  EXPECT_EQ(RetentionText(TraceOptions{.rules = {"worst:5", "share:0.01"}}.retention()),
            "the 5 worst failures, 1 % of all trials");
  EXPECT_EQ(RetentionText(TraceOptions{.rules = {"all", "worst:5"}}.retention()), "every trial");
}

}  // namespace
}  // namespace rockyard::campaign
