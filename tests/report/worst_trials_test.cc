#include "report/worst_trials.h"

#include <gmock/gmock.h>

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

TEST(WorstTrials, ByNumberWithoutADistance) {
  const truth::RecordSchema other{{"scans", "1", ""}};
  EXPECT_THAT(WorstTrials(other, Records(), 2), ElementsAre(1, 2));
}

}  // namespace
}  // namespace rockyard::report
