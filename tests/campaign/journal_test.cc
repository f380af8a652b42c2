// Which end of a piece of work an exception out of it is.

#include "campaign/journal.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <functional>
#include <new>
#include <set>
#include <stdexcept>
#include <string>
#include <system_error>

#include "batch/sqlite_database.h"
#include "campaign/campaign_traces.h"
#include "core/error.h"
#include "core/refusals.h"

namespace rockyard::campaign {
namespace {

using batch::StoreError;
using batch::StoreProblem;

struct Failure {
  Outcome outcome;
  std::string reason;
};

Failure FailureOf(const std::function<void()>& action) {
  const WorkResult result = Recorded({}, [&](Journal& journal) {
    return Guarded(journal, [&] {
      action();
      return Outcome::kDone;
    });
  });
  return {result.outcome, result.problems.empty() ? "" : result.problems.front().reason};
}

void ExpectFailure(const std::function<void()>& action, Outcome outcome,
                   const std::string& reason) {
  const Failure failure = FailureOf(action);
  EXPECT_EQ(failure.outcome, outcome) << reason;
  EXPECT_EQ(failure.reason, reason);
}

TEST(Guarded, WorkThatEndsIsDone) {
  ExpectFailure([] {}, Outcome::kDone, "");
}

TEST(Guarded, AMistakeOfTheUserIsBadInput) {
  ExpectFailure([] { throw core::UserError("a", "is wrong", "b"); }, Outcome::kBadInput,
                "is wrong");
  ExpectFailure([] { throw StoreError(StoreProblem::kMissing, "a", "is missing", "b"); },
                Outcome::kBadInput, "is missing");
}

TEST(Guarded, ANameThatCannotBeUsedIsBadInput) {
  const auto code = [](int reason) { return std::error_code(reason, std::generic_category()); };
  const auto fail = [&](int reason) {
    return [=] { throw std::filesystem::filesystem_error("status", "a", code(reason)); };
  };
  ExpectFailure(fail(ENAMETOOLONG), Outcome::kBadInput, "File name too long");
  ExpectFailure(fail(EACCES), Outcome::kBadInput, "Permission denied");
  ExpectFailure(fail(ENOSPC), Outcome::kFailed, "No space left on device");
}

TEST(Guarded, AFailureOfTheMachineIsNoMistakeOfTheUser) {
  ExpectFailure([] { throw core::MachineError("a", "has no room", "b"); }, Outcome::kFailed,
                "has no room");
  ExpectFailure([] { throw StoreError(StoreProblem::kFull, "a", "is full", "b"); },
                Outcome::kFailed, "is full");
  ExpectFailure([] { throw StoreError(StoreProblem::kOpenFiles, "a", "has many", "b"); },
                Outcome::kFailed, "has many");
  ExpectFailure([] { throw std::bad_alloc(); }, Outcome::kFailed, "is exhausted");
  ExpectFailure([] { throw std::runtime_error("what happened"); }, Outcome::kFailed,
                "what happened");
  ExpectFailure([] { throw 3; }, Outcome::kFailed, "failed for an unknown reason");
}

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

// Their drive would end this process too.
TEST(TraceRetention, ADriveWhoseNavigatorEndedItsProcessLeavesNoTrace) {
  std::vector<truth::Record> records = Records(30);
  records[3] = truth::MakeNavigatorCrash(3, "crashed", kSchema.size());
  records[6].outcome = TrialOutcome::kNavigatorFault;  // that reported an error
  for (const char* rule : {"all", "share:1", "failures", "worst:30"}) {
    const auto kept = KeptTrials(TraceOptions{.rules = {rule}}.retention(), kSchema, records, 1);
    EXPECT_THAT(kept, testing::AllOf(testing::Not(testing::Contains(3)), testing::Contains(6)))
        << rule;
  }
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
