#include "report/example_trials.h"

#include <gmock/gmock.h>

#include "sample_run.h"

namespace rockyard::report {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using truth::TrialOutcome;

const truth::RecordSchema kSchema{{"true_distance_m", "m", ""}};

TEST(ExampleTrials, TheMedianOfEachOutcomeTheCommonestFirst) {
  const std::vector<truth::Record> records{
      {0, TrialOutcome::kGoalReached, "", {9.0}}, {1, TrialOutcome::kNoPath, "", {3.0}},
      {2, TrialOutcome::kNoPath, "", {1.0}},      {3, TrialOutcome::kNoPath, "", {2.0}},
      {4, TrialOutcome::kSimulatorFault, "", {}}, {5, TrialOutcome::kMeasured, "", {1.0}}};
  EXPECT_THAT(ExampleTrials(kSchema, records), ElementsAre(3, 0));
}

TEST(ExampleTrials, OfTwoTheLowerAndOfEqualsTheFirst) {
  EXPECT_THAT(
      ExampleTrials(kSchema, std::vector<truth::Record>{{7, TrialOutcome::kJammed, "", {5.0}},
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
  EXPECT_THAT(ExampleTrials(kSchema, {}), IsEmpty());
}

}  // namespace
}  // namespace rockyard::report
