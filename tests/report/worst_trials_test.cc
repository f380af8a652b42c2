#include "report/worst_trials.h"

#include <gmock/gmock.h>

#include <limits>

#include "sample_run.h"

namespace rockyard::report {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using truth::TrialOutcome;

const truth::RecordSchema kSchema{{"scans", "1", ""}, {"true_goal_distance_m", "m", ""}};

std::vector<truth::Record> Records() {
  return {{0, TrialOutcome::kGoalReached, "", {1.0, 0.1}},
          {1, TrialOutcome::kFalseGoal, "", {1.0, 0.8}},
          {2, TrialOutcome::kJammed, "", {1.0, 5.0}},
          {3, TrialOutcome::kNoPath, "", {1.0, 6.0}},
          {4, TrialOutcome::kSimulatorFault, "", {}},
          {5, TrialOutcome::kTipOver, "", {1.0, 5.0}}};
}

TEST(WorstTrials, FurthestFromTheGoalFirstThenByNumber) {
  EXPECT_THAT(WorstTrials(kSchema, Records(), 10), ElementsAre(3, 2, 5, 1));
  EXPECT_THAT(WorstTrials(kSchema, Records(), 2), ElementsAre(3, 2));
  EXPECT_THAT(WorstTrials(kSchema, Records(), 0), IsEmpty());
}

TEST(WorstTrials, NeitherSuccessNorFaultIsAFailure) {
  EXPECT_THAT(FailedTrials(Records()), ElementsAre(1, 2, 3, 5));
}

// NaN in a comparison is no order: the sort would be undefined, and would place them anywhere.
TEST(WorstTrials, WhatIsUnknownComesFirst) {
  std::vector<truth::Record> records;
  for (std::uint64_t trial = 0; trial < 200; ++trial) {
    const auto number = static_cast<double>(trial);
    const double distance_m = trial % 3 == 0 ? std::nan("") : number;
    records.push_back({trial, TrialOutcome::kJammed, "", {1.0, distance_m}});
  }
  records[9].values[1] = std::numeric_limits<double>::infinity();
  records[10].values.clear();
  const std::vector<std::uint64_t> worst = WorstTrials(kSchema, records, 200);
  ASSERT_EQ(worst.size(), 200u);
  EXPECT_THAT(std::vector(worst.begin(), worst.begin() + 5), ElementsAre(0, 3, 6, 9, 10));
  EXPECT_THAT(std::vector(worst.begin() + 68, worst.begin() + 71), ElementsAre(199, 197, 196));
}

TEST(WorstTrials, ByNumberWithoutADistance) {
  const truth::RecordSchema other{{"scans", "1", ""}};
  EXPECT_THAT(WorstTrials(other, Records(), 2), ElementsAre(1, 2));
}

const truth::RecordSchema kDistances{{"true_distance_m", "m", ""}};

TEST(ExampleTrials, TheMedianOfEachOutcomeTheCommonestFirst) {
  const std::vector<truth::Record> records{
      {0, TrialOutcome::kGoalReached, "", {9.0}}, {1, TrialOutcome::kNoPath, "", {3.0}},
      {2, TrialOutcome::kNoPath, "", {1.0}},      {3, TrialOutcome::kNoPath, "", {2.0}},
      {4, TrialOutcome::kSimulatorFault, "", {}}, {5, TrialOutcome::kMeasured, "", {1.0}}};
  EXPECT_THAT(ExampleTrials(kDistances, records), ElementsAre(3, 0));
}

TEST(ExampleTrials, OfTwoTheLowerAndOfEqualsTheFirst) {
  EXPECT_THAT(
      ExampleTrials(kDistances, std::vector<truth::Record>{{7, TrialOutcome::kJammed, "", {5.0}},
                                                           {8, TrialOutcome::kJammed, "", {4.0}}}),
      ElementsAre(8));
  // Of the six trials, 0 and 5 reached the goal after 8 m each.
  EXPECT_THAT(ExampleTrials(SampleSchema(), SampleRecords()), ElementsAre(0, 1, 2, 4));
}

TEST(ExampleTrials, WithoutDistancesByNumber) {
  const truth::RecordSchema other{{"scans", "1", ""}};
  EXPECT_THAT(
      ExampleTrials(other, std::vector<truth::Record>{{2, TrialOutcome::kJammed, "", {1.0}},
                                                      {0, TrialOutcome::kJammed, "", {3.0}},
                                                      {1, TrialOutcome::kJammed, "", {2.0}}}),
      ElementsAre(1));
  EXPECT_THAT(ExampleTrials(kDistances, {}), IsEmpty());
}

}  // namespace
}  // namespace rockyard::report
