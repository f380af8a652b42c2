#include "truth/end_cause.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <string>
#include <string_view>

namespace rockyard::truth {
namespace {

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
  EXPECT_FALSE(HasSeveralCauses(TrialOutcome::kTipOver));
  EXPECT_FALSE(HasSeveralCauses(TrialOutcome::kExcessiveSlip));
  EXPECT_FALSE(HasSeveralCauses(TrialOutcome::kMeasured));
}

}  // namespace
}  // namespace rockyard::truth
