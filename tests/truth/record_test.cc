#include "truth/record.h"

#include <gtest/gtest.h>

#include <bit>
#include <random>
#include <set>

#include "truth/drive_record.h"
#include "truth/end_cause.h"
#include "truth/value_table.h"

namespace rockyard::truth {
namespace {

TEST(RecordTest, OutcomesHaveUniqueNames) {
  const std::set<std::string_view> names(kTrialOutcomeNames.begin(), kTrialOutcomeNames.end());
  EXPECT_EQ(names.size(), kTrialOutcomeNames.size());
  EXPECT_EQ(Name(TrialOutcome::kGoalReached), "goal_reached");
  EXPECT_EQ(Name(TrialOutcome::kSimulatorFault), "simulator_fault");
  EXPECT_EQ(Name(TrialOutcome::kMeasured), "measured");
  EXPECT_EQ(Name(TrialOutcome::kExcessiveSlip), "excessive_slip");
  EXPECT_EQ(Name(TrialOutcome::kNavigatorFault), "navigator_fault");
  EXPECT_EQ(static_cast<std::size_t>(TrialOutcome::kNavigatorFault) + 1, kTrialOutcomeNames.size());
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

constexpr std::size_t kRows = 2 * ValueTable::kBlockRows + 100;  // the last block is unfinished

std::uint64_t Bits(double value) { return std::bit_cast<std::uint64_t>(value); }

// Columns of every form that a block can hold: one value, few, some hundreds, too many to list;
// and what equal numbers would hide: both zeros, and undefined values.
std::vector<double> Row(std::size_t i) {
  static std::mt19937_64 random(1);
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  return {7.6,
          static_cast<double>(i % 7),
          i % 2 == 0 ? 0.0 : -0.0,
          static_cast<double>(i % 256),
          static_cast<double>(i % 257),
          static_cast<double>(i % 1024),
          static_cast<double>(i % 1025),
          i % 5 == 0 ? kNaN : static_cast<double>(random()),
          static_cast<double>(i < ValueTable::kBlockRows)};
}

TEST(ValueTable, KeepsEveryBit) {
  std::vector<std::vector<double>> rows;
  for (std::size_t i = 0; i < kRows; ++i) rows.push_back(Row(i));
  ValueTable table(rows.front().size());
  for (const std::vector<double>& row : rows) table.Append(row);
  ASSERT_EQ(table.rows(), kRows);
  for (std::size_t i = 0; i < kRows; ++i) {
    for (std::size_t j = 0; j < table.columns(); ++j) {
      ASSERT_EQ(Bits(table.At(i, j)), Bits(rows[i][j])) << i << ' ' << j;
    }
  }
}

TEST(ValueTable, MayHaveNoColumns) {
  ValueTable table(0);
  for (std::size_t i = 0; i < ValueTable::kBlockRows + 1; ++i) table.Append({});
  EXPECT_EQ(table.rows(), ValueTable::kBlockRows + 1);
}

std::shared_ptr<ValueTable> TwoRows() {
  auto table = std::make_shared<ValueTable>(2);
  table->Append(std::vector<double>{1.0, 2.0});
  table->Append(std::vector<double>{3.0, 4.0});
  return table;
}

TEST(RecordValues, ReadARowAsAVector) {
  const RecordValues row(TwoRows(), 1);
  EXPECT_EQ(row.size(), 2u);
  EXPECT_EQ(row[0], 3.0);
  EXPECT_EQ(row.at(1), 4.0);
  EXPECT_THROW(row.at(2), std::out_of_range);
  EXPECT_EQ(row, (RecordValues{3.0, 4.0}));
  EXPECT_EQ(std::vector<double>(row.begin(), row.end()), (std::vector<double>{3.0, 4.0}));
  EXPECT_NE(row, (RecordValues{3.0}));
  EXPECT_NE(row, (RecordValues{3.0, 5.0}));
}

// Records of one table do not see each other's changes, and the table does not either.
TEST(RecordValues, ChangesStayWithOneRecord) {
  const auto table = TwoRows();
  RecordValues changed(table, 0);
  const RecordValues other = changed;
  changed[1] = 7.0;
  changed.push_back(8.0);
  EXPECT_EQ(changed, (RecordValues{1.0, 7.0, 8.0}));
  EXPECT_EQ(other, (RecordValues{1.0, 2.0}));
  EXPECT_EQ(table->At(0, 1), 2.0);
}

TEST(RecordValues, LetGoOfTheirTable) {
  auto table = TwoRows();
  const std::weak_ptr<ValueTable> held = table;
  RecordValues kept(table, 1);
  RecordValues cleared(std::move(table), 0);
  kept.Detach();
  EXPECT_FALSE(held.expired());
  cleared.clear();
  EXPECT_TRUE(held.expired());
  EXPECT_EQ(kept, (RecordValues{3.0, 4.0}));
  EXPECT_TRUE(cleared.empty());
}

Record RecordOf(const EndCauseInfo& info) {
  return {.trial = 0, .outcome = info.outcome, .detail = std::string(info.sentence), .values = {}};
}

TEST(EndCause, IsReadBackFromTheRecord) {
  for (std::size_t i = 0; i < kEndCauses.size(); ++i) {
    const Record record = RecordOf(kEndCauses[i]);
    EXPECT_EQ(CauseOf(record), static_cast<EndCause>(i));
    EXPECT_EQ(CauseName(record), kEndCauses[i].name);
  }
}

TEST(EndCause, IsUnknownWhereOutcomeAndSentenceDoNotBelongTogether) {
  Record record = RecordOf(Info(EndCause::kPatienceTime));
  record.outcome = TrialOutcome::kJammed;
  EXPECT_EQ(CauseOf(record), std::nullopt);
  record = RecordOf(Info(EndCause::kSankIn));
  record.detail += " twice";
  EXPECT_EQ(CauseOf(record), std::nullopt);
  EXPECT_EQ(CauseName(record), "");
  EXPECT_EQ(CauseOf(MakeFault(1, 2, "it crashed")), std::nullopt);
}

// What a navigator said stands behind the sentence, whatever it is; behind no other sentence does
// anything.
TEST(EndCause, OfANavigatorsFaultIsFoundWhateverTheNavigatorSaid) {
  for (std::size_t i = 0; i < kEndCauses.size(); ++i) {
    Record record = RecordOf(kEndCauses[i]);
    record.detail += ": no memory: 3";
    const bool fault = kEndCauses[i].outcome == TrialOutcome::kNavigatorFault;
    const auto expected = fault ? std::optional(static_cast<EndCause>(i)) : std::nullopt;
    EXPECT_EQ(CauseOf(record), expected) << kEndCauses[i].name;
  }
}

TEST(RecordTest, ACrashOfTheNavigatorLeavesNoValue) {
  const Record crash = MakeNavigatorCrash(7, "it crashed", 3);
  EXPECT_EQ(crash.trial, 7u);
  EXPECT_EQ(crash.values.size(), 3u);
  EXPECT_TRUE(IsNavigatorCrash(crash));
  EXPECT_FALSE(IsFault(crash));
  Record reported = crash;
  reported.values[1] = 0.0;
  EXPECT_FALSE(IsNavigatorCrash(reported));
  reported = crash;
  reported.outcome = TrialOutcome::kJammed;
  EXPECT_FALSE(IsNavigatorCrash(reported));
}

// Every way in which a drive can end has a cause; sentences are for people, names for files.
TEST(EndCause, TableIsInOrder) {
  std::set<std::string_view> names;
  std::set<std::string_view> sentences;
  std::set<TrialOutcome> outcomes;
  for (const EndCauseInfo& info : kEndCauses) {
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
    EXPECT_TRUE(sentences.insert(info.sentence).second) << info.sentence;
    outcomes.insert(info.outcome);
    EXPECT_EQ(info.sentence.find('_'), std::string_view::npos) << info.sentence;
    EXPECT_EQ(info.label.find('_'), std::string_view::npos) << info.label;
    EXPECT_TRUE(std::all_of(info.name.begin(), info.name.end(),
                            [](char c) { return c == '_' || (c >= 'a' && c <= 'z'); }));
  }
  EXPECT_EQ(outcomes.size(), kTrialOutcomeNames.size() - 2);  // simulator_fault and measured
}

TEST(EndCause, LimitsOfTheRunAreApartFromWhatTheRoverDid) {
  std::set<std::string_view> limits;
  for (const EndCauseInfo& info : kEndCauses) {
    if (EndedByLimit(RecordOf(info))) limits.insert(info.name);
  }
  EXPECT_EQ(limits, (std::set<std::string_view>{"patience_distance", "patience_turning",
                                                "patience_time", "time_limit"}));
  EXPECT_TRUE(EndedByLimit({0, TrialOutcome::kTimeLimit, "of an older version", {}}));
  EXPECT_FALSE(EndedByLimit({0, TrialOutcome::kNoPath, "of an older version", {}}));
}

TEST(EndCause, SomeOutcomesLeaveItOpen) {
  EXPECT_TRUE(HasSeveralCauses(TrialOutcome::kNoPath));
  EXPECT_TRUE(HasSeveralCauses(TrialOutcome::kJammed));
  EXPECT_TRUE(HasSeveralCauses(TrialOutcome::kGoalReached));
  EXPECT_TRUE(HasSeveralCauses(TrialOutcome::kNavigatorFault));
  EXPECT_FALSE(HasSeveralCauses(TrialOutcome::kTipOver));
  EXPECT_FALSE(HasSeveralCauses(TrialOutcome::kExcessiveSlip));
  EXPECT_FALSE(HasSeveralCauses(TrialOutcome::kMeasured));
}

}  // namespace
}  // namespace rockyard::truth
