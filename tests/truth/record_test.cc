#include "truth/record.h"

#include <gtest/gtest.h>

#include <set>
#include <string_view>

#include "truth/drive_record.h"

namespace rockyard::truth {
namespace {

TEST(RecordTest, OutcomesHaveUniqueNames) {
  const std::set<std::string_view> names(kTrialOutcomeNames.begin(), kTrialOutcomeNames.end());
  EXPECT_EQ(names.size(), kTrialOutcomeNames.size());
  EXPECT_EQ(Name(TrialOutcome::kGoalReached), "goal_reached");
  EXPECT_EQ(Name(TrialOutcome::kSimulatorFault), "simulator_fault");
  EXPECT_EQ(Name(TrialOutcome::kMeasured), "measured");
  EXPECT_EQ(Name(TrialOutcome::kExcessiveSlip), "excessive_slip");
  EXPECT_EQ(static_cast<std::size_t>(TrialOutcome::kExcessiveSlip) + 1, kTrialOutcomeNames.size());
}

TEST(RecordTest, OnlyArrivalsAreDeclaredSuccesses) {
  for (std::size_t i = 0; i < kTrialOutcomeNames.size(); ++i) {
    const auto outcome = static_cast<TrialOutcome>(i);
    const bool arrival =
        outcome == TrialOutcome::kGoalReached || outcome == TrialOutcome::kFalseGoal;
    EXPECT_EQ(DeclaredSuccess(outcome), arrival) << Name(outcome);
  }
}

TEST(RecordTest, AnUnfilledRecordIsAFault) {
  EXPECT_EQ(Record().outcome, TrialOutcome::kSimulatorFault);
}

TEST(DriveRecordTest, EveryColumnHasItsOwnNameUnitAndMeaning) {
  std::set<std::string_view> names;
  for (const DriveColumn& column : kDriveColumns) {
    EXPECT_TRUE(names.insert(column.name).second) << column.name;
    EXPECT_FALSE(column.unit.empty()) << column.name;
    EXPECT_FALSE(column.meaning.empty()) << column.name;
  }
}

TEST(DriveRecordTest, EveryColumnHasItsOwnMemberAndEveryMemberAColumn) {
  DriveRecord record;
  double number = 0.0;
  for (const DriveColumn& column : kDriveColumns) record.*column.member = ++number;
  std::set<double> values;
  for (const DriveColumn& column : kDriveColumns) values.insert(record.*column.member);
  EXPECT_EQ(values.size(), kDriveColumns.size());
  // The record holds doubles only, so its size counts its members.
  EXPECT_EQ(sizeof(DriveRecord), kDriveColumns.size() * sizeof(double));
}

TEST(DriveRecordTest, NamesEndInTheirUnit) {
  for (const DriveColumn& column : kDriveColumns) {
    if (column.unit == "m" || column.unit == "s" || column.unit == "deg" || column.unit == "rad") {
      EXPECT_TRUE(column.name.ends_with(column.unit)) << column.name;
    }
  }
}

}  // namespace
}  // namespace rockyard::truth
